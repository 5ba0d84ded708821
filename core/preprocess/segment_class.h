// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/classify/class_samples.h"
#include "core/classify/tissue_class.h"
#include "core/segment/segment_set.h"

namespace pellucid::preprocess {

/// The class that shows a segment whatever its values, in the color that its file recommends, or
/// else in one of a series of distinct colors. `index`: its place in that series.
classify::TissueClass classOf(const segment::Segment &segment, std::size_t index);

/// The samples of a class as a segment with its name, color and volume, and with the codes of the
/// segment that it shows, if any. Its coverage is empty if no sample belongs to the class.
/// `loaded`: may be null. *Throws* as `regionOf`.
segment::Segment segmentOf(const volume::Volume &volume, const classify::TissueClass &tissue,
                           const segment::SegmentSet *loaded, classify::StepRunner &runner,
                           const task::Progress &progress = {});

} // namespace pellucid::preprocess
