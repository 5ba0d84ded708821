// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "core/classify/look_json_nlohmann.h"
#include "core/files/json_value_nlohmann.h"
#include "core/shading/shading_json_nlohmann.h"

namespace pellucid::test {

/// What the readers make of a text. *Throw* as they do.
inline classify::Look readLook(const std::string &text) {
    const auto json = nlohmann::json::parse(text, nullptr, false);
    return classify::lookFrom(files::JsonValue(json));
}
inline shading::Shading readShading(const std::string &text) {
    const auto json = nlohmann::json::parse(text, nullptr, false);
    return shading::shadingFrom(files::JsonValue(json));
}

} // namespace pellucid::test
