// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QImage>

#include "core/classify/tissue_class.h"
#include "core/mpr/reslice.h"

namespace pellucid::ui {

/// Values through a window as grey, with as much of a class's color as they belong to it. Outside
/// the volume is black, inverted or not.
QImage slicePicture(const mpr::SliceImage &slice, const volume::ValueWindow &window,
                    bool darkIsHigh, const std::optional<classify::TissueClass> &tint);

} // namespace pellucid::ui
