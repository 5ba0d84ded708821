// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/frame_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/shading/slice_shading.h"

namespace pellucid::plan {

FrameModel modelFrame(const RenderPlan &plan, const scene::Scene &scene, const FrameFields &fields,
                      const volume::Lattice &lattice, std::span<const double> widthShares) {
    const shading::Shading &shading = scene.shading;
    const fourier::SpectrumLayout &layout = plan.spectrum;
    const SliceGrid grid = sliceGrid(scene.camera, plan.fieldOfView, lattice, scene.image);
    FrameModel model;
    model.spectra.push_back({fields.of, fields.count});
    if (shading.isLit())
        model.spectra.push_back({SpectrumOf::gradient, fields.count});
    int spectra = 0;
    for (const FrameModel::Spectra &kind : model.spectra)
        spectra += kind.count;
    const shading::SliceShading slices =
        shading::sliceShading(shading, scene.camera.axes(), shading::shadingScale(lattice));
    model.slices = spectra * int(slices.terms.size());
    // Fields of one color add up before the transform, as their slices do.
    model.images = shading.isLit() && !shading.isGrey() ? 3 : std::max(1, fields.colors);
    model.combination = model.images == 3   ? Combination::channels
                        : model.images == 2 ? Combination::mixed
                        : fields.colors > 0 ? Combination::tinted
                                            : Combination::one;
    double taps = 0.0;
    for (std::size_t width = 0; width < widthShares.size(); ++width)
        taps += widthShares[width] * std::pow(double(width), 3.0);
    if (taps == 0.0)
        taps = std::pow(layout.width(), 3.0);
    // A linear cue weights the same cells a second time.
    taps *= slices.slope != 0.0 ? 2.0 : 1.0;
    // Half of a disc; each tap is a real weight times a complex cell.
    const double frequencies = double(grid.columns) * grid.rows,
                 sampled = std::numbers::pi / 8.0 * frequencies;
    model.multiplyAdds = 2.0 * model.slices * sampled * taps;
    model.transformOperations = 2.5 * model.images * frequencies * std::log2(frequencies);
    model.spectrumBytes = std::size_t(spectra) * layout.bytes();
    model.frameBytes = frameBytes(grid, scene.camera, model.images);
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

std::string spectrumText(SpectrumOf what) {
    switch (what) {
    case SpectrumOf::look:
        return "density of the whole look";
    case SpectrumOf::color:
        return "density of one of the colors that the look is mixed from";
    case SpectrumOf::layer:
        return "density of a class or a point of the transfer function";
    case SpectrumOf::gradient:
        return "length of a density's gradient";
    }
    return {};
}

std::string reasonText(SpectrumOf what) {
    switch (what) {
    case SpectrumOf::look:
        return "everything has the same color, so it adds up to one field";
    case SpectrumOf::color:
        return "the look is mixed from two or three colors, and each has its own field";
    case SpectrumOf::layer:
        return "the weights may change, so each layer has its own spectrum, and the slices are "
               "added";
    case SpectrumOf::gradient:
        return "light depends on the length of the gradient, which is not linear in the density";
    }
    return {};
}

std::string leftOutText(LeftOut what) {
    switch (what) {
    case LeftOut::secondHalf:
        return "half of each spectrum: for real values it mirrors the other half";
    case LeftOut::emptySpace:
        return "the empty part of the volume";
    case LeftOut::light:
        return "spectra of gradients: there is no light";
    case LeftOut::depthCue:
        return "more slices of each spectrum: there is no depth cue";
    case LeftOut::color:
        return "two of three images: there is one color";
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
    case Combination::mixed:
        return "two images in two colors, added pixel by pixel";
    case Combination::channels:
        return "one image each for red, green and blue";
    }
    return {};
}

} // namespace pellucid::plan
