// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/view_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "core/accuracy/central_rounding.h"
#include "core/accuracy/channel_error.h"
#include "core/accuracy/narrowing_error.h"
#include "core/shading/slice_shading.h"

namespace pellucid::accuracy {

namespace {

// The weights of all fields in a channel. The gradients, if they were prepared for light, follow
// the fields.
std::vector<FieldWeight> weightsOf(std::size_t fields,
                                   const std::vector<render::ChannelWeights> &channelWeights,
                                   std::size_t channel, const shading::Shading &shading,
                                   const shading::SliceShading &slices) {
    const bool isLit = shading.isLit();
    const shading::SliceShading::Channel &light = slices.channels[channel];
    std::vector<FieldWeight> weights(fields);
    for (std::size_t f = 0; f < fields; ++f) {
        const bool isGradient = f >= channelWeights.size();
        const double share = channelWeights[isGradient ? f - channelWeights.size() : f][channel];
        if (!isLit || !isGradient) {
            const double weight = isGradient ? 0.0 : share * (isLit ? light.ambient : 1.0);
            weights[f] = {weight, weight * weight, isGradient};
            continue;
        }
        // Directed light sees a third of the gradient's energy, and no mass.
        const double length = glm::dot(light.gradient, light.gradient) / 3.0;
        weights[f] = {share * light.magnitude,
                      share * share * (light.magnitude * light.magnitude + length), isGradient};
    }
    return weights;
}

// Relative to the shown picture, which is the exact picture plus the error. If all of it may be
// error, little is known about the exact one.
double relativeError(double energy, double error) {
    constexpr double minExact = 1e-3;
    const double relativeToShown = energy > 0.0 ? std::sqrt(error / energy) : 0.0;
    return relativeToShown / std::max(minExact, 1.0 - relativeToShown);
}

// The part of the window that the fields can reach, if that is less than half of it: the rest is
// empty. Their waves in a window of thousands of large pixels would take seconds.
scene::Camera croppedTo(const plan::FieldOfView &fieldOfView, const scene::Camera &camera) {
    double reachMm = 0.0;
    for (const auto &spread : fieldOfView.spreads)
        reachMm = std::max(reachMm, spread->radiusMm + 4.0 * spread->longestStepMm);
    reachMm += 4.0 * camera.pixelMm;
    scene::Camera cropped = camera;
    const auto crop = [&](double &panMm, int &side) {
        const double half = 0.5 * side * camera.pixelMm, low = std::max(panMm - half, -reachMm),
                     high = std::min(panMm + half, reachMm);
        if (high <= low || high - low >= half)
            return; // nothing is in it, or most of it may be filled
        side = std::clamp(int(std::ceil((high - low) / camera.pixelMm)), 1, side);
        panMm = 0.5 * (low + high);
    };
    crop(cropped.panMm.x, cropped.width);
    crop(cropped.panMm.y, cropped.height);
    return cropped;
}

// The terms are energies expected of many pixels, and the tails that fold into a picture were
// measured in squares. In strips and pictures of a few pixels, up to 16 times the expected error
// was measured, and in strips one pixel wide more than the plan's bound.
constexpr int fewPixels = 8; // along the shorter side

double fewPixelsFactor(int side) {
    return side > fewPixels ? 1.0 : 1.0 + 24.0 / std::pow(double(side), 1.5);
}

} // namespace

ViewErrorModel::ViewErrorModel(const plan::RenderPlan &plan,
                               std::span<const plan::FieldSummary> fields)
    : m_fields(coarseFields(plan, fields)), m_fieldOfView(plan.fieldOfView),
      m_bound(plan.predictedError / scene::detailGain(plan.image)), m_together(plan.together) {}

PictureError ViewErrorModel::errorOf(const picture::ProjectionImage &picture,
                                     const scene::Camera &camera,
                                     const scene::ImageDefinition &image,
                                     const render::EngineParts &engine,
                                     const shading::Shading &shading) const {
    // The terms below are predicted for the image without amplified detail.
    const double gain = scene::detailGain(image);
    if (picture.samples.empty())
        return {gain * m_bound, true};
    const std::vector<render::ChannelWeights> &channelWeights = engine.channelWeights;
    // Without light the weights do not depend on R and the step.
    const shading::SliceShading slices = shading::sliceShading(shading, camera.axes(), {});
    render::FrameSetup setup(m_fieldOfView, engine.widths);
    const render::FrameInputs inputs =
        setup.inputsFor(engine.spectra, channelWeights, camera, image, shading, plan::onAllThreads);
    const auto central = [&] {
        const scene::Camera filled = croppedTo(m_fieldOfView, camera);
        if (filled == camera)
            return centralEnergies(engine.spectra, inputs, camera);
        render::FrameSetup setupOfFilled(m_fieldOfView, engine.widths);
        return centralEnergies(engine.spectra,
                               setupOfFilled.inputsFor(engine.spectra, channelWeights, filled,
                                                       image, shading, plan::onAllThreads),
                               filled);
    };
    const PictureContext context{picture,
                                 camera,
                                 image,
                                 shading,
                                 inputs.grid,
                                 central(),
                                 sliceEnergies(engine.spectra, inputs, camera, image),
                                 narrowingEnergies(engine.spectra, inputs, camera, image)};
    double energy = 0.0, error = 0.0;
    bool isWhole = true, isAsPlanned = true; // the plan's bound holds for these only
    for (int channel = 0; channel < picture.channels; ++channel) {
        const auto c = std::size_t(channel);
        const ChannelEnergies energies =
            channelEnergies(m_fields, m_bound, context, channel,
                            weightsOf(m_fields.fields.size(), channelWeights, c, shading, slices));
        energy += energies.image;
        error += energies.error;
        const auto isShown = [&](const render::ChannelWeights &share) { return share[c] != 0.0; };
        isWhole = isWhole && energies.isWhole;
        isAsPlanned = isAsPlanned && std::count_if(channelWeights.begin(), channelWeights.end(),
                                                   isShown) <= m_together;
    }
    const int side = std::min(camera.width, camera.height);
    const double estimate = fewPixelsFactor(side) * relativeError(energy, gain * gain * error);
    const bool isBounded = isWhole && isAsPlanned && side > fewPixels;
    return {isBounded ? std::min(gain * m_bound, estimate) : estimate, isWhole};
}

} // namespace pellucid::accuracy
