// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/field/energy_marginals.h"
#include "core/scene/camera.h"
#include "core/scene/image_definition.h"

namespace pellucid::plan {

/// The energy, relative to the point's own, of the tails of a point's copies in an image of `side`
/// pixels. The point is `offset` pixels from the middle of the image; its copies are `period`
/// pixels apart. The mean over the samples that may be there.
double tailInImage(double rollOff, int period, int side, double offset);

/// The energy, relative to the whole projection's, of roll-off tails that fold back along one axis
/// of an image of `side` pixels, panned by `pan` pixels, from copies of the projection `period`
/// pixels away. It is the larger of two values: the mean in the worst direction, times a margin,
/// and that of a pattern that is regular from end to end.
///
/// A point at x from the centre of rotation has copies at r = period - side/2 -+ x. The response of
/// a sharp disc to a point falls as r^-3/2; a roll-off over the share F of the band multiplies it
/// by cos(pi F r/2)/(1 - (F r)^2). A point has all frequencies in equal measure; in a smooth
/// projection only the part at the edge of the band has tails, which is the roughness of its
/// energy.
double foldedTailEnergy(const field::EnergySpread &spread, const scene::ImageDefinition &image,
                        double pixelMm, int period, int side, double pan);

/// The share of a projection's energy in the image of a camera, by its area.
double shareInImage(const scene::Camera &camera, const field::EnergySpread &spread);

/// The relative L2 error that the tails along both axes make in the image of a camera.
double predictFoldedTails(const scene::ImageDefinition &image, const scene::Camera &camera,
                          int columns, int rows, const field::EnergySpread &spread);

} // namespace pellucid::plan
