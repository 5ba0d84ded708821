// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/picture/projection_image.h"
#include "core/scene/camera.h"
#include "core/volume/volume.h"

namespace pellucid::picture {

/// A projection without colour as a volume of one slice, which lies in the patient where the plane
/// of the picture does. *Shape*: `patient`: of the volume that was projected.
volume::Volume projectionVolume(const ProjectionImage &image, const scene::Camera &camera,
                                const volume::Lattice &patient);

} // namespace pellucid::picture
