// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/presets/preset.h"

#include <memory>
#include <system_error>
#include <utility>

#include "core/classify/region_edits.h"
#include "core/files/atomic_file.h"
#include "core/files/read_text.h"
#include "core/presets/reasons.h"
#include "core/task/error.h"

namespace pellucid::presets {

namespace {

namespace fs = std::filesystem;
using classify::FieldWindow;
using classify::Look;
using classify::StepKind;
using classify::TissueClass;
using task::Error;
using task::ErrorCode;

// The thresholds to convert: only those set, or also the defaults of edges and binarise, which are
// in units of the values.
enum class Thresholds { given, all };

// Applies `offset` and `scale` to ranges and thresholds of values, and `scale` to those of slopes.
TissueClass mapped(TissueClass tissue, double offset, double scale, Thresholds thresholds) {
    bool isSlope = false; // the class uses a gradient instead of values
    const auto value = [&](double v) { return (isSlope ? 0.0 : offset) + scale * v; };
    for (classify::Step &step : tissue.steps) {
        for (const char *name : {"low", "high"}) {
            const bool isGiven = step.parameters.contains(name);
            if (step.kind == StepKind::edges && (isGiven || thresholds == Thresholds::all))
                step.parameters[name] = scale * step.at(name);
            if (step.kind == StepKind::threshold && isGiven)
                step.parameters[name] = value(step.at(name));
        }
        if (step.kind == StepKind::binarise &&
            (step.parameters.contains("from") || thresholds == Thresholds::all))
            step.parameters["from"] = value(step.at("from"));
        if (step.operand.own)
            step.operand.own = std::make_shared<const TissueClass>(
                mapped(*step.operand.own, offset, scale, thresholds));
        isSlope = isSlope || step.kind == StepKind::gradient;
    }
    // Ends that limit nothing stay.
    if (tissue.low > classify::lowestValue)
        tissue.low = value(tissue.low);
    if (tissue.high < classify::highestValue)
        tissue.high = value(tissue.high);
    tissue.softness *= scale;
    return tissue;
}

Look mapped(Look look, double offset, double scale, Thresholds thresholds) {
    for (TissueClass &tissue : look.classes)
        tissue = mapped(std::move(tissue), offset, scale, thresholds);
    return look;
}

} // namespace

Look lookFor(const Preset &preset, const FieldWindow &window) {
    if (preset.unit == RangeUnit::value)
        return preset.look;
    return mapped(preset.look, window.low, window.high - window.low, Thresholds::given);
}

std::optional<task::Reason> mismatch(const Preset &preset, const volume::Volume &volume) {
    const std::string &modality = volume.notes().modality;
    if (!preset.modality.empty() && !modality.empty() && preset.modality != modality)
        return task::because::presetIsForOther(preset.name, preset.modality, modality);
    if (preset.modality == "CT" && preset.unit == RangeUnit::value &&
        volume.unit() != volume::ValueUnit::hounsfield)
        return task::because::presetIsForHounsfield(preset.name);
    return std::nullopt;
}

Preset presetOf(const std::string &name, const Look &look, const shading::Shading &shading,
                const FieldWindow &window, const volume::Volume &volume) {
    Preset preset;
    preset.name = name;
    preset.modality = volume.notes().modality;
    preset.look = classify::withoutMarks(look); // those belong to one study
    preset.shading = shading;
    const double width = window.high - window.low;
    if (volume.unit() == volume::ValueUnit::hounsfield) {
        preset.window = window;
    } else if (width > 0.0) {
        preset.unit = RangeUnit::window;
        preset.look = mapped(preset.look, -window.low / width, 1.0 / width, Thresholds::all);
    }
    return preset;
}

Preset readPreset(const fs::path &path) {
    const std::string text = files::readText(path, files::maxPresetBytes);
    try {
        return presetFromJson(text);
    } catch (const Error &error) {
        throw Error(error.code(), error.reason(), path);
    }
}

void writePreset(const fs::path &path, const Preset &preset) {
    const std::string text = toJson(preset) + "\n";
    files::AtomicFile file(path);
    file.write(text);
    file.commit();
}

} // namespace pellucid::presets
