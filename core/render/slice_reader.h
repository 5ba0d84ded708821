// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>

#include "core/render/frame_mixing.h"

namespace pellucid::render {

/// Reads a picture's slice at single frequencies in double precision, with cue and light. Frames
/// read theirs in vector code.
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
    /// Keeps references to all three; a cued `shading` needs its kernels by the first read.
    SliceReader(const EngineSpectra &spectra, const Mixing &mixing, const FrameShading &shading,
                Rounding rounding);

    /// The channels of the picture at a point of the central slice. *Units*: cells, by axis; the
    /// spectrum's.
    std::array<Read, 3> at(const std::array<double, 3> &cells) const {
        return at(cells, m_layout.kernels);
    }
    /// The same by narrower kernels. *Requires*: neither moments nor rounding.
    std::array<Read, 3> at(const std::array<double, 3> &cells,
                           const std::array<fourier::Kernel, 3> &kernels) const;
    /// The value and the rounding error of a cell of a source, periodic.
    Read cell(const FrameSource &source, std::array<int, 3> index) const;

private:
    void addTerm(const std::array<double, 3> &central, int term,
                 const std::array<fourier::Kernel, 3> &kernels, std::array<Read, 3> &images) const;
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
