// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "core/fourier/spectrum.h"

namespace pellucid::fourier {

// A spectrum is prepared in two passes: rows of the field along x, then columns of the result along
// y and z. Columns are those of CellLayout.

/// The memory of a spectrum and of the first pass's result, its slabs. The cells of a column
/// overwrite slabs that have already been read: the system clears fresh memory before it hands it
/// out, which took as long as the transforms.
class ColumnMemory {
public:
    /// *Throws* Error{outOfMemory}.
    ColumnMemory(const SpectrumLayout &layout, const CellLayout &cells);
    /// [k][j][strip] of the field's own rows. The cells of earlier columns do not reach it.
    float *slab(int column) const;
    std::byte *cells() const { return m_memory.get(); }
    /// The cells and, behind them, 64 bytes of zeros; the contents of slabs are lost.
    std::shared_ptr<std::byte[]> takeCells();
    static std::size_t bytes(const SpectrumLayout &layout);

private:
    std::size_t m_cellBytes, m_slabBytes, m_bytes;
    int m_columns;
    std::shared_ptr<std::byte[]> m_memory;
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
FieldSums transformRows(const volume::Field &field, const SpectrumLayout &layout,
                        const CellLayout &cells, ColumnMemory &memory,
                        const task::Progress &progress);

/// The second pass. Cells are stored times `scale`. *Throws* Error{outOfMemory}, Cancelled.
void transformColumns(const SpectrumLayout &layout, const CellLayout &cells, ColumnMemory &memory,
                      float scale, const task::Progress &progress);

} // namespace pellucid::fourier
