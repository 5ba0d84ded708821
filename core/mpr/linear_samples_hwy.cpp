// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/mpr/linear_samples_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target must come first.
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "core/mpr/linear_samples.h"

HWY_BEFORE_NAMESPACE();
namespace pellucid::mpr::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, 16>;
using IndexTag = hn::RebindToSigned<Tag>;
using Vector = hn::Vec<Tag>;
using Index = hn::Vec<IndexTag>;

// The points' positions along one axis, relative to a sample near the first point.
struct Along {
    int base;
    float first, step, low, high, lastCell;

    Along(double start, double by, int size) {
        const int cell = std::max(0, size - 2); // the last sample with a successor, if there is one
        base = int(std::clamp(std::floor(start), 0.0, double(cell)));
        first = float(start - base);
        step = float(by);
        low = float(-base);
        high = float(size - 1 - base);
        lastCell = float(cell - base);
    }
    HWY_INLINE void at(Vector points, Index &cell, Vector &fraction) const {
        const Tag d;
        const auto x = hn::Min(
            hn::Max(hn::MulAdd(points, hn::Set(d, step), hn::Set(d, first)), hn::Set(d, low)),
            hn::Set(d, high));
        const auto whole = hn::Min(hn::Floor(x), hn::Set(d, lastCell));
        fraction = hn::Sub(x, whole);
        cell = hn::ConvertTo(IndexTag(), whole);
    }
};

// Interpolates two neighbours of a row, which one 32-bit load reads.
HWY_INLINE Vector between(const std::int16_t *row, Index at, Vector fraction) {
    const IndexTag di;
    const auto pair =
        hn::GatherOffset(di, reinterpret_cast<const std::int32_t *>(row), hn::ShiftLeft<1>(at));
    const Tag d;
    const auto a = hn::ConvertTo(d, hn::ShiftRight<16>(hn::ShiftLeft<16>(pair)));
    const auto b = hn::ConvertTo(d, hn::ShiftRight<16>(pair));
    return hn::MulAdd(fraction, hn::Sub(b, a), a);
}
HWY_INLINE Vector between(const float *row, Index at, Vector fraction) {
    const Tag d;
    const auto a = hn::GatherIndex(d, row, at), b = hn::GatherIndex(d, row + 1, at);
    return hn::MulAdd(fraction, hn::Sub(b, a), a);
}

template <class T>
HWY_INLINE void sample(const T *samples, const volume::GridSize &size, const SampleLine &line,
                       float *out) {
    const Tag d;
    const Along x(line.start.x, line.step.x, size.i), y(line.start.y, line.step.y, size.j),
        z(line.start.z, line.step.z, size.k);
    const std::ptrdiff_t row = size.i, slice = row * size.j;
    const T *const base = samples + z.base * slice + y.base * row + x.base;
    const std::ptrdiff_t nextRow = size.j > 1 ? row : 0, nextSlice = size.k > 1 ? slice : 0;
    const IndexTag di;
    for (int c = 0; c < line.count; c += int(hn::Lanes(d))) {
        const auto points = hn::Iota(d, float(c));
        Index i, j, k;
        Vector fx, fy, fz;
        x.at(points, i, fx);
        y.at(points, j, fy);
        z.at(points, k, fz);
        const auto at = hn::Add(i, hn::Add(hn::Mul(j, hn::Set(di, std::int32_t(row))),
                                           hn::Mul(k, hn::Set(di, std::int32_t(slice)))));
        const auto n = between(base, at, fx), m = between(base + nextRow, at, fx),
                   p = between(base + nextSlice, at, fx),
                   q = between(base + nextSlice + nextRow, at, fx);
        const auto front = hn::MulAdd(fy, hn::Sub(m, n), n),
                   back = hn::MulAdd(fy, hn::Sub(q, p), p);
        hn::StoreU(hn::MulAdd(fz, hn::Sub(back, front), front), d, out + c);
    }
}

void sampleShorts(const std::int16_t *samples, const volume::GridSize &size, const SampleLine &line,
                  float *out) {
    sample(samples, size, line, out);
}
void sampleFloats(const float *samples, const volume::GridSize &size, const SampleLine &line,
                  float *out) {
    sample(samples, size, line, out);
}

} // namespace pellucid::mpr::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::mpr {

HWY_EXPORT(sampleShorts);
HWY_EXPORT(sampleFloats);

void linearSamples(const std::int16_t *samples, const volume::GridSize &size,
                   const SampleLine &line, float *out) {
    HWY_DYNAMIC_DISPATCH(sampleShorts)(samples, size, line, out);
}
void linearSamples(const float *samples, const volume::GridSize &size, const SampleLine &line,
                   float *out) {
    HWY_DYNAMIC_DISPATCH(sampleFloats)(samples, size, line, out);
}

} // namespace pellucid::mpr
#endif
