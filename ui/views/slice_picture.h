// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QImage>

#include "core/classify/tissue_class.h"
#include "core/mpr/reslice.h"

namespace pellucid::ui {

/// Shows values through a window as grey, tinted with a class's color by their membership. Outside
/// the volume is black, inverted or not.
QImage slicePicture(const mpr::SliceImage &slice, const volume::ValueWindow &window,
                    const std::optional<classify::TissueClass> &tint);

} // namespace pellucid::ui
