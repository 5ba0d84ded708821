// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "core/classify/density_field.h"
#include "core/classify/look.h"
#include "core/presets/study_traits.h"
#include "core/shading/shading.h"
#include "core/task/reason.h"

namespace pellucid::presets {

/// The unit of a preset's class ranges.
enum class RangeUnit {
    value, ///< units of the values: HU for CT
    window ///< fractions of the field's window from its low end, for values without a scale such as
           ///< MR
};

/// A named look that can be applied to other studies.
struct Preset {
    std::string name;
    std::string modality;                        ///< "CT", "MR", ...; empty: any
    std::set<BodyRegion> regions;                ///< that it is meant for; empty: any
    bool needsContrast = false;                  ///< it shows contrast medium
    std::optional<classify::FieldWindow> window; ///< not set: the volume's own
    RangeUnit unit = RangeUnit::value;
    classify::Look look;
    shading::Shading shading;
    std::string notes;
    /// The JSON that it was read from, so that keys unknown to this version are preserved.
    std::string source = "{}";
};

/// A preset's look for a volume whose field has this window: ranges and thresholds in units of the
/// values.
classify::Look lookFor(const Preset &preset, const classify::FieldWindow &window);

/// Why a preset is not meant for a volume, in one line; empty if it is.
std::optional<task::Reason> mismatch(const Preset &preset, const volume::Volume &volume);

/// Makes a preset of a look that is shown on a volume, without the points, strokes and cuts that
/// belong to that: in HU for CT, else in fractions of the window.
Preset presetOf(const std::string &name, const classify::Look &look,
                const shading::Shading &shading, const classify::FieldWindow &window,
                const volume::Volume &volume);

/// JSON, `"schema": "pellucid-preset/2"`.
std::string toJson(const Preset &preset);
/// *Throws* Error{unusable}: "line N: /classes/2/range: must be two numbers".
Preset presetFromJson(const std::string &text);

/// Reads a preset file. *Throws* Error{unusable} naming the file, the line and the reason; files
/// above a megabyte are refused unread.
Preset readPreset(const std::filesystem::path &path);
/// The file appears only when complete. *Throws* Error{output}.
void writePreset(const std::filesystem::path &path, const Preset &preset);

} // namespace pellucid::presets
