// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include "core/fourier/kernels/kernel.h"
#include "core/scene/camera.h"
#include "core/scene/image_definition.h"

namespace pellucid::plan {

/// A projection depends only on positions across the view. The planes of a lattice can therefore be
/// shifted and summed: sample n of plane p lands at n - shear (p - middle) on each of the two other
/// axes. For frequencies s across the view the sums have the same spectrum as the volume,
///   D(s) = sum over samples of f exp(-2 pi i sum_d q_d x_d), q_d = a_d.s, over two axes d.
/// *Source*: the factorization of Lacroute and Levoy 1994, without its resampling.
struct ShearedAxis {
    int axis = 0;       ///< of the lattice
    double shear = 0.0; ///< samples along this axis per plane
    /// Whether samples fall between cells, so that a kernel spreads them.
    bool isSpread = false;
    int cellsPerSample = 1;
    int cells = 0;      ///< that samples can reach
    int padded = 0;     ///< cells of the transform
    double first = 0.0; ///< the position of cell 0: samples from the middle of the lattice
    double band = 0.0;  ///< the largest |q| that a picture has: cycles per sample

    /// The cell where frequencies see position 0.
    int middle() const { return cells / 2; }
    /// The position of that cell: samples from the middle of the lattice.
    double middlePosition() const { return first + double(middle()) / cellsPerSample; }
    /// Cells of the transform per cycle per sample.
    double cellsPerCycle() const { return double(padded) / cellsPerSample; }
    /// The farthest cell of the transform that a picture reads between. The transform is periodic.
    int reach() const;
};

/// The cells that hold the sums along one view.
struct ShearedGrid {
    /// For pictures of this direction, pixel and definition. *Units*: `toViewer`: the camera's W.
    ShearedGrid(const volume::Lattice &lattice, const volume::VoxelBox &box,
                const glm::dvec3 &toViewer, double pixelMm, const scene::ImageDefinition &image);

    int along = 0;          ///< the axis of the lattice whose planes are summed
    double alongBand = 0.0; ///< the largest |q| along it
    /// Along rows of cells, and across them.
    std::array<ShearedAxis, 2> axes;

    /// The memory for the cells, their transform, and what is read of it.
    std::size_t bytes() const;
};

/// Spreads samples over cells. All samples of a plane share its error, and the errors of planes add
/// up (`sumError`), so it is the more accurate of the two kernels: frequencies stay below a quarter
/// of a cycle per cell.
const fourier::Kernel &spreadKernel();
inline constexpr double spreadPadding = 2.0;
/// Reads the transform of the cells, which is padded by `readPadding`.
const fourier::Kernel &readKernel();
inline constexpr double readPadding = 1.5;

} // namespace pellucid::plan
