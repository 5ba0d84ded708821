// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>
#include <cstddef>

#include "core/fourier/spectrum.h"

namespace pellucid::fourier {

// A spectrum is prepared in two passes: planes of the field along x and y, then rows of the result
// along z.

/// The size of the intermediate result of the first pass: [y][block of 16 x][k][strip], so that the
/// transform along z reads one contiguous run. It contains planes of the field only: the padding
/// along z is zero.
std::size_t intermediateBytes(const SpectrumLayout &layout);

/// Sums that are computed while a field is transformed.
struct FieldSums {
    double dc = 0.0;
    std::array<double, 3> moments{}; ///< first moments about the wrap voxel, by axis
    double magnitudes = 0.0;         ///< of the transformed samples: an upper bound on every cell
};

/// The first pass. *Shape*: the field is float32; `intermediate`: see `intermediateBytes`.
/// *Throws* Error{outOfMemory}, Cancelled.
FieldSums transformPlanes(const volume::Volume &field, const SpectrumLayout &layout,
                          float *intermediate, const task::Progress &progress);

/// The output of the second pass.
struct CellOutput {
    std::byte *cells;
    float scale = 1.0F; ///< the factor of cells before they are stored
    /// The rounding of the cells around frequency 0, see `Spectrum`; null if nothing is rounded.
    std::complex<float> *rounding = nullptr;
};

/// The second pass. *Throws* Error{outOfMemory}, Cancelled.
void transformRows(const SpectrumLayout &layout, const CellLayout &cells, const float *intermediate,
                   const CellOutput &out, const task::Progress &progress);

} // namespace pellucid::fourier
