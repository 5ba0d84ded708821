// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/slice_grid.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/fourier/transforms/padded_size.h"
#include "core/plan/reasons.h"
#include "core/task/error.h"

namespace pellucid::plan {

namespace {

// Larger grids take more memory than any image is worth.
constexpr int largestSliceGrid = 65536;

// The largest distance of the projection from the centre of rotation in any view, in pixels.
double reachPixels(const scene::Camera &camera, const FieldOfView &fieldOfView,
                   const volume::Lattice &lattice, const scene::ImageDefinition &image) {
    double radiusMm = 0.0;
    for (const auto &spread : fieldOfView.spreads)
        radiusMm = std::max(radiusMm, spread->radiusMm);
    // The filter that amplifies detail falls by e every `detailMm`: to less than may fold into the
    // picture.
    const double folds =
        std::max(6.0, std::log((1.0 + image.detail) / std::max(1e-12, fieldOfView.aliasingLimit)));
    const double filterMm = image.detail > 0.0 ? folds * image.detailMm : 0.0;
    return (radiusMm + scene::reconstructionReach(image) * lattice.longestStepMm() + filterMm) /
           camera.pixelMm;
}

} // namespace

std::size_t frameBytes(const SliceGrid &grid, const scene::Camera &camera, int images) {
    const std::size_t lines = std::size_t(grid.columns) * grid.rows * 2,
                      pixels = std::size_t(camera.width) * camera.height;
    return (std::size_t(images) * lines + (images > 1 ? 3U : 1U) * pixels) * sizeof(float);
}

FieldOfView fieldOfViewOf(const volume::Lattice &lattice, const volume::VoxelBox &box) {
    return {{std::make_shared<const field::EnergySpread>(field::evenSpread(lattice, box))}};
}

SliceGrid sliceGrid(const scene::Camera &camera, const FieldOfView &fieldOfView,
                    const volume::Lattice &lattice, const scene::ImageDefinition &image) {
    const double projection = reachPixels(camera, fieldOfView, lattice, image);
    const auto cells = [&](int side, double panMm) {
        const double pan = std::abs(panMm) / camera.pixelMm;
        // A copy of the projection, a period away, must stay outside the image: its near edge lies
        // at period - radius, the image's far edge at half its size plus the pan.
        const double reach = projection + 0.5 * side + pan;
        if (!(reach < largestSliceGrid))
            throw task::Error(task::ErrorCode::outOfMemory,
                              task::because::sliceIsTooLarge(fmt::format("{:.3g}", camera.pixelMm),
                                                             fmt::format("{:.3g}", std::abs(panMm)),
                                                             largestSliceGrid));
        const auto keeps = [&](int period) {
            // Each axis may use half of the limit, relative to the image's share of the projection.
            return std::all_of(
                fieldOfView.spreads.begin(), fieldOfView.spreads.end(), [&](const auto &spread) {
                    return foldedTailEnergy(*spread, image, camera.pixelMm, period, side, pan) <=
                           0.5 * fieldOfView.aliasingLimit * fieldOfView.aliasingLimit *
                               shareInImage(camera, *spread);
                });
        };
        const int least = fourier::smoothEvenSize(int(std::ceil(reach)));
        const int most = std::min(largestSliceGrid, std::max(2048, 3 * least));
        if (keeps(least))
            return least;
        if (!keeps(most))
            return fourier::smoothEvenSize(most);
        int tooFew = least, enough = most; // the tails shrink as the period grows
        while (enough - tooFew > 1) {
            const int between = (tooFew + enough) / 2;
            (keeps(between) ? enough : tooFew) = between;
        }
        return fourier::smoothEvenSize(enough);
    };
    return {cells(camera.width, camera.panMm.x), cells(camera.height, camera.panMm.y)};
}

} // namespace pellucid::plan
