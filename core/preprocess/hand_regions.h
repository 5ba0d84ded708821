// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/classify/class_samples.h"
#include "core/classify/hand_marks.h"
#include "core/preprocess/mask.h"
#include "core/task/progress.h"

namespace pellucid::preprocess {

/// Adds the samples that strokes cover, and erases those that erasing strokes cover, one stroke
/// after the other. The sample nearest to each point of a path is covered even by a ball that is
/// smaller than it. *Shape*: `regions` has one of each sample. *Throws* Cancelled.
void paint(const volume::Lattice &lattice, const std::vector<classify::Stroke> &strokes,
           std::vector<classify::Region> &regions, const task::Progress &progress = {});

/// The samples that remain after cuts: those whose centres are outside the prisms, or inside those
/// that are kept. A centre is in a prism if the outline winds around it. *Throws*
/// Error{outOfMemory}, Cancelled.
Mask remaining(const volume::Lattice &lattice, const std::vector<classify::LassoCut> &cuts,
               const task::Progress &progress = {});

} // namespace pellucid::preprocess
