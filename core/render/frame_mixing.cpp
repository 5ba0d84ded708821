// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/frame_mixing.h"

#include <algorithm>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace pellucid::render {

std::vector<ChannelWeights> channelWeightsOf(const classify::ShownFields &fields) {
    std::vector<ChannelWeights> weights;
    for (std::size_t n = 0; n < fields.channels.size(); ++n) {
        const classify::Color &color = fields.colors[n];
        weights.push_back({color.red, color.green, color.blue});
    }
    return weights;
}

int colorsOf(std::span<const ChannelWeights> channelWeights) {
    return areGrey(channelWeights) ? 0 : int(classify::colorBasis(channelWeights).colors.size());
}

Mixing::Mixing(const EngineSpectra &spectra, const std::vector<ChannelWeights> &channelWeights,
               const shading::SliceShading &shading, bool greyLight)
    : grey(areGrey(channelWeights) && greyLight) {
    std::vector<std::size_t> shown;
    for (std::size_t n = 0; n < spectra.fields.size(); ++n)
        if (channelWeights[n] != ChannelWeights{0.0, 0.0, 0.0})
            shown.push_back(n);
    if (shown.empty())
        return;
    const fourier::Spectrum &first = *spectra.fields[shown.front()];
    unit = first.unit();
    std::vector<ChannelWeights> weights;
    for (const std::size_t n : shown)
        weights.push_back(channelWeights[n]);
    classify::ColorBasis basis = classify::colorBasis(weights);
    if (!shading.isGrey() && basis.colors.size() > 1)
        basis = {{primaries.begin(), primaries.end()}, weights};
    sums = int(basis.colors.size());
    imageCount = shading.isGrey() ? sums : FrameJob::maxImages;
    std::copy(basis.colors.begin(), basis.colors.end(), colors.begin());
    const bool isLit =
        std::any_of(shading.channels.begin(), shading.channels.end(),
                    [](const shading::SliceShading::Channel &c) { return c.magnitude != 0.0; });
    for (const FrameKind kind : {FrameKind::field, FrameKind::gradient}) {
        if (kind == FrameKind::gradient && !isLit)
            break;
        for (std::size_t s = 0; s < shown.size(); ++s) {
            const std::size_t n = shown[s];
            const fourier::Spectrum &spectrum =
                kind == FrameKind::field ? *spectra.fields[n] : *spectra.gradients[n];
            add(spectrum, kind, n, basis.amounts[s]);
        }
    }
}

void Mixing::add(const fourier::Spectrum &spectrum, FrameKind kind, std::size_t field,
                 const ChannelWeights &weights) {
    const double s = spectrum.unit() / unit;
    sources.push_back({spectrum.cells(),
                       field,
                       {float(s * weights[0]), float(s * weights[1]), float(s * weights[2])},
                       kind,
                       weights});
    const auto &moments = spectrum.moments();
    for (std::size_t c = 0; c < weights.size(); ++c) {
        Dc &sum = dc[std::size_t(kind)][c];
        sum.value += weights[c] * spectrum.dc();
        sum.moments += weights[c] * glm::dvec3(moments[0], moments[1], moments[2]);
    }
}

FrameShading frameShading(const shading::SliceShading &shading, const Mixing &mixing,
                          const fourier::Spectrum &spectrum, const glm::dvec3 &toWrap,
                          const glm::dvec3 &toViewer, double stepMm) {
    const volume::Lattice &lattice = spectrum.lattice();
    const glm::dmat3 rows =
        glm::inverse(glm::dmat3(lattice.step(0), lattice.step(1), lattice.step(2))); // b_d
    FrameShading frame;
    frame.termCount = int(shading.terms.size());
    frame.cued = shading.slope != 0.0;
    // Moments are relative to the wrap voxel, depth to the centre.
    const double wrapDepth = glm::dot(toViewer, toWrap);
    frame.base = float(1.0 + shading.slope * wrapDepth);
    for (int d = 0; d < 3; ++d) {
        const double depth = glm::dot(lattice.step(d), toViewer);
        frame.perMoment[std::size_t(d)] = shading.slope * depth * spectrum.layout().padded[d];
        for (std::size_t t = 0; t < shading.terms.size(); ++t)
            frame.terms[t].cells[std::size_t(d)] =
                shading.terms[t].offset * depth * spectrum.layout().padded[d];
        const glm::dvec3 b(rows[0][d], rows[1][d], rows[2][d]);
        for (std::size_t c = 0; c < 3; ++c) {
            const double gradient = stepMm * glm::dot(b, shading.channels[c].gradient);
            frame.images[c].gradient[std::size_t(d)] = gradient;
            frame.images[c].excess[std::size_t(d)] = gradient * shading.slope * depth;
        }
    }
    for (std::size_t t = 0; t < shading.terms.size(); ++t)
        frame.terms[t].weight = std::complex<float>(
            shading.terms[t].weight *
            std::polar(1.0, -2.0 * std::numbers::pi * shading.terms[t].offset * wrapDepth));
    for (std::size_t c = 0; c < 3; ++c) {
        FrameShading::Image &image = frame.images[c];
        image.ambient = float(shading.channels[c].ambient);
        image.magnitude = float(shading.channels[c].magnitude);
        // Opposite lights cancel in the gradient, but their magnitudes add up.
        frame.lit = frame.lit || image.magnitude != 0.0F;
        // The images of one sum are colored here.
        if (mixing.imageCount > mixing.sums) {
            const double share = mixing.colors.front()[c];
            image.ambient *= float(share);
            image.magnitude *= float(share);
            for (std::size_t d = 0; d < 3; ++d) {
                image.gradient[d] *= share;
                image.excess[d] *= share;
            }
        }
    }
    return frame;
}

std::vector<fourier::MomentKernel> momentKernels(const std::array<fourier::Kernel, 3> &kernels,
                                                 const fourier::SpectrumLayout &layout) {
    std::vector<fourier::MomentKernel> moments;
    for (int d = 0; d < 3; ++d)
        moments.emplace_back(kernels[std::size_t(d)],
                             double(layout.padded[d]) / layout.box.size()[d]);
    return moments;
}

ZeroSums zeroSums(const Mixing &mixing, const FrameShading &shading,
                  const fourier::SpectrumLayout &layout) {
    ZeroSums zero{};
    for (std::size_t kind = 0; kind < zero.size(); ++kind)
        for (std::size_t c = 0; c < std::size_t(mixing.sums); ++c) {
            const Mixing::Dc &dc = mixing.dc[kind][c];
            double moment = 0.0;
            for (int d = 0; d < 3; ++d)
                moment += shading.perMoment[std::size_t(d)] / layout.padded[d] * dc.moments[d];
            zero[kind][c] = {dc.value / mixing.unit, moment / mixing.unit};
        }
    return zero;
}

} // namespace pellucid::render
