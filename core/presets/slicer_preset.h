// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/presets/preset.h"

namespace pellucid::presets {

/// A preset made of a 3D Slicer volume property, and how well it fits.
struct ImportedPreset {
    Preset preset;
    /// Largest difference between f B(f) and the opacity, over the window.
    double largestError = 0.0;
};

/// Whether a path ends as 3D Slicer's files do: .vp or .vp.json.
bool isSlicerPreset(const std::filesystem::path &path);

/// The scalar opacity of a `.vp` or `.vp.json` file as a transfer function of so many points over
/// the window from where the opacity begins to where it ends to change: f B(f) is the curve nearest
/// to the opacity. Colours and gradient opacity have no counterpart in one curve and are left out.
/// *Throws* Error{unusable} naming the file, the line where there is one, and the reason.
ImportedPreset importSlicerPreset(const std::filesystem::path &path, int points = 8);

} // namespace pellucid::presets
