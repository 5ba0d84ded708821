// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "core/classify/look_json_nlohmann.h"
#include "core/files/json_fields_nlohmann.h"
#include "core/shading/shading_json_nlohmann.h"

namespace pellucid::test {

/// A value from the text of its JSON, and back. *Throws* as JsonFields.
template <class T> T readJson(const std::string &text) {
    const auto json = nlohmann::json::parse(text, nullptr, false);
    T value;
    files::JsonFields::read(files::JsonValue(json), value);
    return value;
}
template <class T> std::string jsonText(const T &value) {
    return files::JsonFields::written(value).dump();
}

} // namespace pellucid::test
