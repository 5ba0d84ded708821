// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/sum_plan.h"

#include <algorithm>
#include <cmath>

#include "core/fourier/transforms/padded_size.h"
#include "core/plan/cost_model.h"
#include "core/plan/error_prediction.h"
#include "core/plan/sheared_grid.h"

namespace pellucid::plan {

namespace {

// Half of the last bit of a float.
constexpr double rounding = 0x1p-24;

// By how much amplified detail, and fields that add up, may raise the error of a field's image.
double gainOf(const scene::Scene &scene, const Composition &composition) {
    return scene::detailGain(scene.image) * composition.errorFactor();
}

} // namespace

// Each kernel contributes at most its largest error, relative to a sample's amplitude, along each
// of two axes.
// - Samples are spread over cells with one factor for a whole plane. Without negative samples the
//   energies of n planes add up to at most that of their sum (as in `predictRelativeError`), so
//   that errors in phase are at most sqrt(n) times as strong.
// - Each plane rounds a cell once, possibly in the same direction. These and some 300 roundings in
//   transforms and taps scatter over all frequencies; undoing the kernels amplifies those at the
//   edge of the band.
double sumError(const volume::GridSize &size) {
    static const double spreading = largestTapError(spreadKernel(), 0.5 / spreadPadding),
                        reading = largestTapError(readKernel(), 0.5 / readPadding),
                        amplified = std::pow(spreadKernel().apodisation(0.0) /
                                                 spreadKernel().apodisation(0.5 / spreadPadding),
                                             2.0);
    const double planes = std::max({size.i, size.j, size.k});
    return 2.0 * (std::sqrt(planes) * spreading + reading) +
           rounding * (planes + amplified * std::sqrt(planes + 300.0));
}

bool sumsPay(const scene::Scene &scene, const volume::Lattice &lattice, const volume::VoxelBox &box,
             const Composition &composition) {
    if (composition.pictures != 1 || scene.plannedFor != scene::PlannedFor::picture ||
        !scene.shading.isPlain() || !scene.interpolation.isPlanned() ||
        gainOf(scene, composition) * sumError(box.size()) > scene.tolerance)
        return false;
    // The spectrum of a volume has no more cells for smaller pixels; these sums would.
    if (scene.camera.pixelMm < scene::finestPixelMm(lattice))
        return false;
    const ShearedGrid sheared(lattice, box, scene.camera.axes()[2], scene.camera.pixelMm,
                              scene.image);
    volume::GridSize padded = box.size();
    for (int *const side : {&padded.i, &padded.j, &padded.k})
        *side = fourier::paddedSize(*side, leastPadding);
    return sumTime(sheared, box) < prepareTime(padded);
}

std::optional<RenderPlan> planSums(const scene::Scene &scene,
                                   std::span<const field::Summary> fields,
                                   const Composition &composition) {
    requireDetailFits(scene, fields);
    const scene::Camera &camera = scene.camera;
    const volume::Lattice &lattice = fields.front().lattice;
    const volume::VoxelBox &box = fields.front().support;
    RenderPlan plan{.spectrum = {{readKernel(), readKernel(), readKernel()}, box, {}, {}},
                    .fieldOfView = {},
                    .reason = task::because::onePicture,
                    .image = scene.image};
    for (const field::Summary &field : fields)
        plan.fieldOfView.spreads.push_back(field.energy.spread);
    // Half of the squared error is for the tails that fold back.
    const double gain = gainOf(scene, composition);
    plan.fieldOfView.aliasingLimit = std::sqrt(0.5) * scene.tolerance / gain;
    const SliceGrid grid = sliceGrid(camera, plan.fieldOfView, lattice, scene.image);
    double worst = 0.0;
    for (const field::Summary &field : fields) {
        const field::EnergySpread &spread = *field.energy.spread;
        if (field.energy.energyMm3 > 0.0 && std::isinf(spread.peakedness)) // negative samples
            return std::nullopt;
        worst = std::max(
            worst,
            std::hypot(sumError(box.size()) / std::sqrt(shareInImage(camera, spread)),
                       predictFoldedTails(scene.image, camera, grid.columns, grid.rows, spread)));
    }
    plan.predictedError = gain * worst;
    const ShearedGrid sheared(lattice, box, camera.axes()[2], camera.pixelMm, scene.image);
    plan.bytes = fields.size() * (sheared.bytes() + frameBytes(grid, camera, 1));
    if (plan.predictedError > scene.tolerance)
        return std::nullopt;
    return plan;
}

} // namespace pellucid::plan
