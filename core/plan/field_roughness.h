// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/volume/field.h"

namespace pellucid::plan {

/// The sum of the squared second differences of a field along all three axes, from which
/// `EnergySpread::roughestView` follows. The field is zero outside the box.
double squaredSecondDifferences(const volume::Field &field, const volume::VoxelBox &box);

} // namespace pellucid::plan
