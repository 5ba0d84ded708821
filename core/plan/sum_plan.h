// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "core/plan/render_plan.h"

namespace pellucid::plan {

/// Whether a picture may be made by summing the samples of a box along its view
/// (`plan::ShearedGrid`), which then takes less time than transforming them. Only for a single
/// picture, without cue and light, and if the scene sets no kernel, padding or storage.
bool sumsPay(const scene::Scene &scene, const volume::Lattice &lattice, const volume::VoxelBox &box,
             const Composition &composition);

/// The plan for such a picture; none if it misses the tolerance, or if samples are negative. Does
/// not fit itself to a memory. *Shape*: the layout has no cells, only the box. *Throws* as
/// `sliceGrid`, Error{usage} as `planRender`.
std::optional<RenderPlan> planSums(const scene::Scene &scene,
                                   std::span<const field::Summary> fields,
                                   const Composition &composition);

/// An upper bound on the relative L2 error of sums along any view of a box of this size, relative
/// to the whole projection, before the tails that fold back.
double sumError(const volume::GridSize &size);

} // namespace pellucid::plan
