// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/frame_geometry.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace pellucid::render {

FrameGeometry::FrameGeometry(const scene::Camera &camera, const plan::SliceGrid &grid,
                             const fourier::Spectrum &spectrum) {
    const volume::Lattice &lattice = spectrum.lattice();
    const glm::dmat3 axes = camera.axes();
    const double du = 1.0 / (grid.columns * camera.pixelMm);
    const double dv = 1.0 / (grid.rows * camera.pixelMm);
    cellArea = du * dv;
    for (int d = 0; d < 3; ++d) {
        const int padded = spectrum.layout().padded[d];
        cellsPerColumn[std::size_t(d)] = padded * glm::dot(lattice.step(d), axes[0]) * du;
        cellsPerRow[std::size_t(d)] = -padded * glm::dot(lattice.step(d), axes[1]) * dv;
        // Offsets are up to 7.5 columns and 15 rows; products and steps are rounded.
        edgeSlack[std::size_t(d)] = 2e-6F * float(1.0 + std::abs(cellsPerColumn[std::size_t(d)]) +
                                                  std::abs(cellsPerRow[std::size_t(d)]));
        wraps = wraps || lattice.spacingMm(d) > camera.pixelMm * (1.0 + 1e-9);
    }
    toWrap = spectrum.wrapPoint().mm - lattice.center().mm;
    const double firstU = camera.panMm.x - 0.5 * (camera.width - 1) * camera.pixelMm;
    const double firstV = camera.panMm.y + 0.5 * (camera.height - 1) * camera.pixelMm;
    turnsPerColumn = du * (firstU - glm::dot(axes[0], toWrap));
    turnsPerRow = -dv * (firstV - glm::dot(axes[1], toWrap));
}

const plan::SliceGrid &FramedGrid::gridFor(const scene::Camera &camera,
                                           const plan::FieldOfView &fieldOfView,
                                           const volume::Lattice &lattice,
                                           const scene::ImageDefinition &image) {
    const scene::Camera framing = framingOf(camera);
    if (!m_framed || m_framed->camera != framing || m_framed->image != image)
        m_framed = Framed{framing, image, plan::sliceGrid(camera, fieldOfView, lattice, image)};
    return m_framed->grid;
}

scene::Camera FramedGrid::periodOf(const scene::Camera &camera,
                                   const plan::FieldOfView &fieldOfView,
                                   const volume::Lattice &lattice,
                                   const scene::ImageDefinition &image) {
    const plan::SliceGrid grid = gridFor(camera, fieldOfView, lattice, image);
    scene::Camera whole = camera;
    whole.width = grid.columns;
    whole.height = grid.rows;
    // An odd number of pixels more on one side moves the middle by half a pixel.
    const auto moved = [&](int period, int side) {
        return camera.pixelMm * 0.5 * ((period - side) % 2);
    };
    whole.panMm.x += moved(grid.columns, camera.width);
    whole.panMm.y -= moved(grid.rows, camera.height);
    m_framed = Framed{framingOf(whole), image, grid};
    return whole;
}

scene::Camera FramedGrid::framingOf(const scene::Camera &camera) {
    scene::Camera framing = camera;
    framing.orientation = scene::Camera().orientation;
    return framing;
}

} // namespace pellucid::render
