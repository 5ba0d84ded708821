// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/dicom/catalogue.h"
#include "core/task/progress.h"

namespace pellucid::dicom {

/// Interpolates the slices of an uneven stack linearly along the stack, from the frames' positions
/// to the lattice's. *Shape*: `frames` are complete planes of the lattice, int16 or float; the
/// geometry has their offsets. *Throws* Cancelled.
template <class T>
std::vector<T> resampled(const std::vector<T> &frames, const StackGeometry &geometry,
                         const task::Progress &progress);

} // namespace pellucid::dicom
