// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>

#include "core/render/frame_mixing.h"

namespace pellucid::render {

/// Reads a picture's slice at single frequencies in double precision, cue and light included. It is
/// for the few frequencies that something has to be known about; frames read theirs in vectors.
class SliceReader {
public:
    /// A value, and the rounding error of the cells that it was read from, if it is read and the
    /// spectra keep it.
    struct Read {
        std::complex<double> value = 0.0, error = 0.0;
        Read &operator+=(const Read &other) {
            value += other.value;
            error += other.error;
            return *this;
        }
        friend Read operator*(const std::complex<double> &factor, const Read &read) {
            return {factor * read.value, factor * read.error};
        }
    };

    enum class Rounding { unknown, read };
    /// `shading` with its moment kernels, if it has moments. Keeps references.
    SliceReader(const EngineSpectra &spectra, const Mixing &mixing, const FrameShading &shading,
                Rounding rounding);

    /// The channels of the picture at a point of the central slice. *Units*: cells, by axis; the
    /// spectrum's.
    std::array<Read, 3> at(const std::array<double, 3> &cells) const;
    /// The value and the rounding error of a cell of a source, periodic.
    Read cell(const FrameSource &source, std::array<int, 3> index) const;

private:
    void addTerm(const std::array<double, 3> &central, int term, std::array<Read, 3> &images) const;
    std::array<Read, 2> plainAndCued(const FrameSource &source,
                                     const std::array<double, 3> &at) const;
    const fourier::Spectrum &spectrumOf(const FrameSource &source) const;

    const EngineSpectra &m_spectra;
    const Mixing &m_mixing;
    const FrameShading &m_shading;
    const fourier::SpectrumLayout &m_layout;
    Rounding m_rounding;
};

} // namespace pellucid::render
