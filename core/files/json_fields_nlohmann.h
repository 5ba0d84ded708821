// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "core/files/json_value_nlohmann.h"
#include "core/files/reasons.h"

namespace pellucid::files {

template <class T> inline constexpr bool isOptional = false;
template <class T> inline constexpr bool isOptional<std::optional<T>> = true;
template <class T> inline constexpr bool isVector = false;
template <class T> inline constexpr bool isVector<std::vector<T>> = true;
template <class T> inline constexpr bool isArray = false;
template <class T, std::size_t N> inline constexpr bool isArray<std::array<T, N>> = true;

/// The members of a JSON object, to be read or written: one list of a struct's fields serves both.
/// Beside a type T of its own, a room declares one of
///   void fields(JsonFields &, T &)                  the fields of a struct; if there is a
///                                                   validate(const T &), it checks what was read
///   const JsonWords<T, N> &jsonWords(T)             the words of an enumeration
///   void readFrom(const JsonValue &, T &) and json jsonOf(const T &)     anything else
/// Numbers, texts, vectors, quaternions, lists and optional values need nothing. *Throws* as
/// JsonValue while it reads.
class JsonFields {
public:
    /// Reads from an object.
    explicit JsonFields(const JsonValue &in) : m_in(&in) {
        if (!in.isObject())
            in.refuse(task::because::mustBeAnObject);
    }
    explicit JsonFields(JsonValue &&) = delete;
    /// Writes to an object.
    explicit JsonFields(nlohmann::json &out) : m_out(&out) {}

    /// A field that is always there.
    template <class T> void required(const char *name, T &value) {
        m_names.push_back(name);
        if (m_in != nullptr)
            read(m_in->at(name), value);
        else
            (*m_out)[name] = written(value);
    }
    /// A field that keeps its value if it is not there; it is always written.
    template <class T> void known(const char *name, T &value) {
        m_names.push_back(name);
        if (m_in == nullptr)
            (*m_out)[name] = written(value);
        else if (const JsonValue member = (*m_in)[name])
            read(member, value);
    }
    /// The same, but it is not written if it has its usual value.
    template <class T> void unusual(const char *name, T &value, const T &usual = T()) {
        if (m_in != nullptr || value != usual)
            known(name, value);
    }
    /// A text that must be there as it is.
    void schema(const std::string &text) {
        std::string given = text;
        required("schema", given);
        if (given != text)
            (*m_in)["schema"].refuse(task::because::isNot(text));
    }
    /// A range that is always there.
    void required(const char *name, double &low, double &high) {
        std::array<double, 2> range{low, high};
        required(name, range);
        low = range[0];
        high = range[1];
    }
    /// Checks a field that was read; an Error that `check` throws is refused at the field.
    template <class F> void checked(const char *name, const F &check) const {
        if (m_in == nullptr)
            return;
        if (const JsonValue member = (*m_in)[name])
            member.checked(check);
    }
    /// Refuses members that are none of these fields, as misspelt.
    void nothingElse() const {
        if (m_in != nullptr)
            m_in->requireOnly(m_names);
    }

    template <class T> static void read(const JsonValue &in, T &value) {
        if constexpr (std::is_same_v<T, double>) {
            value = in.number();
        } else if constexpr (std::is_same_v<T, int>) {
            value = in.wholeNumber(0, 1000000000);
        } else if constexpr (std::is_same_v<T, bool>) {
            value = in.boolean();
        } else if constexpr (std::is_same_v<T, std::string>) {
            value = in.text();
        } else if constexpr (std::is_same_v<T, glm::dvec2>) {
            const auto [x, y] = in.twoNumbers();
            value = {x, y};
        } else if constexpr (std::is_same_v<T, glm::dvec3>) {
            const auto [x, y, z] = in.threeNumbers();
            value = {x, y, z};
        } else if constexpr (std::is_same_v<T, glm::dquat>) {
            const auto [w, x, y, z] = in.fourNumbers();
            value = {w, x, y, z};
        } else if constexpr (std::is_same_v<T, std::array<double, 2>>) {
            value = in.twoNumbers();
        } else if constexpr (std::is_same_v<T, std::vector<double>>) {
            value = in.numbers();
        } else if constexpr (isOptional<T>) {
            read(in, value.emplace());
        } else if constexpr (isArray<T>) {
            for (std::size_t n = 0; n < value.size(); ++n)
                read(in.at(n), value[n]);
        } else if constexpr (isVector<T>) {
            value.clear();
            for (const JsonValue &element : in.elements())
                read(element, value.emplace_back());
        } else if constexpr (requires { jsonWords(value); }) {
            value = in.meaning(jsonWords(value));
        } else if constexpr (requires(JsonFields & io) { fields(io, value); }) {
            JsonFields io(in);
            fields(io, value);
            if constexpr (requires { validate(std::as_const(value)); })
                in.checked([&] { validate(std::as_const(value)); });
        } else {
            readFrom(in, value);
        }
    }

    template <class T> static nlohmann::json written(const T &value) {
        if constexpr (std::is_same_v<T, glm::dvec2>) {
            return {value.x, value.y};
        } else if constexpr (std::is_same_v<T, glm::dvec3>) {
            return {value.x, value.y, value.z};
        } else if constexpr (std::is_same_v<T, glm::dquat>) {
            return {value.w, value.x, value.y, value.z};
        } else if constexpr (isOptional<T>) {
            return written(*value);
        } else if constexpr (std::is_same_v<T, std::vector<double>>) {
            return value;
        } else if constexpr (isArray<T> || isVector<T>) {
            nlohmann::json out = nlohmann::json::array();
            for (const auto &element : value)
                out.push_back(written(element));
            return out;
        } else if constexpr (requires { jsonWords(value); }) {
            return wordFor(value, jsonWords(value));
        } else if constexpr (requires(JsonFields & io, T & field) { fields(io, field); }) {
            nlohmann::json out = nlohmann::json::object();
            JsonFields io(out);
            T copy = value; // `fields` could change it
            fields(io, copy);
            return out;
        } else if constexpr (requires { jsonOf(value); }) {
            return jsonOf(value);
        } else {
            return value;
        }
    }

private:
    const JsonValue *m_in = nullptr;
    nlohmann::json *m_out = nullptr;
    std::vector<const char *> m_names;
};

} // namespace pellucid::files
