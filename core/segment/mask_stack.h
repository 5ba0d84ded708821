// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec2.hpp>

#include "core/segment/mask_pixels.h"

namespace pellucid::segment {

/// The columns and rows that a segment uses in any plane.
struct MaskExtent {
    glm::ivec2 low{1 << 30}, high{-1};
    bool isEmpty() const { return high.x < 0; }
};

/// The planes of one segment, interpolated on a lattice: linearly, but not across gaps. *Requires*:
/// the extent is not empty, and the planes are parallel. `thicknessMm`: the typical distance
/// between planes of all segments. *Throws* Error{outOfMemory}, Cancelled.
volume::Coverage interpolated(const StoredMasks &masks, const MaskPixels &pixels, int segment,
                              const MaskExtent &extent, double thicknessMm,
                              const volume::Lattice &lattice, const task::Progress &progress = {});

} // namespace pellucid::segment
