// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/frame_model.h"

#include <cmath>
#include <numbers>

#include "core/render/shaded_fields.h"
#include "core/shading/slice_shading.h"

namespace pellucid::render {

FrameModel modelFrame(const RenderPlan &plan, const Scene &scene, int fields, bool isTinted,
                      const volume::Lattice &lattice) {
    const shading::Shading &shading = scene.shading;
    const fourier::SpectrumLayout &layout = plan.spectrum;
    const SliceGrid grid = sliceGrid(scene.camera, plan.room, lattice, scene.image);
    FrameModel model;
    model.fields = fields;
    model.gradients = shading.isLit() ? fields : 0;
    const shading::SliceShading slices =
        shading::sliceShading(shading, scene.camera.axes(), shading::shadingScale(lattice));
    model.slices = (model.fields + model.gradients) * int(slices.terms.size());
    model.images = imagesOf(std::size_t(fields), shading);
    model.combination = model.images > 1 ? Combination::channels
                        : isTinted       ? Combination::tinted
                                         : Combination::one;
    // The half of a disc; each tap is a real weight times a complex cell. A linear cue weighs the
    // same cells a second time.
    const double frequencies = double(grid.columns) * grid.rows,
                 sampled = std::numbers::pi / 8.0 * frequencies,
                 taps = std::pow(layout.width(), 3.0) * (slices.slope != 0.0 ? 2.0 : 1.0);
    model.multiplyAdds = 2.0 * model.slices * sampled * taps;
    model.transformOperations = 2.5 * model.images * frequencies * std::log2(frequencies);
    model.spectrumBytes = std::size_t(model.fields + model.gradients) * layout.bytes();
    model.frameBytes = std::size_t(model.images) * frameBytes(grid, scene.camera);
    model.leftOut = {LeftOut::secondHalf, LeftOut::cornersOfBand};
    if (layout.box != lattice.bounds())
        model.leftOut.push_back(LeftOut::emptySpace);
    if (!shading.isLit())
        model.leftOut.push_back(LeftOut::light);
    if (!shading.cue.isActive())
        model.leftOut.push_back(LeftOut::depthCue);
    if (model.images == 1)
        model.leftOut.push_back(LeftOut::color);
    return model;
}

std::string leftOutText(LeftOut what) {
    switch (what) {
    case LeftOut::secondHalf:
        return "half of each spectrum: of real values it mirrors the other";
    case LeftOut::emptySpace:
        return "the empty part of the volume";
    case LeftOut::light:
        return "spectra of gradients: there is no light";
    case LeftOut::depthCue:
        return "further slices of each spectrum: there is no depth cue";
    case LeftOut::color:
        return "two of three images: there is one colour";
    case LeftOut::cornersOfBand:
        return "frequencies beyond the circle of the band";
    }
    return {};
}

std::string combinationText(Combination how) {
    switch (how) {
    case Combination::one:
        return "one grey image";
    case Combination::tinted:
        return "one image, tinted pixel by pixel";
    case Combination::channels:
        return "an image for each of red, green and blue";
    }
    return {};
}

} // namespace pellucid::render
