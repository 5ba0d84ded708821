// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/picture/projection_image.h"

namespace pellucid::accuracy {

/// The energy of a picture, and its part at the edge of the band, where the tails of the roll-off
/// come from.
struct PictureSums {
    double energy = 0.0; ///< sum of the squared pixels
    /// The share of the energy within 0.06 cycles per pixel of the highest frequency, along each
    /// axis, relative to that of white noise.
    double across = 0.0, down = 0.0;
};

/// The sums of one channel of a picture.
PictureSums pictureSums(const picture::ProjectionImage &picture, int channel);

} // namespace pellucid::accuracy
