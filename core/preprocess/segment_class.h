// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/classify/tissue_class.h"
#include "core/segment/segmentation.h"

namespace pellucid::preprocess {

/// The class that shows a segment whatever its values, in the color that its file recommends, or
/// else in one of a series of distinct colors. `index`: its place in that series.
classify::TissueClass classOf(const segment::Segment &segment, std::size_t index);

} // namespace pellucid::preprocess
