// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/spectrum.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/fourier/binary16.h"
#include "core/fourier/spectrum_passes.h"

namespace pellucid::fourier {

CellLayout::CellLayout(const SpectrumLayout &layout)
    : halo(layout.width() / 2 + 1), step(columnCells + 1 - layout.width()),
      columns((layout.padded.i / 2 + 1 + 2 * halo - layout.width()) / step + 1),
      rows(layout.padded.j + 1 + 2 * halo),
      planes((layout.padded.k + 2 * halo + planesTogether) / planesTogether * planesTogether),
      firstX(-halo), firstY(-layout.padded.j / 2 - halo), firstZ(-layout.padded.k / 2 - halo) {}

bool SpectrumLayout::addressable() const {
    return CellLayout(*this).lines() < (std::size_t(1) << 32) / CellLayout::columnCells;
}

std::size_t SpectrumLayout::bytes() const {
    return CellLayout(*this).lines() * CellLayout::columnCells * bytesPerCell(storage) + 64;
}

std::size_t SpectrumLayout::peakBytes() const {
    return ColumnMemory::bytes(*this) + planeBytes(*this);
}

Spectrum::Spectrum(const volume::Field &field, const SpectrumLayout &layout)
    : m_lattice(field.lattice()), m_layout(layout), m_cellLayout(layout) {
    const volume::VoxelBox &box = layout.box;
    const volume::GridSize size = box.size();
    m_wrapPoint = m_lattice.patient(
        volume::VoxelIndex{box.lo.i + size.i / 2, box.lo.j + size.j / 2, box.lo.k + size.k / 2});
}

Spectrum Spectrum::prepare(volume::Field field, const SpectrumLayout &layout,
                           const task::Progress &progress) {
    assert(layout.addressable());
    Spectrum spectrum(field, layout);
    const CellLayout &cells = spectrum.m_cellLayout;
    ColumnMemory memory(layout, cells);
    constexpr double firstPass = 0.3;
    const FieldSums sums =
        transformRows(field, layout, cells, memory, progress.part(0.0, firstPass));
    field = {};
    progress.report(firstPass);
    spectrum.m_dc = sums.dc;
    spectrum.m_moments = sums.moments;
    float scale = 1.0F;
    // The sum of the magnitudes bounds every cell; a power of two scales without rounding.
    if (layout.storage == Storage::binary16 && sums.magnitudes > 0.0)
        scale = float(std::exp2(std::floor(std::log2(32768.0 / sums.magnitudes))));
    spectrum.m_unit = 1.0 / double(scale);
    transformColumns(layout, cells, memory, scale, progress.part(firstPass, 1.0));
    spectrum.m_cells = memory.takeCells();
    return spectrum;
}

std::complex<double> Spectrum::value(int p, int q, int r) const {
    const CellLayout &c = m_cellLayout;
    const int x = p - c.firstX;
    const int column = std::min(x / c.step, c.columns - 1);
    const std::size_t line = c.line(column, r - c.firstZ, q - c.firstY);
    return cell(line * CellLayout::columnCells + std::size_t(x - column * c.step));
}

std::complex<double> Spectrum::cell(std::size_t index) const {
    if (m_layout.storage == Storage::float32)
        return std::complex<double>(
            reinterpret_cast<const std::complex<float> *>(m_cells.get())[index]);
    const std::uint32_t pair = reinterpret_cast<const std::uint32_t *>(m_cells.get())[index];
    return m_unit * std::complex<double>(fromBinary16(std::uint16_t(pair)),
                                         fromBinary16(std::uint16_t(pair >> 16)));
}

std::complex<double> Spectrum::between(std::array<double, 3> cells,
                                       const std::array<Kernel, 3> &kernels) const {
    for (std::size_t d = 0; d < 3; ++d)
        cells[d] -= m_layout.padded[int(d)] * std::round(cells[d] / m_layout.padded[int(d)]);
    // The half with negative x is the mirrored conjugate of the other.
    const bool isMirrored = cells[0] < 0.0;
    const int width = kernels[0].width();
    std::array<int, 3> first{};
    std::array<std::array<double, Kernel::largestWidth>, 3> taps{};
    for (std::size_t d = 0; d < 3; ++d) {
        const double at = isMirrored ? -cells[d] : cells[d];
        first[d] = int(std::ceil(at - 0.5 * width));
        for (int k = 0; k < width; ++k)
            taps[d][std::size_t(k)] = kernels[d].value(first[d] + k - at);
    }
    const CellLayout &c = m_cellLayout;
    const int x = first[0] - c.firstX, column = std::min(x / c.step, c.columns - 1);
    std::complex<double> sum = 0.0;
    for (int r = 0; r < width; ++r)
        for (int q = 0; q < width; ++q) {
            const std::size_t line =
                c.line(column, first[2] + r - c.firstZ, first[1] + q - c.firstY);
            const std::size_t at =
                line * CellLayout::columnCells + std::size_t(x - column * c.step);
            std::complex<double> row = 0.0;
            for (std::size_t p = 0; p < std::size_t(width); ++p)
                row += taps[0][p] * cell(at + p);
            sum += taps[1][std::size_t(q)] * taps[2][std::size_t(r)] * row;
        }
    return isMirrored ? std::conj(sum) : sum;
}

} // namespace pellucid::fourier
