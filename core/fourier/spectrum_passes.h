// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <memory>
#include <vector>

#include "core/fourier/spectrum.h"

namespace pellucid::fourier {

// A spectrum is prepared in two passes: rows of the field along x, then columns of the result along
// y and z. Columns are those of CellLayout: each is stored when it is finished, and its slab is
// released, so that little more than one of the two is in memory.

/// The result of the first pass, by column: [k][j][strip] of the field's own rows.
class ColumnSlabs {
public:
    /// *Throws* Error{outOfMemory}.
    ColumnSlabs(const SpectrumLayout &layout, const CellLayout &cells);
    float *of(int column) const {
        return reinterpret_cast<float *>(m_slabs[std::size_t(column)].get());
    }
    void release(int column) { m_slabs[std::size_t(column)].reset(); }
    static std::size_t bytes(const SpectrumLayout &layout); ///< of a column

private:
    std::vector<std::shared_ptr<std::byte[]>> m_slabs;
};

/// The size of a column between its transforms along y and along z.
std::size_t planeBytes(const SpectrumLayout &layout);

/// Sums that are computed while a field is transformed.
struct FieldSums {
    double dc = 0.0;
    std::array<double, 3> moments{}; ///< first moments about the wrap voxel, by axis
    double magnitudes = 0.0;         ///< of the transformed samples: an upper bound on every cell
};

/// The first pass. *Throws* Error{outOfMemory}, Cancelled.
FieldSums transformRows(const volume::Volume &field, const SpectrumLayout &layout,
                        const CellLayout &cells, const ColumnSlabs &slabs,
                        const task::Progress &progress);

/// The output of the second pass.
struct CellOutput {
    std::byte *cells;
    float scale = 1.0F; ///< the factor of cells before they are stored
    /// The rounding of the cells around frequency 0, see `Spectrum`; null if nothing is rounded.
    std::complex<float> *rounding = nullptr;
};

/// The second pass. *Throws* Error{outOfMemory}, Cancelled.
void transformColumns(const SpectrumLayout &layout, const CellLayout &cells, ColumnSlabs &slabs,
                      const CellOutput &out, const task::Progress &progress);

} // namespace pellucid::fourier
