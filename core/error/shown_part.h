// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/camera.h"
#include "core/volume/lattice.h"

namespace pellucid::error {

/// Whether the picture of a camera shows all of a box of samples, each as wide as a step.
bool showsAllOf(const volume::VoxelBox &box, const volume::Lattice &lattice,
                const scene::Camera &camera);

} // namespace pellucid::error
