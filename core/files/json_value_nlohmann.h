// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/task/error.h"

namespace pellucid::files {

/// The words of a file and what they mean.
template <class T, std::size_t N> using JsonWords = std::array<std::pair<const char *, T>, N>;

/// A value of JSON that somebody may have written by hand, with its JSON pointer.
/// *Throws*, every function that reads: Error{usage} whose reason is `because::at` with the pointer
/// and what is wrong; for the whole text, which has none, what is wrong alone.
///
/// For the *_nlohmann.cpp of other rooms; the only header that names the library, so that the
/// reader is not written twice.
class JsonValue {
public:
    /// The whole text. *Requires*: it outlives all values of it.
    explicit JsonValue(const nlohmann::json &whole) : m_json(&whole) {}
    explicit JsonValue(nlohmann::json &&) = delete;

    /// A member of an object. There may be none of that name, or no object: what is then given
    /// knows its pointer, but is not there.
    JsonValue operator[](const std::string &name) const;
    /// A member that an object must have, and an element that a list must have.
    JsonValue at(const std::string &name) const;
    JsonValue at(std::size_t index) const;
    /// Whether it is there.
    explicit operator bool() const { return m_json != nullptr; }
    bool isObject() const;

    /// Of a list.
    std::size_t size() const;
    std::vector<JsonValue> elements() const;
    /// Of an object, by name.
    std::vector<std::pair<std::string, JsonValue>> members() const;

    /// Differences of two are finite in single precision.
    static constexpr double largestNumber = 1e30;
    /// *Shape*: no farther from 0 than `largest`.
    double number(double largest = largestNumber) const;
    std::vector<double> numbers() const;
    std::array<double, 2> twoNumbers() const;
    std::array<double, 3> threeNumbers(double largest = largestNumber) const;
    std::string text() const;
    /// What its word means.
    template <class T, std::size_t N> T meaning(const JsonWords<T, N> &words) const {
        const std::string given = text();
        std::string known;
        for (const auto &[word, value] : words) {
            if (given == word)
                return value;
            known += (known.empty() ? "" : ", ") + std::string(word);
        }
        refuse(task::because::isNoneOf(given, known));
    }

    [[noreturn]] void refuse(const task::Reason &what) const;
    /// What a check of the value gives; an error of it is refused at this pointer.
    template <class F> decltype(auto) checked(F &&check) const {
        try {
            return std::forward<F>(check)();
        } catch (const task::Error &error) {
            refuse(error.reason());
        }
    }

private:
    JsonValue(const nlohmann::json *json, std::string pointer)
        : m_json(json), m_pointer(std::move(pointer)) {}
    template <std::size_t N>
    std::array<double, N> numbersOf(double largest, const task::Reason &expected) const;

    const nlohmann::json *m_json; ///< none: it is not there
    std::string m_pointer;
};

/// The word that means a value.
template <class T, std::size_t N> const char *wordFor(T value, const JsonWords<T, N> &words) {
    for (const auto &[word, meaning] : words)
        if (meaning == value)
            return word;
    return "";
}

/// The pointer that a JsonValue was refused with; empty for any other reason, as for the whole
/// text.
std::string jsonPointer(const task::Reason &reason);

/// What the library reports, without the name that it gives the exception.
std::string jsonFault(const std::exception &error);

} // namespace pellucid::files
