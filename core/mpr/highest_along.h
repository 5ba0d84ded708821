// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/volume/coverage.h"
#include "core/volume/volume.h"

namespace pellucid::mpr {

/// The sample with the highest finite value on a line through a point, among the samples of a box
/// that are nearest to the line at steps of half a sample. Not set if the line misses them.
/// `direction`: a unit vector, LPS. `seen`: only samples that are mostly in it; null: all.
std::optional<volume::PatientPoint>
highestAlong(const volume::Volume &volume, const volume::VoxelBox &box, volume::PatientPoint point,
             const glm::dvec3 &direction, const volume::Coverage *seen = nullptr);

} // namespace pellucid::mpr
