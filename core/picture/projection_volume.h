// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/picture/projection_image.h"
#include "core/scene/camera.h"
#include "core/volume/volume.h"

namespace pellucid::picture {

/// A grey projection as a volume of one slice, positioned at the picture's plane in patient space.
/// *Shape*: `patient`: that of the projected volume.
volume::Volume projectionVolume(const ProjectionImage &image, const scene::Camera &camera,
                                const volume::Lattice &patient);

} // namespace pellucid::picture
