// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/presets/preset.h"

namespace pellucid::presets {

/// A preset converted from a 3D Slicer volume property, and the quality of the fit.
struct ImportedPreset {
    Preset preset;
    /// Largest difference between f B(f) and the opacity, over the window.
    double largestError = 0.0;
};

/// Whether a path has an extension of 3D Slicer's files: .vp or .vp.json.
bool isSlicerPreset(const std::filesystem::path &path);

/// Converts the scalar opacity of a `.vp` or `.vp.json` file to a transfer function with this many
/// points, over the window from where the opacity starts to where it stops changing: f B(f) is the
/// curve closest to the opacity. Colors and gradient opacity have no equivalent in one curve and
/// are omitted. *Throws* Error{unusable} naming the file, the line if there is one, and the reason.
ImportedPreset importSlicerPreset(const std::filesystem::path &path, int points = 8);

} // namespace pellucid::presets
