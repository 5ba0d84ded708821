// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/plan/energy_marginals.h"
#include "core/scene/camera.h"
#include "core/scene/image_definition.h"

namespace pellucid::plan {

/// The energy, relative to its own, that the tails of a point's copies leave in an image of `side`
/// pixels, `offset` pixels from whose middle the point lies; its copies lie `period` pixels apart.
/// On average over what samples may lie there.
double tailInImage(double rollOff, int period, int side, double offset);

/// The energy, relative to the whole projection's, that the tails of the roll-off leave when they
/// fold back along one axis of an image of `side` pixels, panned by `pan` pixels, from copies of
/// the projection `period` pixels away. It is the larger of two: what the worst direction leaves on
/// average, with a margin, and what a pattern leaves that is regular from end to end.
///
/// What lies at x from the centre of rotation has copies at r = period - side/2 -+ x. A sharp
/// disc's response to a point falls as r^-3/2; a roll-off over the share F of the band multiplies
/// it by cos(pi F r/2)/(1 - (F r)^2). A point has all frequencies alike; of a smooth projection
/// only what lies at the edge of the band has tails, the roughness of its energy.
double foldedTailEnergy(const EnergySpread &spread, const scene::ImageDefinition &image,
                        double pixelMm, int period, int side, double pan);

/// The part of a projection's energy that the image of a camera holds, by its area.
double shareInImage(const scene::Camera &camera, const EnergySpread &spread);

/// The relative L2 error that the tails of both axes leave in the image of a camera.
double predictFoldedTails(const scene::ImageDefinition &image, const scene::Camera &camera,
                          int columns, int rows, const EnergySpread &spread);

} // namespace pellucid::plan
