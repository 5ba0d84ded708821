// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mpr/highest_along.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace pellucid::mpr {

std::optional<volume::PatientPoint>
highestAlong(const volume::Volume &volume, const volume::VoxelBox &box, volume::PatientPoint point,
             const glm::dvec3 &direction, const volume::Coverage *seen) {
    const volume::Lattice &lattice = volume.lattice();
    // In units of samples the line has another direction, and another length.
    const glm::dvec3 from = lattice.voxel(point).v;
    const glm::dvec3 along = lattice.voxel({point.mm + direction}).v - from;
    const double step = 0.5 / std::max({std::abs(along.x), std::abs(along.y), std::abs(along.z)});
    // All of the box is within this distance of the point.
    const double reach = glm::length(lattice.center().mm - point.mm) + lattice.radiusMm();
    std::optional<volume::PatientPoint> highest;
    double value = 0.0;
    for (double t = -reach; t <= reach; t += step) {
        const glm::dvec3 v = glm::clamp(glm::round(from + t * along), -1e9, 1e9);
        const volume::VoxelIndex n{int(v.x), int(v.y), int(v.z)};
        if (!box.contains(n))
            continue;
        const double here = volume.value(n);
        if (!std::isfinite(here) || (seen != nullptr && 2 * seen->at(n) < volume::Coverage::whole))
            continue;
        if (!highest || here > value) {
            highest = lattice.patient(n);
            value = here;
        }
    }
    return highest;
}

} // namespace pellucid::mpr
