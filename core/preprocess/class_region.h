// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/classify/class_samples.h"
#include "core/volume/coverage.h"

namespace pellucid::preprocess {

/// The samples that belong to a class, without the fading of its edges: those whose membership is
/// at least a half, with the shares of its segment, if it has one. A segment's own samples are thus
/// the same as in its file. Empty if there are none. *Throws* as `StepRunner::run`.
volume::Coverage regionOf(const volume::Volume &volume, classify::TissueClass tissue,
                          classify::StepRunner &runner, const task::Progress &progress = {});

} // namespace pellucid::preprocess
