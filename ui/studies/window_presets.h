// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/volume/volume.h"

namespace pellucid::ui {

/// A display window of the user's list, for values of one unit.
struct WindowPreset {
    volume::ValueWindow window;
    volume::ValueUnit unit = volume::ValueUnit::hounsfield;
    bool operator==(const WindowPreset &) const = default;
};

inline constexpr std::size_t maxWindowPresets = 100;

/// Brain, Abdomen, Mediastinum, Bone, Lung, Stroke, Subdural and Angiography for HU; three ranges
/// for SUV.
std::vector<WindowPreset> defaultWindowPresets();
/// The user's list, from the settings; the defaults if there is none. Invalid entries are left out.
std::vector<WindowPreset> windowPresets();
/// Stores the user's list in the settings; the defaults are not stored.
void storeWindowPresets(const std::vector<WindowPreset> &presets);

/// The 0.5 to 99.5 % quantiles.
volume::ValueWindow automaticWindow(const volume::Volume &volume);

/// The window that a volume opens with: the file's first, otherwise a standard or the automatic
/// one.
volume::ValueWindow initialWindow(const volume::Volume &volume);

} // namespace pellucid::ui
