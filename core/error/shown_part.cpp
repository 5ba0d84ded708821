// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error/shown_part.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace pellucid::error {

bool showsAllOf(const volume::VoxelBox &box, const volume::Lattice &lattice,
                const scene::Camera &camera) {
    const glm::dmat3 axes = camera.axes();
    const double halfU = 0.5 * camera.width * camera.pixelMm,
                 halfV = 0.5 * camera.height * camera.pixelMm;
    for (const int i : {box.lo.i, box.hi.i})
        for (const int j : {box.lo.j, box.hi.j})
            for (const int k : {box.lo.k, box.hi.k}) {
                const glm::dvec3 corner =
                    lattice.patient(volume::VoxelPoint{{i - 0.5, j - 0.5, k - 0.5}}).mm -
                    lattice.center().mm;
                if (std::abs(glm::dot(axes[0], corner) - camera.panMm.x) > halfU ||
                    std::abs(glm::dot(axes[1], corner) - camera.panMm.y) > halfV)
                    return false;
            }
    return true;
}

} // namespace pellucid::error
