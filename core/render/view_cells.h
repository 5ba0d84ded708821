// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>
#include <cstddef>

#include "core/fourier/kernels/kernel.h"

namespace pellucid::render {

/// Rows of floats and their weights: as many as a kernel has taps.
struct WeightedRows {
    std::array<const float *, fourier::Kernel::largestWidth> from{};
    std::array<float, fourier::Kernel::largestWidth> weights{};
    int count = 0;
    void add(const float *row, float weight) {
        from[std::size_t(count)] = row;
        weights[std::size_t(count++)] = weight;
    }
};
/// Sets a row to the weighted sum of rows, or adds it, which rounds once.
void setToSum(const WeightedRows &rows, int count, float *to);
void addSum(const WeightedRows &rows, int count, float *to);

/// Transposes sixteen rows of sixteen floats. *Shape*: `from` is 64-byte aligned, and so is
/// `fromGap` floats.
void transposeRows(const float *from, std::size_t fromGap, float *to, std::size_t toGap);

/// Cells of a periodic spectrum, and a table of the kernel that reads them.
struct ReadCells {
    static constexpr int taps = fourier::Kernel::largestWidth;
    /// Cells beyond the farthest frequency that its taps may read.
    static constexpr int margin = taps / 2 + 1;
    /// The kernel is tabulated at this many offsets per cell, and interpolated linearly: within
    /// 1e-7 of its peak.
    static constexpr int offsets = 2048;
    /// Floats of an offset: a weight for each tap across rows, and two equal ones for each along
    /// them, for real and imaginary parts. *Shape*: eight taps; the last has the weight 0.
    static constexpr std::size_t across = 8, along = 16, tableStride = across + along;

    const float *zero = nullptr; ///< the cell of frequency 0; each is a complex number
    std::ptrdiff_t stride = 0;   ///< floats from one row to the next
    const float *table = nullptr;
    std::array<double, 2> period{}; ///< cells along the rows, and across them
};
/// Reads frequencies in a line. *Units*: cells along the rows, and across them. *Requires*: all
/// cells exist that taps read within half a period, or their mirror images do.
void readLine(const ReadCells &cells, std::array<double, 2> first, std::array<double, 2> step,
              int count, std::complex<float> *values);

} // namespace pellucid::render
