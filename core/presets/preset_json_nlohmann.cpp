// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/classify/look_json_nlohmann.h"
#include "core/classify/reasons.h"
#include "core/files/json_fields_nlohmann.h"
#include "core/files/json_lines_nlohmann.h"
#include "core/files/reasons.h"
#include "core/presets/preset_json_nlohmann.h"
#include "core/presets/reasons.h"
#include "core/shading/shading_json_nlohmann.h"
#include "core/task/error.h"

namespace pellucid::presets {

namespace {

namespace because = task::because;
using files::JsonFields;
using files::JsonValue;
using nlohmann::json;

constexpr const char *schema = "pellucid-preset/2";
constexpr int longestName = 80; // characters

std::string textOrEmpty(const JsonValue &in) {
    return in ? in.text() : std::string();
}

// Counts the bytes that start a UTF-8 character.
std::ptrdiff_t characters(const std::string &text) {
    return std::count_if(text.begin(), text.end(),
                         [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
}

// Overwrites a class as read from its file with the known keys.
json joined(const json &former, json known) {
    if (!former.is_object())
        return known;
    json out = former;
    for (const char *optional : {"transfer_function", "steps"})
        out.erase(optional);
    out.update(known);
    return out;
}

} // namespace

Preset presetFrom(const JsonValue &in) {
    if (!in.isObject())
        in.refuse(because::mustBeAnObject);
    if (textOrEmpty(in["schema"]) != schema)
        in["schema"].refuse(because::isNot(schema));
    Preset preset;
    preset.name = textOrEmpty(in["name"]);
    if (preset.name.find_first_not_of(' ') == std::string::npos ||
        characters(preset.name) > longestName ||
        std::any_of(preset.name.begin(), preset.name.end(),
                    [](char c) { return static_cast<unsigned char>(c) < 32; }))
        in["name"].refuse(because::mustBeALine(longestName));
    preset.modality = textOrEmpty(in["modality"]);
    preset.notes = textOrEmpty(in["notes"]);
    if (const JsonValue regions = in["regions"])
        for (const JsonValue &region : regions.elements())
            preset.regions.insert(region.checked([&] { return regionFromName(region.text()); }));
    if (const JsonValue contrast = in["contrast"])
        preset.needsContrast = contrast.boolean();
    const std::string unit = textOrEmpty(in["units"]);
    if (!unit.empty() && unit != "value" && unit != "window")
        in["units"].refuse(because::mustBeValueOrWindow);
    preset.unit = unit == "window" ? RangeUnit::window : RangeUnit::value;
    if (const JsonValue window = in["window"]) {
        const auto [low, high] = window.twoNumbers();
        if (!(low < high))
            window.refuse(because::mustBeTwoRisingNumbers);
        preset.window = classify::FieldWindow{low, high};
    }
    JsonFields io(in);
    fields(io, preset.look);
    fields(io, preset.shading);
    preset.source = in.dumped();
    return preset;
}

Preset presetFromJson(const std::string &text) {
    return files::readJson(text, presetFrom);
}

json jsonOf(const Preset &preset) {
    json out = json::parse(preset.source, nullptr, false);
    if (!out.is_object())
        out = json::object();
    json formerClasses = out.value("classes", json::array());
    for (const char *known : {"transfer_function", "classes", "window", "units", "modality",
                              "regions", "contrast", "notes", "cue", "ambient", "lights"})
        out.erase(known);
    out["schema"] = schema;
    out["name"] = preset.name;
    if (!preset.modality.empty())
        out["modality"] = preset.modality;
    if (!preset.notes.empty())
        out["notes"] = preset.notes;
    if (!preset.regions.empty()) {
        out["regions"] = json::array();
        for (const BodyRegion region : preset.regions)
            out["regions"].push_back(regionName(region));
    }
    if (preset.needsContrast)
        out["contrast"] = true;
    if (preset.unit == RangeUnit::window)
        out["units"] = "window";
    if (preset.window)
        out["window"] = {preset.window->low, preset.window->high};
    JsonFields io(out);
    Preset copy = preset;
    fields(io, copy.look);
    fields(io, copy.shading);
    if (out.contains("classes"))
        for (json &tissue : out["classes"]) {
            const auto former =
                std::find_if(formerClasses.begin(), formerClasses.end(), [&](const json &c) {
                    return c.is_object() && c.value("name", json()) == tissue["name"];
                });
            if (former != formerClasses.end())
                tissue = joined(*former, tissue);
        }
    return out;
}

std::string toJson(const Preset &preset) {
    return jsonOf(preset).dump(2, ' ', false, json::error_handler_t::replace);
}

} // namespace pellucid::presets
