// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/field/energy_marginals.h"
#include "core/scene/camera.h"
#include "core/scene/image_definition.h"

namespace pellucid::plan {

/// An upper bound on the energy, relative to the whole projection's, of roll-off tails that fold
/// back along one axis of an image of `side` pixels, panned by `pan` pixels, from copies of the
/// projection `period` pixels away. It is that of a pattern that is regular from end to end, whose
/// tails add up in phase, and which has all the energy that the projection may have in the
/// roll-off. For a field with negative samples that share is a mean, and so is this.
double foldedTailEnergy(const field::EnergySpread &spread, const scene::ImageDefinition &image,
                        double pixelMm, int period, int side, double pan);

/// The share of a projection's energy in the image of a camera, by its area.
double shareInImage(const scene::Camera &camera, const field::EnergySpread &spread);

/// The relative L2 error that the tails along both axes make in the image of a camera.
double predictFoldedTails(const scene::ImageDefinition &image, const scene::Camera &camera,
                          int columns, int rows, const field::EnergySpread &spread);

} // namespace pellucid::plan
