// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "core/plan/folded_tails.h"
#include "core/scene/camera.h"
#include "core/scene/image_definition.h"
#include "core/volume/lattice.h"

namespace pellucid::reference {

/// D(s) of a sampled field about the centre of its lattice, *Units*: s in cycles per mm.
/// `values` receives one value per frequency.
using SpectrumSampler = std::function<void(const std::vector<glm::dvec3> &frequencies,
                                           std::vector<std::complex<double>> &values)>;

/// The image p(u,v) of a spectrum, in double, straight from its definition: every frequency of the
/// disc, multiplied by K and t, and an inverse transform on a period so much wider than the
/// projection that the tails of the roll-off do not fold back into the picture. *Shape*:
/// camera.height x camera.width.
std::vector<double> sliceImage(const SpectrumSampler &spectrum, const volume::Lattice &lattice,
                               const scene::Camera &camera, const scene::ImageDefinition &image);

/// Bytes that making such an image takes, beside the spectrum.
std::size_t sliceBytes(const volume::Lattice &lattice, const scene::Camera &camera,
                       const scene::ImageDefinition &image);

/// What is left of the roll-off's tails, relative L2; see plan::predictFoldedTails.
double foldedTails(const volume::Lattice &lattice, const scene::Camera &camera,
                   const scene::ImageDefinition &image, const plan::EnergySpread &spread);

} // namespace pellucid::reference
