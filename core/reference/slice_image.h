// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "core/scene/camera.h"
#include "core/scene/image_definition.h"
#include "core/volume/lattice.h"

namespace pellucid::reference {

/// D(s) of a sampled field about the centre of its lattice, *Units*: s in cycles per mm.
/// `values` receives one value per frequency.
using SpectrumSampler = std::function<void(const std::vector<glm::dvec3> &frequencies,
                                           std::vector<std::complex<double>> &values)>;

/// The period of exact images, pixels: wider than the projection and the picture by six times the
/// length over which the response of the roll-off fades, so that next to nothing of its tails folds
/// back into the picture. What folds back, whoever states errors predicts from the period.
struct Period {
    int columns = 0, rows = 0;
};
Period periodOf(const volume::Lattice &lattice, const scene::Camera &camera,
                const scene::ImageDefinition &image);

/// The image p(u,v) of a spectrum, in double, straight from its definition: every frequency of the
/// disc, multiplied by K and t, and an inverse transform on the period of `periodOf`. *Shape*:
/// camera.height x camera.width.
std::vector<double> sliceImage(const SpectrumSampler &spectrum, const volume::Lattice &lattice,
                               const scene::Camera &camera, const scene::ImageDefinition &image);

/// Bytes that making such an image takes, beside the spectrum.
std::size_t sliceBytes(const volume::Lattice &lattice, const scene::Camera &camera,
                       const scene::ImageDefinition &image);

} // namespace pellucid::reference
