// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/picture/projection_volume.h"

#include <cassert>

namespace pellucid::picture {

volume::Volume projectionVolume(const ProjectionImage &image, const scene::Camera &camera,
                                const volume::Lattice &patient) {
    assert(image.channels == 1);
    const glm::dmat3 axes = camera.axes();
    const glm::dvec3 right = camera.pixelMm * axes[0], down = -camera.pixelMm * axes[1];
    const glm::dvec3 center =
        patient.center().mm + camera.panMm.x * axes[0] + camera.panMm.y * axes[1];
    const glm::dvec3 origin =
        center - 0.5 * (camera.width - 1) * right - 0.5 * (camera.height - 1) * down;
    const auto lattice = volume::Lattice::make({image.width, image.height, 1}, {origin},
                                               {right, down, -camera.pixelMm * axes[2]});
    return volume::Volume(lattice, std::vector<float>(image.samples.begin(), image.samples.end()),
                          volume::ValueUnit::none);
}

} // namespace pellucid::picture
