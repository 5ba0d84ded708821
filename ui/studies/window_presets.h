// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/volume/volume.h"

namespace pellucid::ui {

/// A display window with the key that sets it.
struct WindowPreset {
    volume::ValueWindow window;
    int key = 0; ///< 1..9, 0 for none
};

/// Brain, Abdomen, Mediastinum, Bone and Lung on 1 to 5, for volumes in HU; none for others.
std::vector<WindowPreset> windowPresets(const volume::Volume &volume);

/// The 0.5 to 99.5 % quantiles.
volume::ValueWindow automaticWindow(const volume::Volume &volume);

/// The window that a volume opens with: the file's first, otherwise a standard or the automatic
/// one.
volume::ValueWindow initialWindow(const volume::Volume &volume);

} // namespace pellucid::ui
