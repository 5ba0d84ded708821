// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/files/reasons.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::files {

/// The words that a file may contain, and their meanings.
template <class T, std::size_t N> using JsonWords = std::array<std::pair<const char *, T>, N>;

/// A JSON value, perhaps written by hand, with its JSON pointer.
/// *Throws*: every function that reads throws Error{usage}. The reason is `because::at` with the
/// pointer and the fault; for the whole text, which has no pointer, the fault alone.
///
/// Only *_nlohmann.cpp may include this header, the only one that names the library: so there is
/// one reader for all rooms.
class JsonValue {
public:
    /// The whole text. *Requires*: `whole` outlives all values read from it.
    explicit JsonValue(const nlohmann::json &whole) : m_json(&whole) {}
    explicit JsonValue(nlohmann::json &&) = delete;

    /// A member of an object. If there is no such member, or no object, the result is absent, but
    /// has its pointer.
    JsonValue operator[](const std::string &name) const;
    /// A required member of an object, and a required element of a list.
    JsonValue at(const std::string &name) const;
    JsonValue at(std::size_t index) const;
    /// Whether it is present.
    explicit operator bool() const { return m_json != nullptr; }
    bool isObject() const;
    bool isList() const;
    bool isText() const;
    /// For objects only: refuses the first member that has none of these names, as misspelt.
    void requireOnly(const std::vector<const char *> &names) const;
    /// How many objects and lists it is in.
    int depth() const { return int(std::count(m_pointer.begin(), m_pointer.end(), '/')); }
    /// The value itself, as JSON.
    std::string dumped() const;

    /// For lists only.
    std::size_t size() const;
    std::vector<JsonValue> elements() const;
    /// For objects only. *Shape*: sorted by name.
    std::vector<std::pair<std::string, JsonValue>> members() const;

    /// The difference of two such numbers is finite in single precision.
    static constexpr double largestNumber = 1e30;
    /// A number whose magnitude is at most `largest`.
    double number(double largest = largestNumber) const;
    std::vector<double> numbers() const;
    std::array<double, 2> twoNumbers() const;
    std::array<double, 3> threeNumbers(double largest = largestNumber) const;
    std::array<double, 4> fourNumbers() const;
    int wholeNumber(int least, int most) const;
    template <std::size_t N> std::array<int, N> wholeNumbers(int least, int most) const {
        std::array<int, N> values{};
        if (size() != N)
            refuse(task::because::mustHaveElements(N));
        for (std::size_t n = 0; n < N; ++n)
            values[n] = at(n).wholeNumber(least, most);
        return values;
    }
    bool boolean() const;
    std::string text() const;
    /// The meaning of a word.
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
    /// The result of a check of the value; if the check throws an Error, its reason is refused at
    /// this pointer.
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

    const nlohmann::json *m_json; ///< null if it is absent
    std::string m_pointer;
};

/// The word with a given meaning.
template <class T, std::size_t N> const char *wordFor(T value, const JsonWords<T, N> &words) {
    for (const auto &[word, meaning] : words)
        if (meaning == value)
            return word;
    return "";
}

/// The pointer in the reason for which a JsonValue was refused; empty for any other reason, as for
/// the whole text.
std::string jsonPointer(const task::Reason &reason);

/// The message of an exception of the library, without the library's tag.
std::string jsonFault(const std::exception &error);

} // namespace pellucid::files
