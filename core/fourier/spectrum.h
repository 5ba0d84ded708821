// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <memory>

#include "core/fourier/kernels/kernel.h"
#include "core/fourier/storage.h"
#include "core/task/progress.h"
#include "core/volume/field.h"

namespace pellucid::fourier {

/// The parameters of preparing a field.
struct SpectrumLayout {
    std::array<Kernel, 3> kernels; ///< one per axis, all of the same width
    volume::VoxelBox box;          ///< the part of the lattice that is transformed
    volume::GridSize padded;       ///< smooth, even sizes of the periodic grid
    Storage storage = Storage::binary16;

    int width() const { return kernels[0].width(); }
    /// Whether 32-bit indices can address its cells; engines read no larger spectra.
    bool addressable() const;
    /// The size of the prepared spectrum.
    std::size_t bytes() const;
    /// The largest number of bytes held at once during preparation, including the result.
    std::size_t peakBytes() const;
};

/// The memory layout of a half spectrum's cells: [x column][z / 8][y][z % 8][16 cells]. Column c
/// holds the x cells step c .. step c + 15, so neighbouring columns share width - 1 cells, and
/// every run of `width` neighbours is inside one column: with binary16 storage, inside one 64-byte
/// cache line. A page of 4 KiB is a block of about 13 x 8 x 8 cells, so an oblique slice touches
/// half as many pages as in an array of whole planes, where a page is 13 x 64 x 1. Beyond the half,
/// and around the period, a halo of cells is repeated, so that interpolation needs neither wrapping
/// nor branches. Indices y and z start at -padded/2.
struct CellLayout {
    static constexpr int columnCells = 16;
    static constexpr int planesTogether = 8;

    explicit CellLayout(const SpectrumLayout &layout);
    int halo;                   ///< cells around the stored half
    int step;                   ///< cells between the starts of columns
    int columns;                ///< *Shape*: columns x planes x rows lines of columnCells cells
    int rows, planes;           ///< planes: whole groups of planesTogether
    int firstX, firstY, firstZ; ///< the indices of the first cell, row and plane
    std::size_t lines() const { return std::size_t(columns) * planes * rows; }
    /// The index of a line.
    std::size_t line(int column, int plane, int row) const {
        const int group = plane / planesTogether, inGroup = plane % planesTogether;
        return std::size_t(column) * planes * rows +
               (std::size_t(group) * rows + row) * planesTogether + inGroup;
    }
};

/// The half spectrum of a field, divided by the kernel's apodisation, on a periodic padded grid.
///
/// With the phase origin at the wrap voxel x_w, the value at grid index (p, q, r) is
///   dV * sum_n f[n] / (h_0 h_1 h_2) * exp(-i 2 pi (p, q, r)/padded . (n - n_w)).
/// A frequency s (cycles per mm) has the grid index padded_d * (a_d . s) modulo padded_d. The grid
/// follows the lattice's own steps: tilted and anisotropic volumes are not resampled.
class Spectrum {
public:
    /// The field is released after the first of two passes: its memory is free if this was the last
    /// reference. *Throws* Error{outOfMemory}, Cancelled.
    static Spectrum prepare(volume::Field field, const SpectrumLayout &layout,
                            const task::Progress &progress = {});

    const SpectrumLayout &layout() const { return m_layout; }
    const CellLayout &cellLayout() const { return m_cellLayout; }
    const volume::Lattice &lattice() const { return m_lattice; }
    /// The position of the voxel at index 0 of the padded grid.
    volume::PatientPoint wrapPoint() const { return m_wrapPoint; }
    /// *Shape*: cellLayout().lines() lines, and another 64 readable bytes.
    const std::byte *cells() const { return m_cells.get(); }
    /// The factor of a stored cell, a power of two.
    double unit() const { return m_unit; }
    /// dV * sum f: the value at frequency 0 without rounding or interpolation.
    double dc() const { return m_dc; }
    /// dV * sum f (n - n_w), by axis: the value at frequency 0 of the field times the distance from
    /// the wrap voxel. *Units*: those of the mass, times samples.
    const std::array<double, 3> &moments() const { return m_moments; }
    /// The value at a grid index: p in -halo..padded/2 + halo, q and r within halo of
    /// +-padded/2.
    std::complex<double> value(int p, int q, int r) const;
    /// The value at a point between the cells, as these kernels read it; periodic. *Units*: cells,
    /// by axis. *Requires*: no kernel is wider than the layout's.
    std::complex<double> between(std::array<double, 3> cells,
                                 const std::array<Kernel, 3> &kernels) const;
    std::size_t bytes() const { return m_layout.bytes(); }

private:
    Spectrum(const volume::Field &field, const SpectrumLayout &layout);
    std::complex<double> cell(std::size_t index) const; ///< of all, in the order of the lines

    volume::Lattice m_lattice;
    SpectrumLayout m_layout;
    CellLayout m_cellLayout;
    volume::PatientPoint m_wrapPoint;
    std::shared_ptr<std::byte[]> m_cells;
    double m_unit = 1.0, m_dc = 0.0;
    std::array<double, 3> m_moments{};
};

} // namespace pellucid::fourier
