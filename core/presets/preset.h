// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/classify/density_field.h"
#include "core/classify/look.h"
#include "core/shading/shading.h"
#include "core/task/reason.h"

namespace pellucid::presets {

/// What the ranges of a preset's classes are measured in.
enum class RangeUnit {
    value, ///< value units: HU for CT
    window ///< shares of the field's window, 0 at its low end: for values without a scale, as of MR
};

/// A look that is kept under a name and used on other studies.
struct Preset {
    std::string name;
    std::string modality;                        ///< "CT", "MR", ...; empty: any
    std::optional<classify::FieldWindow> window; ///< none: the volume's own
    RangeUnit unit = RangeUnit::value;
    classify::Look look;
    shading::Shading shading;
    std::string notes;
    /// The JSON that it was read from: keys that this version does not know are written again.
    std::string source = "{}";
};

/// The look of a preset for a volume whose field has a window: ranges and thresholds in value
/// units.
classify::Look lookFor(const Preset &preset, const classify::FieldWindow &window);

/// Why a preset is not made for a volume, a line; empty if it is.
std::optional<task::Reason> mismatch(const Preset &preset, const volume::Volume &volume);

/// A look that is shown on a volume, as a preset: in HU for CT, by shares of the window otherwise.
Preset presetOf(const std::string &name, const classify::Look &look,
                const shading::Shading &shading, const classify::FieldWindow &window,
                const volume::Volume &volume);

/// JSON, `"schema": "pellucid-preset/1"`.
std::string toJson(const Preset &preset);
/// *Throws* Error{unusable}: "line N: /classes/2/range: must be two numbers".
Preset presetFromJson(const std::string &text);

/// A preset file. *Throws* Error{unusable} naming the file, the line and the reason; files above a
/// megabyte are refused unread.
Preset readPreset(const std::filesystem::path &path);
/// The file appears when it is complete. *Throws* Error{output}.
void writePreset(const std::filesystem::path &path, const Preset &preset);

} // namespace pellucid::presets
