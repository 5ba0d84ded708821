// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/slice_reader.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pellucid::render {

namespace {

using Complex = std::complex<double>;
using Read = SliceReader::Read;
using Taps = std::array<std::array<double, fourier::Kernel::largestWidth>, 3>;

Read conjugate(const Read &read) {
    return {std::conj(read.value), std::conj(read.error)};
}

} // namespace

SliceReader::SliceReader(const EngineSpectra &spectra, const Mixing &mixing,
                         const FrameShading &shading, Rounding rounding)
    : m_spectra(spectra), m_mixing(mixing), m_shading(shading),
      m_layout(spectra.fields.front()->layout()), m_rounding(rounding) {}

const fourier::Spectrum &SliceReader::spectrumOf(const FrameSource &source) const {
    return *(source.kind == FrameKind::field ? m_spectra.fields[source.field]
                                             : m_spectra.gradients[source.field]);
}

std::array<Read, 3> SliceReader::at(const std::array<double, 3> &cells,
                                    const std::array<fourier::Kernel, 3> &kernels) const {
    std::array<Read, 3> images{};
    for (int term = 0; term < m_shading.termCount; ++term)
        addTerm(cells, term, kernels, images);
    std::array<Read, 3> channels{};
    for (std::size_t image = 0; image < std::size_t(m_mixing.imageCount); ++image)
        for (std::size_t c = 0; c < 3; ++c)
            channels[c] += Complex(m_mixing.imageColor(image)[c]) * images[image];
    return channels;
}

Read SliceReader::cell(const FrameSource &source, std::array<int, 3> index) const {
    for (std::size_t d = 0; d < 3; ++d) {
        const int padded = m_layout.padded[int(d)];
        if (2 * std::abs(index[d]) > padded)
            index[d] -= padded * int(std::lround(double(index[d]) / padded));
    }
    if (index[0] < 0)
        return conjugate(cell(source, {-index[0], -index[1], -index[2]}));
    const fourier::Spectrum &spectrum = spectrumOf(source);
    Read read{spectrum.value(index[0], index[1], index[2]), 0.0};
    constexpr int reach = fourier::Spectrum::roundingReach;
    if (m_rounding == Rounding::read &&
        std::all_of(index.begin(), index.end(), [](int n) { return std::abs(n) <= reach; }))
        read.error = spectrum.rounding(index[0], index[1], index[2]);
    return read;
}

// See FrameShading.
void SliceReader::addTerm(const std::array<double, 3> &central, int term,
                          const std::array<fourier::Kernel, 3> &kernels,
                          std::array<Read, 3> &images) const {
    const FrameShading::Term &shadingTerm = m_shading.terms[std::size_t(term)];
    const Complex weight(shadingTerm.weight);
    std::array<double, 3> at{};
    for (std::size_t d = 0; d < 3; ++d)
        at[d] = central[d] + shadingTerm.cells[d];
    // The sum at frequency 0 is known exactly.
    const bool isExact = term == 0 && central == std::array<double, 3>{};
    // Plain and cued, by kind (field, gradient) and sum.
    std::array<std::array<std::array<Read, 3>, 2>, 2> reads{};
    for (const FrameSource &source : m_mixing.sources) {
        const auto kind = std::size_t(source.kind);
        std::array<Read, 2> read;
        if (m_shading.cued || m_rounding == Rounding::read)
            read = plainAndCued(source, at);
        else
            read[0].value = read[1].value = spectrumOf(source).between(at, kernels);
        auto &[plain, cued] = read;
        if (isExact)
            plain.error = cued.error = 0.0;
        for (std::size_t c = 0; c < std::size_t(m_mixing.sums); ++c) {
            reads[0][kind][c] += source.weights[c] * plain;
            reads[1][kind][c] += source.weights[c] * cued;
        }
    }
    for (std::size_t c = 0; c < std::size_t(m_mixing.imageCount); ++c) {
        const FrameShading::Image &image = m_shading.images[c];
        const std::size_t sum = m_mixing.sums == 1 ? 0 : c;
        double gradient = 0.0, excess = 0.0;
        for (std::size_t d = 0; d < 3; ++d) {
            const double turn = 2.0 * std::numbers::pi * at[d] / m_layout.padded[int(d)];
            gradient += image.gradient[d] * std::sin(turn);
            excess += image.excess[d] * std::cos(turn);
        }
        Read slice = Complex(image.ambient, gradient) * reads[1][0][sum];
        slice += Complex(-excess) * reads[0][0][sum];
        slice += Complex(image.magnitude) * reads[1][1][sum];
        images[c] += weight * slice;
    }
}

std::array<Read, 2> SliceReader::plainAndCued(const FrameSource &source,
                                              const std::array<double, 3> &at) const {
    const int width = m_layout.width();
    std::array<int, 3> first{};
    Taps taps{}, moments{};
    for (std::size_t d = 0; d < 3; ++d) {
        first[d] = int(std::ceil(at[d] - 0.5 * width));
        for (int tap = 0; tap < width; ++tap) {
            const double away = first[d] + tap - at[d];
            taps[d][std::size_t(tap)] = m_layout.kernels[d].value(away);
            if (m_shading.cued)
                moments[d][std::size_t(tap)] =
                    m_shading.perMoment[d] * (*m_shading.kernels)[d].value(away);
        }
    }
    Read plain, moment;
    for (std::size_t r = 0; r < std::size_t(width); ++r)
        for (std::size_t q = 0; q < std::size_t(width); ++q)
            for (std::size_t p = 0; p < std::size_t(width); ++p) {
                const Read here =
                    cell(source, {first[0] + int(p), first[1] + int(q), first[2] + int(r)});
                const double x = taps[0][p], y = taps[1][q], z = taps[2][r];
                plain += Complex(x * y * z) * here;
                if (m_shading.cued)
                    moment += Complex(moments[0][p] * y * z + x * moments[1][q] * z +
                                      x * y * moments[2][r]) *
                              here;
            }
    if (!m_shading.cued)
        return {plain, plain};
    // The odd kernel yields -i times the field times its distance.
    Read cued = Complex(m_shading.base) * plain;
    cued += Complex(0.0, 1.0) * moment;
    return {plain, cued};
}

} // namespace pellucid::render
