// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/render/view_cells_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target must come first.
#include <algorithm>
#include <cmath>
#include <hwy/highway.h>

#include "core/render/view_cells.h"

HWY_BEFORE_NAMESPACE();
namespace pellucid::render::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
#include "core/fourier/transforms/transpose_hwy.inc"

template <int sources, bool adds> void combine(const WeightedRows &rows, int count, float *to) {
    const hn::ScalableTag<float> d;
    const auto lanes = int(hn::Lanes(d));
    int n = 0;
    for (; n + lanes <= count; n += lanes) {
        auto sum = hn::Mul(hn::Set(d, rows.weights[0]), hn::LoadU(d, rows.from[0] + n));
        for (std::size_t s = 1; s < sources; ++s)
            sum = hn::MulAdd(hn::Set(d, rows.weights[s]), hn::LoadU(d, rows.from[s] + n), sum);
        hn::StoreU(adds ? hn::Add(hn::LoadU(d, to + n), sum) : sum, d, to + n);
    }
    for (; n < count; ++n) {
        float sum = 0.0F;
        for (std::size_t s = 0; s < sources; ++s)
            sum += rows.weights[s] * rows.from[s][n];
        to[n] = adds ? to[n] + sum : sum;
    }
}

template <bool adds> void combineAny(const WeightedRows &rows, int count, float *to) {
    switch (rows.count) {
    case 0:
        if (!adds)
            std::fill_n(to, count, 0.0F);
        return;
    case 1:
        return combine<1, adds>(rows, count, to);
    case 2:
        return combine<2, adds>(rows, count, to);
    case 3:
        return combine<3, adds>(rows, count, to);
    case 4:
        return combine<4, adds>(rows, count, to);
    case 5:
        return combine<5, adds>(rows, count, to);
    case 6:
        return combine<6, adds>(rows, count, to);
    default:
        return combine<7, adds>(rows, count, to);
    }
}

void setRow(const WeightedRows &rows, int count, float *to) {
    combineAny<false>(rows, count, to);
}
void addRow(const WeightedRows &rows, int count, float *to) {
    combineAny<true>(rows, count, to);
}

void transposeBlock(const float *from, std::size_t fromGap, float *to, std::size_t toGap) {
    transpose(from, fromGap, to, toGap);
}

// The first cell that the taps of a coordinate read, and the place in the table.
struct TapPlace {
    std::ptrdiff_t cell;
    const float *table;
    float share; ///< of the next offset
};
inline TapPlace tapPlace(const ReadCells &cells, double at) {
    constexpr double half = 0.5 * ReadCells::taps;
    const double first = std::ceil(at - half);
    const double offset = (first - at + half) * ReadCells::offsets;
    const int n = std::min(int(offset), ReadCells::offsets - 1);
    return {std::ptrdiff_t(first), cells.table + std::size_t(n) * ReadCells::tableStride,
            float(offset - n)};
}

std::complex<float> readOne(const ReadCells &cells, double along, double across) {
    constexpr std::size_t stride = ReadCells::tableStride, floats = ReadCells::along;
    const hn::CappedTag<float, floats> d;
    const std::size_t lanes = hn::Lanes(d);
    const TapPlace i = tapPlace(cells, along), j = tapPlace(cells, across);
    HWY_ALIGN std::array<float, ReadCells::across> rows;
    for (std::size_t t = 0; t < rows.size(); ++t)
        rows[t] = j.table[t] + j.share * (j.table[stride + t] - j.table[t]);
    HWY_ALIGN std::array<float, floats> sums;
    for (std::size_t lane = 0; lane < floats; lane += lanes) {
        auto sum = hn::Zero(d);
        const float *at = cells.zero + j.cell * cells.stride + 2 * i.cell + std::ptrdiff_t(lane);
        for (std::size_t t = 0; t < ReadCells::taps; ++t, at += cells.stride)
            sum = hn::MulAdd(hn::Set(d, rows[t]), hn::LoadU(d, at), sum);
        const float *const weights = i.table + ReadCells::across + lane;
        const auto here = hn::LoadU(d, weights), next = hn::LoadU(d, weights + stride);
        hn::Store(hn::Mul(sum, hn::MulAdd(hn::Set(d, i.share), hn::Sub(next, here), here)), d,
                  sums.data() + lane);
    }
    float re = 0.0F, im = 0.0F;
    for (std::size_t t = 0; t < floats; t += 2) {
        re += sums[t];
        im += sums[t + 1];
    }
    return {re, im};
}

void readRow(const ReadCells &cells, std::array<double, 2> first, std::array<double, 2> step,
             int count, std::complex<float> *values) {
    const auto inPeriod = [&](std::size_t d, int n) {
        const double at = first[d] + n * step[d];
        return at - cells.period[d] * std::round(at / cells.period[d]);
    };
    for (int n = 0; n < count; ++n) {
        const double along = inPeriod(0, n), across = inPeriod(1, n);
        values[n] = along < 0.0 ? std::conj(readOne(cells, -along, -across))
                                : readOne(cells, along, across);
    }
}

} // namespace pellucid::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::render {

HWY_EXPORT(setRow);
HWY_EXPORT(addRow);
HWY_EXPORT(transposeBlock);
HWY_EXPORT(readRow);

void setToSum(const WeightedRows &rows, int count, float *to) {
    HWY_DYNAMIC_DISPATCH(setRow)(rows, count, to);
}

void addSum(const WeightedRows &rows, int count, float *to) {
    HWY_DYNAMIC_DISPATCH(addRow)(rows, count, to);
}

void transposeRows(const float *from, std::size_t fromGap, float *to, std::size_t toGap) {
    HWY_DYNAMIC_DISPATCH(transposeBlock)(from, fromGap, to, toGap);
}

void readLine(const ReadCells &cells, std::array<double, 2> first, std::array<double, 2> step,
              int count, std::complex<float> *values) {
    HWY_DYNAMIC_DISPATCH(readRow)(cells, first, step, count, values);
}

} // namespace pellucid::render
#endif
