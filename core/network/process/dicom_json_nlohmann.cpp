// SPDX-License-Identifier: GPL-3.0-or-later
#include <charconv>

#include <nlohmann/json.hpp>

#include "core/dicom_text/attributes.h"
#include "core/network/process/dicom_json.h"
#include "core/network/process/reasons.h"
#include "core/system/utf8.h"
#include "core/task/error.h"

namespace pellucid::network::process {

namespace {

using Json = nlohmann::json;

[[noreturn]] void fail() {
    throw task::Error(task::ErrorCode::unusable, task::because::serverSendsNoDicomJson);
}

// Some servers send ISO 8859-1 where the standard has UTF-8 only.
std::string inUtf8(const std::string &text) {
    if (system::isUtf8(text))
        return text;
    std::string converted;
    for (const char c : text) {
        const auto code = (unsigned char)(c);
        if (code < 0x80)
            converted += c;
        else
            converted += {char(0xc0 | code >> 6), char(0x80 | (code & 0x3f))};
    }
    return converted;
}

Json parsed(const std::string &text) {
    Json json = Json::parse(inUtf8(text), nullptr, false);
    if (json.is_discarded())
        fail();
    return json;
}

std::uint32_t tagOf(const std::string &name) {
    if (name.size() != 8 || name.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos)
        return 0;
    return std::uint32_t(std::stoul(name, nullptr, 16));
}

std::string textOf(const Json &value) {
    if (value.is_string())
        return value.get<std::string>();
    if (value.is_number() || value.is_boolean())
        return value.dump();
    std::string name; // of a person: three groups, as in other encodings (PS3.5, 6.2.1)
    if (value.is_object())
        for (const char *const group : {"Alphabetic", "Ideographic", "Phonetic"}) {
            name += *group == 'A' ? "" : "=";
            if (value.contains(group) && value[group].is_string())
                name += value[group].get<std::string>();
        }
    name.erase(name.find_last_not_of('=') + 1);
    return name;
}

std::string valueOf(const Json &attribute) {
    if (!attribute.is_object() || !attribute.contains("Value") || !attribute["Value"].is_array() ||
        (attribute.contains("vr") && attribute["vr"] == "SQ"))
        return {};
    std::string text;
    for (const Json &value : attribute["Value"])
        text += (text.empty() ? "" : "\\") + textOf(value);
    return dicom_text::oneLine(text);
}

Attributes attributesOf(const Json &dataset) {
    Attributes attributes;
    if (!dataset.is_object())
        fail();
    for (const auto &[name, attribute] : dataset.items())
        if (const std::uint32_t tag = tagOf(name))
            if (std::string text = valueOf(attribute); !text.empty())
                attributes[tag] = std::move(text);
    return attributes;
}

// The items of a sequence. Not a copy: copying deeply nested values would exhaust the stack.
const Json &itemsOf(const Json &dataset, const char *tag) {
    static const Json none = Json::array();
    if (!dataset.contains(tag) || !dataset[tag].is_object() || !dataset[tag].contains("Value") ||
        !dataset[tag]["Value"].is_array())
        return none;
    return dataset[tag]["Value"];
}

int numberOf(const std::string &text) {
    int number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

} // namespace

std::vector<Attributes> readDicomJson(const std::string &text) {
    if (text.find_first_not_of(" \t\r\n") == std::string::npos)
        return {};
    const Json json = parsed(text);
    if (!json.is_array())
        fail();
    std::vector<Attributes> datasets;
    for (const Json &dataset : json)
        datasets.push_back(attributesOf(dataset));
    return datasets;
}

StoreAnswer readStoreAnswer(const std::string &text) {
    const Json whole = parsed(text);
    // Some servers answer with a list.
    const Json &json = whole.is_array() && whole.size() == 1 ? whole[0] : whole;
    if (!json.is_object())
        fail();
    constexpr std::uint32_t referencedInstance = 0x00081155, warningReason = 0x00081196,
                            failureReason = 0x00081197;
    const auto itemsAt = [&](const char *sequence, std::uint32_t reason) {
        std::vector<StoreAnswer::Item> items;
        for (const Json &item : itemsOf(json, sequence)) {
            Attributes attributes = attributesOf(item);
            items.push_back({attributes[referencedInstance], numberOf(attributes[reason])});
        }
        return items;
    };
    return {itemsAt("00081199", warningReason), itemsAt("00081198", failureReason)};
}

} // namespace pellucid::network::process
