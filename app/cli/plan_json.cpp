// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/plan_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "app/cli/json_text.h"

namespace pellucid::cli {

using nlohmann::json;

namespace {

json modelJson(const plan::FrameModel &model) {
    json spectra = json::array(), leftOut = json::array();
    for (const plan::FrameModel::Spectra &kind : model.spectra)
        spectra.push_back({{"of", plan::spectrumText(kind.of)},
                           {"count", kind.count},
                           {"because", plan::reasonText(kind.of)}});
    for (const plan::LeftOut what : model.leftOut)
        leftOut.push_back(plan::leftOutText(what));
    return {{"spectra", spectra},
            {"slices", model.slices},
            {"images", model.images},
            {"combination", plan::combinationText(model.combination)},
            {"multiply_adds", std::llround(model.multiplyAdds)},
            {"transform_operations", std::llround(model.transformOperations)},
            {"bytes", {{"spectra", model.spectrumBytes}, {"frame", model.frameBytes}}},
            {"left_out", leftOut}};
}

} // namespace

json planJson(const plan::RenderPlan &plan, const scene::Scene &scene,
              const plan::FrameFields &fields, const volume::Lattice &lattice,
              std::span<const double> widthShares) {
    const fourier::SpectrumLayout &layout = plan.spectrum;
    const plan::SliceGrid grid =
        plan::sliceGrid(scene.camera, plan.fieldOfView, lattice, scene.image);
    const int w = layout.width();
    json shares = json::object();
    for (std::size_t width = 0; width < widthShares.size(); ++width)
        if (widthShares[width] > 0.0)
            shares[std::to_string(width)] = widthShares[width];
    return {{"model", modelJson(plan::modelFrame(plan, scene, fields, lattice, widthShares))},
            {"kernel", layout.kernels[0].name()},
            {"taps", w * w * w},
            {"padded", sizeJson(layout.padded)},
            {"box", sizeJson(layout.box.size())},
            {"padding", double(layout.padded.i) / layout.box.size().i},
            {"slice_grid", {grid.columns, grid.rows}},
            {"storage", fourier::storageName(layout.storage)},
            {"predicted_error", plan.predictedError},
            {"adaptive_error", plan.adaptiveError},
            {"kernel_widths", shares},
            {"reason", plan.reason.english()}};
}

json exactPlanJson(int images, const plan::RenderPlan &plan, const std::string &reason) {
    return {{"model",
             {{"spectra", json::array()},
              {"slices", 0},
              {"images", images},
              {"combination", "each image is evaluated by itself, in double precision"},
              {"multiply_adds", nullptr},
              {"transform_operations", nullptr},
              {"bytes", {{"spectra", plan.bytes}, {"frame", nullptr}}},
              {"left_out", json::array()}}},
            {"kernel", "KB12"},
            {"taps", 12 * 12 * 12},
            {"padding", 2.0},
            {"storage", "f64"},
            {"predicted_error", plan.predictedError},
            {"adaptive_error", 0.0},
            {"kernel_widths", json::object()},
            {"reason", reason}};
}

} // namespace pellucid::cli
