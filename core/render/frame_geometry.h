// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include <glm/vec3.hpp>

#include "core/fourier/spectrum.h"
#include "core/plan/slice_grid.h"

namespace pellucid::render {

/// How the slice of a view lies in a spectrum: what every engine starts from.
struct FrameGeometry {
    FrameGeometry() = default;
    FrameGeometry(const scene::Camera &camera, const plan::SliceGrid &grid,
                  const fourier::Spectrum &spectrum);

    /// Cells of the spectrum per column and per row of the slice, by axis. Image rows run downward,
    /// against V.
    std::array<double, 3> cellsPerColumn{}, cellsPerRow{};
    bool wraps = false; ///< some |a_d.s| of the disc exceeds 1/2
    /// Turns of exp(+i 2 pi turns) per column and per row that move the wrap voxel and the first
    /// pixel to where they are.
    double turnsPerColumn = 0.0, turnsPerRow = 0.0;
    /// By axis, cells: a coordinate that reaches the far edge of a kernel by less than this counts
    /// as on it, and mirrored cells are read only where x lies further below 0. Kernels may jump at
    /// their edges, so where a view meets the grid rounding alone must not decide which of two
    /// cells is read. Above the rounding of the float offsets of 16 neighbours.
    std::array<float, 3> edgeSlack{};
    double cellArea = 0.0;  ///< of the frequency grid, 1/mm^2
    glm::dvec3 toWrap{0.0}; ///< from the centre of rotation to the wrap voxel, mm
};

/// The slice grid of the frames of one view after another: sought, in a fraction of a millisecond,
/// for each new framing only, not for each direction.
class FramedGrid {
public:
    /// *Throws* Error{outOfMemory} as `sliceGrid` does.
    const plan::SliceGrid &gridFor(const scene::Camera &camera,
                                   const plan::FieldOfView &fieldOfView,
                                   const volume::Lattice &lattice,
                                   const scene::ImageDefinition &image);

private:
    struct Framed {
        scene::Camera camera; // but its orientation
        scene::ImageDefinition image;
        plan::SliceGrid grid;
    };
    std::optional<Framed> m_framed;
};

} // namespace pellucid::render
