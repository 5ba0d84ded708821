// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/preprocess/mask.h"
#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::preprocess {

/// The patient: the largest part above air (-400 HU, or Otsu's threshold) that is thicker than the
/// shell of a couch; others that are solid and as round in each slice as an arm or a leg; thin,
/// short parts that touch them (ears, nose, fingers); all that a slice encloses; and a margin. In
/// HU, dense shells that touch the skin are left out. It is found in means of samples finer than
/// 2 mm. *Throws* Error{outOfMemory}, Error{internal}, Cancelled.
Mask body(const volume::Volume &volume, double marginMm, const task::Progress &progress = {});
/// The part of the body and its margin that is at most a depth below the body's surface.
Mask skin(const volume::Volume &volume, double depthMm, double marginMm,
          const task::Progress &progress = {});

} // namespace pellucid::preprocess
