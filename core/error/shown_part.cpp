// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error/shown_part.h"

#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace pellucid::error {

double shownShare(const volume::VoxelBox &box, const volume::Lattice &lattice,
                  const scene::Camera &camera) {
    const glm::dmat3 axes = camera.axes();
    glm::dvec2 low(std::numeric_limits<double>::max()), high(-low);
    for (const int i : {box.lo.i, box.hi.i})
        for (const int j : {box.lo.j, box.hi.j})
            for (const int k : {box.lo.k, box.hi.k}) {
                const glm::dvec3 corner =
                    lattice.patient(volume::VoxelPoint{{i - 0.5, j - 0.5, k - 0.5}}).mm -
                    lattice.center().mm;
                const glm::dvec2 at =
                    glm::dvec2(glm::dot(axes[0], corner), glm::dot(axes[1], corner)) - camera.panMm;
                low = glm::min(low, at);
                high = glm::max(high, at);
            }
    const glm::dvec2 half = 0.5 * camera.pixelMm * glm::dvec2(camera.width, camera.height),
                     shown = glm::max(glm::min(high, half) - glm::max(low, -half), 0.0),
                     all = high - low;
    return shown.x / all.x * (shown.y / all.y);
}

} // namespace pellucid::error
