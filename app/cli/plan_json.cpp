// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/plan_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "app/cli/json_text.h"
#include "core/plan/sheared_grid.h"

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

// The keys of a plan whose pictures are made without spectra.
json withoutSpectra(const char *combination, int images, const plan::RenderPlan &plan) {
    return {{"model",
             {{"spectra", json::array()},
              {"slices", 0},
              {"images", images},
              {"combination", combination},
              {"multiply_adds", nullptr},
              {"transform_operations", nullptr},
              {"bytes", {{"spectra", 0}, {"frame", plan.bytes}}},
              {"left_out", json::array()}}},
            {"predicted_error", plan.predictedError},
            {"adaptive_error", 0.0},
            {"kernel_widths", json::object()}};
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
    json keys =
        withoutSpectra("each image is evaluated by itself, in double precision", images, plan);
    keys.update({{"kernel", "sinh13"},
                 {"taps", 13 * 13 * 13},
                 {"padding", 2.0},
                 {"storage", "f64"},
                 {"reason", reason}});
    return keys;
}

json sumPlanJson(int images, const plan::RenderPlan &plan) {
    const fourier::Kernel &kernel = plan::readKernel();
    json keys = withoutSpectra("the samples are summed along the view", images, plan);
    keys.update({{"kernel", kernel.name()},
                 {"taps", kernel.width() * kernel.width()},
                 {"padding", plan::readPadding},
                 {"storage", "f32"},
                 {"box", sizeJson(plan.spectrum.box.size())},
                 {"reason", plan.reason.english()}});
    return keys;
}

} // namespace pellucid::cli
