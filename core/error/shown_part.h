// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/error/stated_error.h"
#include "core/scene/camera.h"
#include "core/volume/lattice.h"

namespace pellucid::error {

/// The share of the rectangle around a projected box of samples, each as wide as a step, that a
/// picture shows; 1 if it shows all of it.
double shownShare(const volume::VoxelBox &box, const volume::Lattice &lattice,
                  const scene::Camera &camera);

inline Shown shownOf(const volume::VoxelBox &box, const volume::Lattice &lattice,
                     const scene::Camera &camera) {
    return shownShare(box, lattice, camera) == 1.0 ? Shown::whole : Shown::part;
}

} // namespace pellucid::error
