// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/task/error.h"

namespace pellucid::confined {

/// A reader refuses a longer text; a writer truncates it.
inline constexpr std::uint64_t longestText = 1 << 16;
inline constexpr std::uint64_t maxElements = 1'000'000;

/// Packs values as bytes. Writer and reader visit the same fields in the same order: a type has one
/// function `pass(archive, value)` for both, in its own namespace or in this one. This header has
/// it for numbers, texts, and standard containers.
class Writer {
public:
    static constexpr bool isReading = false;

    template <class T>
    requires std::is_arithmetic_v<T>
    void number(T &value) {
        const std::size_t at = bytes.size();
        bytes.resize(at + sizeof(T));
        std::memcpy(bytes.data() + at, &value, sizeof(T));
    }
    void text(std::string &value) {
        std::uint64_t size = std::min<std::uint64_t>(value.size(), longestText);
        number(size);
        bytes.append(value, 0, size);
    }
    std::uint64_t count(std::uint64_t size) {
        number(size);
        return size;
    }

    std::string bytes;
};

/// Unpacks untrusted bytes. *Throws* Error{unusable, reason} if they are not such values.
class Reader {
public:
    static constexpr bool isReading = true;

    Reader(std::span<const std::byte> bytes, task::Reason refusal)
        : m_rest(bytes), m_refusal(std::move(refusal)) {}

    template <class T>
    requires std::is_arithmetic_v<T>
    void number(T &value) {
        if constexpr (std::same_as<T, bool>) { // any other byte is not a valid bool
            unsigned char byte = 0;
            number(byte);
            value = byte != 0;
        } else {
            if (m_rest.size() < sizeof(T))
                fail();
            std::memcpy(&value, m_rest.data(), sizeof(T));
            m_rest = m_rest.subspan(sizeof(T));
            if constexpr (std::is_floating_point_v<T>)
                if (!std::isfinite(value))
                    fail();
        }
    }
    void text(std::string &value) {
        const std::uint64_t size = count(0);
        if (size > std::min<std::uint64_t>(longestText, m_rest.size()))
            fail();
        value.assign(reinterpret_cast<const char *>(m_rest.data()), size);
        m_rest = m_rest.subspan(size);
    }
    // Nothing is reserved: elements are created only as their bytes are present.
    std::uint64_t count(std::uint64_t) {
        std::uint64_t size = 0;
        number(size);
        if (size > std::min<std::uint64_t>(maxElements, m_rest.size()))
            fail();
        return size;
    }
    void end() const {
        if (!m_rest.empty())
            fail();
    }
    [[noreturn]] void fail() const { throw task::Error(task::ErrorCode::unusable, m_refusal); }

private:
    std::span<const std::byte> m_rest;
    task::Reason m_refusal;
};

template <class A, class T>
requires std::is_arithmetic_v<T>
void pass(A &archive, T &value) {
    archive.number(value);
}

template <class A> void pass(A &archive, std::string &value) {
    archive.text(value);
}

template <class A, class T> void pass(A &archive, std::optional<T> &value);
template <class A, class T> void pass(A &archive, std::vector<T> &values);
template <class A, class K, class V> void pass(A &archive, std::map<K, V> &values);

/// An enumeration as a number. The caller checks its range after reading.
template <class A, class E>
requires std::is_enum_v<E>
void pass(A &archive, E &value) {
    auto number = std::int32_t(value);
    archive.number(number);
    value = E(number);
}

template <class A, class T> void pass(A &archive, std::optional<T> &value) {
    bool isThere = value.has_value();
    pass(archive, isThere);
    if constexpr (A::isReading)
        value = isThere ? std::optional(T()) : std::nullopt;
    if (isThere)
        pass(archive, *value);
}

template <class A, class T> void pass(A &archive, std::vector<T> &values) {
    const std::uint64_t size = archive.count(values.size());
    for (std::uint64_t n = 0; n < size; ++n) {
        if constexpr (A::isReading)
            values.emplace_back();
        pass(archive, values[n]);
    }
}

template <class A, class K, class V> void pass(A &archive, std::map<K, V> &values) {
    const std::uint64_t size = archive.count(values.size());
    if constexpr (A::isReading) {
        for (std::uint64_t n = 0; n < size; ++n) {
            K key;
            pass(archive, key);
            pass(archive, values[key]);
        }
    } else {
        for (auto &[key, value] : values) {
            K copy = key;
            pass(archive, copy);
            pass(archive, value);
        }
    }
}

/// Several values, in this order.
template <class A, class... T> void passAll(A &archive, T &...values) {
    (pass(archive, values), ...);
}

template <class T> std::string packed(const T &value) {
    Writer writer;
    T copy = value; // a reader assigns to the fields
    pass(writer, copy);
    return std::move(writer.bytes);
}

/// *Throws* Error{unusable, refusal}.
template <class T> T unpacked(std::span<const std::byte> bytes, const task::Reason &refusal) {
    Reader reader(bytes, refusal);
    T value;
    pass(reader, value);
    reader.end();
    return value;
}

/// Reads the format of `task::Reason::encoded`, with a limit on its length. Texts are made one
/// printable line. *Throws* Error{unusable, refusal}.
task::Reason unpackedReason(std::span<const std::byte> bytes, const task::Reason &refusal);

/// Replaces control characters by spaces.
void makeOneLine(std::string &text);

} // namespace pellucid::confined
