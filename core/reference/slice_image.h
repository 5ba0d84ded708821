// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "core/scene/camera.h"
#include "core/scene/image_definition.h"
#include "core/volume/lattice.h"

namespace pellucid::reference {

/// D(s) of a sampled field about the centre of its lattice. *Units*: s in cycles per mm. `values`
/// receives one value per frequency.
using SpectrumSampler = std::function<void(const std::vector<glm::dvec3> &frequencies,
                                           std::vector<std::complex<double>> &values)>;

/// The period of exact images, pixels. It is wider than projection and picture together by six
/// times the length over which the response of the roll-off fades, so that hardly any of its tails
/// fold back into the picture. Error statements predict the rest from the period.
struct Period {
    int columns = 0, rows = 0;
};
Period periodOf(const volume::Lattice &lattice, const scene::Camera &camera,
                const scene::ImageDefinition &image);

/// The image p(u,v) of a spectrum in double, directly from its definition: every frequency of the
/// disc, multiplied by K and t, and an inverse transform on the period of `periodOf`. *Shape*:
/// camera.height x camera.width.
std::vector<double> sliceImage(const SpectrumSampler &spectrum, const volume::Lattice &lattice,
                               const scene::Camera &camera, const scene::ImageDefinition &image);

/// The memory for such an image besides the spectrum.
std::size_t sliceBytes(const volume::Lattice &lattice, const scene::Camera &camera,
                       const scene::ImageDefinition &image);

} // namespace pellucid::reference
