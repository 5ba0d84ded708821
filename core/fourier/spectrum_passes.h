// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>
#include <cstddef>

#include "core/fourier/spectrum.h"

namespace pellucid::fourier {

// A spectrum is prepared in two passes: planes of the field along x and y, then rows of the result
// along z.

/// The size of what the first pass leaves to the second: [y][block of 16 x][k][strip], so that the
/// transform along z reads one run. It has planes of the field only: the padding along z is zero.
std::size_t intermediateBytes(const SpectrumLayout &layout);

/// What is summed while a field is transformed.
struct FieldSums {
    double dc = 0.0;
    std::array<double, 3> moments{}; ///< first moments about the wrap voxel, by axis
    double magnitudes = 0.0;         ///< of what is transformed: no cell exceeds their sum
};

/// The first pass. *Shape*: the field is float32; `intermediate`: see `intermediateBytes`.
/// *Throws* Error{outOfMemory}, Cancelled.
FieldSums transformPlanes(const volume::Volume &field, const SpectrumLayout &layout,
                          float *intermediate, const task::Progress &progress);

/// What the second pass writes.
struct CellOutput {
    std::byte *cells;
    float scale = 1.0F; ///< cells are multiplied by it before they are stored
    /// The rounding of the cells about frequency 0, see `Spectrum`; none if nothing is rounded.
    std::complex<float> *rounding = nullptr;
};

/// The second pass. *Throws* Error{outOfMemory}, Cancelled.
void transformRows(const SpectrumLayout &layout, const CellLayout &cells, const float *intermediate,
                   const CellOutput &out, const task::Progress &progress);

} // namespace pellucid::fourier
