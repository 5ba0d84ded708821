// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/fourier/spectrum.h"
#include "core/plan/slice_grid.h"

namespace pellucid::render {

/// The position of a view's slice in a spectrum: what every engine starts from.
struct FrameGeometry {
    FrameGeometry() = default;
    FrameGeometry(const scene::Camera &camera, const plan::SliceGrid &grid,
                  const fourier::Spectrum &spectrum);

    /// Cells of the spectrum per column and per row of the slice, by axis. Image rows run downward,
    /// against V.
    std::array<double, 3> cellsPerColumn{}, cellsPerRow{};
    bool wraps = false; ///< some |a_d.s| of the disc exceeds 1/2
    /// Turns of exp(+i 2 pi turns) per column and per row that move the wrap voxel and the first
    /// pixel to their positions.
    double turnsPerColumn = 0.0, turnsPerRow = 0.0;
    /// Tolerances by axis, in cells. A coordinate within this distance of a kernel's far edge
    /// counts as on the edge, and mirrored cells are read only where x is further below 0 than
    /// this. Kernels may jump at their edges, so where a view meets the grid, rounding alone must
    /// not decide which of two cells is read. Larger than the rounding of the float offsets within
    /// 16 columns and 16 rows.
    std::array<float, 3> edgeSlack{};
    double cellArea = 0.0;  ///< of the frequency grid, 1/mm^2
    glm::dvec3 toWrap{0.0}; ///< from the centre of rotation to the wrap voxel, mm
};

/// Keeps the slice grid from one view to the next. A new grid is computed, in a fraction of a
/// millisecond, only for a new framing, not for each direction.
class FramedGrid {
public:
    /// *Throws* Error{outOfMemory} as `sliceGrid` does.
    const plan::SliceGrid &gridFor(const scene::Camera &camera,
                                   const plan::FieldOfView &fieldOfView,
                                   const volume::Lattice &lattice,
                                   const scene::ImageDefinition &image);
    /// A camera whose picture is the whole period of that of another, pixel on pixel. It keeps the
    /// grid of the other until another framing is asked for. *Throws* as above.
    scene::Camera periodOf(const scene::Camera &camera, const plan::FieldOfView &fieldOfView,
                           const volume::Lattice &lattice, const scene::ImageDefinition &image);

private:
    static scene::Camera framingOf(const scene::Camera &camera);
    struct Framed {
        scene::Camera camera; // except its orientation
        scene::ImageDefinition image;
        plan::SliceGrid grid;
    };
    std::optional<Framed> m_framed;
};

} // namespace pellucid::render
