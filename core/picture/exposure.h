// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/picture/projector.h"
#include "core/scene/tone.h"
#include "core/volume/volume.h"

namespace pellucid::picture {

/// The brightness beside the body: zero, as in projections of HU, or a level that has to be
/// measured, as in projections of values without a unit.
enum class Background { zero, measured };

/// Measures the brightness of a study from three small projections of the whole volume, along the
/// patient's x, y and z, in which only the body counts. The same study, look and shading always
/// have the same exposure, whatever the view. `tone`: its detail and latitude; automatic ones are
/// chosen from the projections. `lattice`: of the volume. *Throws* as `Projector::render`.
scene::Exposure measureExposure(Projector &projector, const volume::Lattice &lattice,
                                const scene::ImageDefinition &image,
                                const shading::Shading &shading, const scene::Tone &tone,
                                Background background);
/// The background of projections of a volume.
Background backgroundOf(const volume::Volume &volume);

/// From one picture, for every line of sight: for a picture that will not turn. Its box is empty.
/// `outlineMm2`: the area of the volume in it; 0 if unknown.
scene::Exposure exposureOf(const ProjectionImage &picture, const scene::Tone &tone,
                           Background background = Background::zero, double outlineMm2 = 0.0);

/// The area of a volume's outline in a parallel projection.
double outlineMm2(const volume::Lattice &lattice, const glm::dquat &orientation);

} // namespace pellucid::picture
