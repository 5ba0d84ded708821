// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/classify/look_json.h"
#include "core/files/json_value_nlohmann.h"
#include "core/presets/preset.h"
#include "core/task/error.h"

namespace pellucid::presets {

namespace {

namespace because = task::because;
using files::JsonValue;
using nlohmann::json;
using task::Error;
using task::ErrorCode;

// The first schema kept the thresholds of `binarise` steps in values, also beside shares of the
// window.
constexpr const char *schema = "pellucid-preset/2", *firstSchema = "pellucid-preset/1";
constexpr int longestName = 80; // characters

// Reads a text and counts lines. The parser reads one character beyond a number, so a line ends
// only when the first character of the next one is read.
struct LineReader {
    using iterator_category = std::forward_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char *;
    using reference = const char &;

    const char *at = nullptr, *begin = nullptr;
    int *line = nullptr;

    reference operator*() const { return *at; }
    LineReader &operator++() {
        if (at != begin && at[-1] == '\n')
            ++*line;
        ++at;
        return *this;
    }
    LineReader operator++(int) {
        LineReader before = *this;
        ++*this;
        return before;
    }
    bool operator==(const LineReader &other) const { return at == other.at; }
};

// The line of every value, by JSON pointer.
class Lines : public json::json_sax_t {
public:
    explicit Lines(const std::string &text) {
        const char *const first = text.data();
        json::sax_parse(LineReader{first, first, &m_line},
                        LineReader{first + text.size(), first, &m_line}, this);
    }
    // The line of a value, or of the nearest enclosing one.
    int of(std::string pointer) const {
        for (;;) {
            const auto found = m_lines.find(pointer);
            if (found != m_lines.end())
                return found->second;
            const auto slash = pointer.rfind('/');
            if (slash == std::string::npos)
                return 1;
            pointer.resize(slash);
        }
    }
    // Where and why parsing stopped; empty if it did not.
    const std::string &failure() const { return m_failure; }

    bool null() override { return value(); }
    bool boolean(bool) override { return value(); }
    bool number_integer(number_integer_t) override { return value(); }
    bool number_unsigned(number_unsigned_t) override { return value(); }
    bool number_float(number_float_t, const string_t &) override { return value(); }
    bool string(string_t &) override { return value(); }
    bool binary(binary_t &) override { return value(); }
    bool start_object(std::size_t) override { return open(false); }
    bool start_array(std::size_t) override { return open(true); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t &name) override {
        m_levels.back().key = name;
        return true;
    }
    bool parse_error(std::size_t, const std::string &, const json::exception &error) override {
        // "parse error at line 3, column 5: what", or "what".
        m_failure = files::jsonFault(error);
        if (m_failure.rfind("parse error at", 0) == 0)
            m_failure = m_failure.substr(m_failure.find(": ") + 2);
        return false;
    }
    int line() const { return m_line; }

private:
    struct Level {
        bool isArray = false;
        std::size_t index = 0;
        std::string key;
    };
    std::string pointer() const {
        std::string text;
        for (const Level &level : m_levels)
            text += "/" + (level.isArray ? std::to_string(level.index) : level.key);
        return text;
    }
    void next() {
        if (!m_levels.empty() && m_levels.back().isArray)
            ++m_levels.back().index;
    }
    bool value() {
        m_lines[pointer()] = m_line;
        next();
        return true;
    }
    bool open(bool isArray) {
        // No preset is nested deeper.
        if (m_levels.size() >= 32) {
            m_failure = "it is nested too deeply";
            return false;
        }
        m_lines[pointer()] = m_line;
        m_levels.push_back({isArray, 0, {}});
        return true;
    }
    bool close() {
        m_levels.pop_back();
        next();
        return true;
    }

    int m_line = 1;
    std::vector<Level> m_levels;
    std::map<std::string, int> m_lines;
    std::string m_failure;
};

std::string textOrEmpty(const JsonValue &in) {
    return in ? in.text() : std::string();
}

// Counts the bytes that start a UTF-8 character.
std::ptrdiff_t characters(const std::string &text) {
    return std::count_if(text.begin(), text.end(),
                         [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
}

bool hasThresholdInValues(const classify::Look &look) {
    return std::any_of(look.classes.begin(), look.classes.end(), [](const auto &tissue) {
        return std::any_of(tissue.steps.begin(), tissue.steps.end(), [](const auto &step) {
            return step.kind == classify::StepKind::binarise && step.parameters.contains("from");
        });
    });
}

Preset parsed(const JsonValue &in, const std::string &source) {
    if (!in.isObject())
        in.refuse(because::mustBeAnObject);
    const bool isFirst = textOrEmpty(in["schema"]) == firstSchema;
    if (!isFirst && textOrEmpty(in["schema"]) != schema)
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
    preset.look = classify::lookFromJson(source);
    if (isFirst && preset.unit == RangeUnit::window && hasThresholdInValues(preset.look))
        in["units"].refuse(because::binariseIsInValues);
    preset.shading = shading::shadingFromJson(source);
    preset.source = source;
    return preset;
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

Preset presetFromJson(const std::string &text) {
    const Lines lines(text);
    if (!lines.failure().empty())
        throw Error(ErrorCode::unusable, because::atLine(lines.line(), lines.failure()));
    try {
        const json in = json::parse(text);
        return parsed(JsonValue(in), text);
    } catch (const Error &error) {
        const task::Reason &reason = error.reason();
        throw Error(ErrorCode::unusable,
                    because::atLine(lines.of(files::jsonPointer(reason)), reason));
    }
}

std::string toJson(const Preset &preset) {
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
    out.update(json::parse(classify::toJson(preset.look)));
    out.update(json::parse(shading::toJson(preset.shading)));
    if (out.contains("classes"))
        for (json &tissue : out["classes"]) {
            const auto former =
                std::find_if(formerClasses.begin(), formerClasses.end(), [&](const json &c) {
                    return c.is_object() && c.value("name", json()) == tissue["name"];
                });
            if (former != formerClasses.end())
                tissue = joined(*former, tissue);
        }
    return out.dump(2, ' ', false, json::error_handler_t::replace);
}

} // namespace pellucid::presets
