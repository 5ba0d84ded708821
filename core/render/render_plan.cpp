// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/render_plan.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/fourier/padded_size.h"
#include "core/task/error.h"

namespace pellucid::render {

namespace {

// Width 5 at padding 1.5 keeps the ghosts of any field, one that fills its lattice to the corners
// included, below 7e-4.
constexpr int kernelWidth = 5;
constexpr double padding = 1.5;

// Larger slices take more memory than any image is worth.
constexpr int largestSliceGrid = 65536;

// How far a sample's footprint reaches, in samples: the tent ends after one; the cardinal B-spline
// has fallen to 4e-4 after six; the tapered sinc rings.
double footprint(const ImageDefinition &image) {
    switch (image.reconstruction) {
    case Reconstruction::linear:
        return 1.0;
    case Reconstruction::bandLimited:
        return 0.5 * ringingPixels(image.rollOff);
    case Reconstruction::cubic:
        break;
    }
    return 6.0;
}

// How far the projection reaches from the centre of rotation, in pixels, seen from any direction.
double reachPixels(const Camera &camera, const fourier::SpectrumLayout &spectrum,
                   const volume::Lattice &lattice, const ImageDefinition &image) {
    const glm::dvec3 center = lattice.center().mm;
    const auto &[lo, hi] = spectrum.box;
    double radius = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const volume::VoxelPoint p{{(corner & 1) != 0 ? hi.i - 1 : lo.i,
                                    (corner & 2) != 0 ? hi.j - 1 : lo.j,
                                    (corner & 4) != 0 ? hi.k - 1 : lo.k}};
        radius = std::max(radius, glm::distance(center, lattice.patient(p).mm));
    }
    const double longest =
        std::max({lattice.spacingMm(0), lattice.spacingMm(1), lattice.spacingMm(2)});
    return (radius + footprint(image) * longest) / camera.pixelMm;
}

} // namespace

FieldSummary summarise(const classify::DensityField &field) {
    return {field.values.lattice(), field.support, energyMarginals(field.values, field.support)};
}

SliceGrid sliceGrid(const Camera &camera, const fourier::SpectrumLayout &spectrum,
                    const volume::Lattice &lattice, const ImageDefinition &image) {
    const double projection = reachPixels(camera, spectrum, lattice, image);
    // A copy of the projection, a period away, must stay outside the image: its near edge lies at
    // period - radius, the image's far edge at half its size plus the pan.
    const auto cells = [&](int size, double pan) {
        const double reach = projection + 0.5 * size + std::abs(pan) / camera.pixelMm;
        // The tails of the roll-off fold in along the border only, so their share of the image's
        // energy falls with its size, and so does the room they are given.
        const double tails = ringingPixels(image.rollOff) * std::min(1.0, 64.0 / reach);
        if (!(reach + tails < largestSliceGrid))
            throw task::Error(
                task::ErrorCode::outOfMemory,
                fmt::format("pixels of {:.3g} mm need a slice of more than {} frequencies "
                            "a side",
                            camera.pixelMm, largestSliceGrid));
        return fourier::smoothEvenSize(int(std::ceil(reach + tails)));
    };
    return {cells(camera.width, camera.panMm.x), cells(camera.height, camera.panMm.y)};
}

RenderPlan planRender(const Scene &scene, const FieldSummary &field, const Budget &budget) {
    validate(scene);
    const volume::GridSize size = field.support.size();
    const volume::GridSize padded{fourier::paddedSize(size.i, padding),
                                  fourier::paddedSize(size.j, padding),
                                  fourier::paddedSize(size.k, padding)};
    RenderPlan plan{
        {fourier::Kernel::exponentialSemicircle(kernelWidth, padding), field.support, padded},
        scene.image};
    const SliceGrid grid = sliceGrid(scene.camera, plan.spectrum, field.lattice, scene.image);
    // Beside the ghosts: the roll-off's tails that fold back over the border of the slice grid, and
    // a few hundred float roundings.
    // The tails have the room between the image's edge and the next copy of the projection.
    const double room =
        0.5 * (grid.columns + grid.rows - 0.5 * (scene.camera.width + scene.camera.height)) -
        reachPixels(scene.camera, plan.spectrum, field.lattice, scene.image);
    const double share = std::sqrt(double(scene.camera.width) * scene.camera.height /
                                   (double(grid.columns) * grid.rows));
    const double folded = predictFoldedTails(scene.image.rollOff, room, std::min(1.0, share),
                                             field.energy.effectiveSamples);
    plan.predictedError =
        std::hypot(predictRelativeError(plan.spectrum, field.energy), folded, 1e-6);
    // A frame holds the slice, its transform and the cropped image, all of the slice's size or
    // less.
    const std::size_t frame = std::size_t(grid.columns) * grid.rows * 3 * sizeof(float);
    plan.bytes = plan.spectrum.bytes() + frame;
    if (plan.bytes > budget.bytes)
        throw task::Error(task::ErrorCode::outOfMemory,
                          fmt::format("the projection needs {} MB, {} MB are allowed",
                                      (plan.bytes >> 20) + 1, budget.bytes >> 20));
    return plan;
}

} // namespace pellucid::render
