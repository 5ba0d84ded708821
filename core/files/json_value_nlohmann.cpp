// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/json_value_nlohmann.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/files/reasons.h"
#include "core/task/reasons.h"

namespace pellucid::files {

namespace because = task::because;

bool JsonValue::isObject() const {
    return m_json != nullptr && m_json->is_object();
}

bool JsonValue::isList() const {
    return m_json != nullptr && m_json->is_array();
}

bool JsonValue::isText() const {
    return m_json != nullptr && m_json->is_string();
}

void JsonValue::requireOnly(const std::vector<const char *> &names) const {
    std::string known;
    for (const char *const name : names)
        known += (known.empty() ? "" : ", ") + std::string(name);
    for (const auto &[name, value] : members())
        if (std::find(names.begin(), names.end(), name) == names.end())
            value.refuse(because::isNoMember(name, known));
}

std::string JsonValue::dumped() const {
    return m_json == nullptr ? std::string() : m_json->dump();
}

JsonValue JsonValue::operator[](const std::string &name) const {
    const bool isThere = isObject() && m_json->contains(name);
    return {isThere ? &(*m_json)[name] : nullptr, m_pointer + "/" + name};
}

JsonValue JsonValue::at(const std::string &name) const {
    if (!isObject())
        refuse(because::mustBeAnObject);
    const JsonValue member = (*this)[name];
    if (!member)
        refuse(because::hasNo(name));
    return member;
}

JsonValue JsonValue::at(std::size_t index) const {
    if (index >= size())
        refuse(because::hasNo(std::to_string(index)));
    return {&(*m_json)[index], m_pointer + "/" + std::to_string(index)};
}

std::size_t JsonValue::size() const {
    if (m_json == nullptr || !m_json->is_array())
        refuse(because::mustBeAList);
    return m_json->size();
}

std::vector<JsonValue> JsonValue::elements() const {
    std::vector<JsonValue> all;
    for (std::size_t n = 0; n < size(); ++n)
        all.push_back(at(n));
    return all;
}

std::vector<std::pair<std::string, JsonValue>> JsonValue::members() const {
    if (!isObject())
        refuse(because::mustBeAnObject);
    std::vector<std::pair<std::string, JsonValue>> all;
    for (const auto &member : m_json->items())
        all.emplace_back(member.key(), (*this)[member.key()]);
    return all;
}

double JsonValue::number(double largest) const {
    if (m_json == nullptr || !m_json->is_number())
        refuse(because::mustBeANumber);
    const double value = m_json->get<double>();
    if (!(std::abs(value) <= largest))
        refuse(because::isOutOfRange);
    return value;
}

std::vector<double> JsonValue::numbers() const {
    if (m_json == nullptr || !m_json->is_array())
        refuse(because::mustBeNumbers);
    std::vector<double> values;
    for (std::size_t n = 0; n < m_json->size(); ++n)
        values.push_back(at(n).number());
    return values;
}

template <std::size_t N>
std::array<double, N> JsonValue::numbersOf(double largest, const task::Reason &expected) const {
    if (m_json == nullptr || !m_json->is_array() || m_json->size() != N)
        refuse(expected);
    std::array<double, N> values{};
    for (std::size_t n = 0; n < N; ++n)
        values[n] = at(n).number(largest);
    return values;
}

std::array<double, 2> JsonValue::twoNumbers() const {
    return numbersOf<2>(largestNumber, because::mustBeTwoNumbers);
}

std::array<double, 3> JsonValue::threeNumbers(double largest) const {
    return numbersOf<3>(largest, because::mustBeThreeNumbers);
}

std::array<double, 4> JsonValue::fourNumbers() const {
    return numbersOf<4>(largestNumber, because::mustBeFourNumbers);
}

int JsonValue::wholeNumber(int least, int most) const {
    const double value = number();
    if (value != std::floor(value) || value < least || value > most)
        refuse(because::mustBeWhole(least, most));
    return int(value);
}

bool JsonValue::boolean() const {
    if (m_json == nullptr || !m_json->is_boolean())
        refuse(because::mustBeTrueOrFalse);
    return m_json->get<bool>();
}

std::string JsonValue::text() const {
    if (m_json == nullptr || !m_json->is_string())
        refuse(because::mustBeAText);
    return m_json->get<std::string>();
}

void JsonValue::refuse(const task::Reason &what) const {
    throw task::Error(task::ErrorCode::usage,
                      m_pointer.empty() ? what : because::at(m_pointer, what));
}

std::string jsonPointer(const task::Reason &reason) {
    return reason.is(because::at) ? reason.arguments()[0].text : std::string();
}

std::string jsonFault(const std::exception &error) {
    const std::string text = error.what();
    const auto tag = text.find("] ");
    return tag == std::string::npos ? text : text.substr(tag + 2);
}

} // namespace pellucid::files
