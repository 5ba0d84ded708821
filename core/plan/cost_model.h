// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/fourier/spectrum.h"
#include "core/plan/sheared_grid.h"
#include "core/plan/slice_grid.h"

namespace pellucid::plan {

/// The time to read a frequency sample whose cells are in the cache. *Units*: as `frameTime`.
double readTime(int width);
/// The time of a frequency sample whose cells are in the cache: its taps and its share of the
/// transforms. *Units*: as `frameTime`.
double timeInCache(int width, fourier::Storage storage);

/// The time of a frame with this slice grid from a spectrum with this layout. The planner compares
/// plans by it. *Units*: one is the time of a sample of kernel width 4 from binary16 cells in the
/// cache, without its share of the transforms.
double frameTime(const SliceGrid &grid, const scene::Camera &camera, const volume::Lattice &lattice,
                 const fourier::SpectrumLayout &layout);

/// The least padding of a spectrum. Below 1.2 the seam of a full lattice becomes visible.
inline constexpr double leastPadding = 1.25;
/// The time to prepare a spectrum with padded axes of these sizes. *Units*: as above.
double prepareTime(const volume::GridSize &padded);

/// The time to sum the samples of a box along a view, and to transform the sums. *Units*: as above.
double sumTime(const ShearedGrid &grid, const volume::VoxelBox &box);

/// Whether frames that choose their widths save more time than it takes to prepare the data for it.
/// `padded`: the padded sizes of the spectrum.
bool widthsPay(const SliceGrid &grid, const scene::Camera &camera, const volume::Lattice &lattice,
               const volume::GridSize &padded, int pictures);

/// The time to try one kernel at all paddings; each padding has its own kernel. *Units*: as above.
constexpr double searchTime = 1e6;

} // namespace pellucid::plan
