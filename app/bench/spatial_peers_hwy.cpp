// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/bench/spatial_peers_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target must come first.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <hwy/highway.h>

#include "app/bench/spatial_work.h"

HWY_BEFORE_NAMESPACE();
namespace pellucid::bench::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using RayTag = hn::CappedTag<float, rayTile>;
using IndexTag = hn::RebindToSigned<RayTag>;
using RayVector = hn::Vec<RayTag>;

// Adds samples first..last (one step apart) of neighbouring rays.
template <bool Clamped>
HWY_INLINE RayVector addSamples(const RayJob &job, const RayVector *start, int first, int last,
                                RayVector sum) {
    const RayTag d;
    const IndexTag di;
    const hn::Repartition<std::int16_t, IndexTag> dp;
    const auto row = hn::Set(di, int(job.rowStride)), plane = hn::Set(di, int(job.planeStride));
    const auto *base = reinterpret_cast<const std::int32_t *>(job.samples);
    for (int n = first; n < last; ++n) {
        RayVector fraction[3];
        hn::Vec<IndexTag> whole[3];
        for (int axis = 0; axis < 3; ++axis) {
            auto p = hn::MulAdd(hn::Set(d, float(n)), hn::Set(d, job.step[axis]), start[axis]);
            // The samples around the volume are zero.
            if constexpr (Clamped)
                p = hn::Min(hn::Max(p, hn::Zero(d)), hn::Set(d, job.end[axis]));
            whole[axis] = hn::ConvertTo(di, p); // p >= 0
            fraction[axis] = hn::Sub(p, hn::ConvertTo(d, whole[axis]));
        }
        const auto index =
            hn::Add(hn::Add(hn::Mul(whole[2], plane), hn::Mul(whole[1], row)), whole[0]);
        const auto offset = hn::ShiftLeft<1>(index); // bytes
        // One load reads two neighbours; their weights are in 1/16384.
        const auto right =
            hn::ConvertTo(di, hn::MulAdd(fraction[0], hn::Set(d, 16384.0F), hn::Set(d, 0.5F)));
        const auto left = hn::Sub(hn::Set(di, 16384), right);
        const auto weights = hn::BitCast(dp, hn::Or(left, hn::ShiftLeft<16>(right)));
        const auto pairAt = [&](const std::int32_t *from) {
            const auto pair = hn::BitCast(dp, hn::GatherOffset(di, from, offset));
            auto odd = hn::Zero(di);
            const auto both = hn::ReorderWidenMulAccumulate(di, pair, weights, hn::Zero(di), odd);
            return hn::ConvertTo(d, hn::RearrangeToOddPlusEven(both, odd));
        };
        const auto at = [&](std::ptrdiff_t shift) {
            return pairAt(reinterpret_cast<const std::int32_t *>(
                reinterpret_cast<const std::int16_t *>(base) + shift));
        };
        const auto v00 = at(0), v10 = at(job.rowStride);
        const auto v01 = at(job.planeStride), v11 = at(job.planeStride + job.rowStride);
        const auto below = hn::MulAdd(hn::Sub(v10, v00), fraction[1], v00);
        const auto above = hn::MulAdd(hn::Sub(v11, v01), fraction[1], v01);
        sum = hn::Add(sum, hn::MulAdd(hn::Sub(above, below), fraction[2], below));
    }
    return sum;
}

void castTile(const RayJob &job, int tileX, int tileY, float *samples, std::size_t &count) {
    const RayTag d;
    struct Rays {
        int any0, any1, all0, all1; // samples of any ray, of all rays
    };
    const std::size_t vectors = rayTile / hn::Lanes(d);
    std::array<Rays, std::size_t(rayTile) * 4> rays{};
    int first = job.farthest, last = -job.farthest;
    const int rows = std::min(rayTile, job.height - tileY);
    for (int y = 0; y < rows; ++y)
        for (std::size_t v = 0; v < vectors; ++v) {
            Rays &r = rays[y * vectors + v];
            r = {job.farthest, -job.farthest, -job.farthest, job.farthest};
            for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
                // Where the ray enters and leaves the support of the tents.
                double enter = -job.farthest, leave = job.farthest;
                const auto x = double(tileX) + double(v * hn::Lanes(d) + lane);
                for (int axis = 0; axis < 3; ++axis) {
                    const double p =
                        job.first[axis] + x * job.perColumn[axis] + (tileY + y) * job.perRow[axis];
                    const double step = job.step[axis], end = job.end[axis];
                    if (std::abs(step) < 1e-9) {
                        if (p <= 0.0 || p >= end)
                            leave = enter - 1.0;
                        continue;
                    }
                    const double a = -p / step, b = (end - p) / step;
                    enter = std::max(enter, std::min(a, b));
                    leave = std::min(leave, std::max(a, b));
                }
                const int from = int(std::floor(enter)) + 1, to = int(std::ceil(leave));
                if (enter >= leave || from >= to) {
                    r.all0 = job.farthest; // this ray misses the volume: nothing is common to all
                    continue;
                }
                count +=
                    tileX + int(v * hn::Lanes(d) + lane) < job.width ? std::size_t(to - from) : 0;
                r.any0 = std::min(r.any0, from);
                r.any1 = std::max(r.any1, to);
                r.all0 = std::max(r.all0, from);
                r.all1 = std::min(r.all1, to);
            }
            first = std::min(first, r.any0);
            last = std::max(last, r.any1);
        }
    HWY_ALIGN std::array<float, std::size_t(rayTile) * rayTile> sums{};
    constexpr int slab = 32;
    for (int from = first; from < last; from += slab)
        for (int y = 0; y < rows; ++y)
            for (std::size_t v = 0; v < vectors; ++v) {
                const Rays &r = rays[y * vectors + v];
                const int begin = std::max(from, r.any0), end = std::min(from + slab, r.any1);
                if (begin >= end)
                    continue;
                RayVector start[3];
                for (int axis = 0; axis < 3; ++axis)
                    start[axis] =
                        hn::MulAdd(hn::Iota(d, float(v * hn::Lanes(d))),
                                   hn::Set(d, float(job.perColumn[axis])),
                                   hn::Set(d, float(job.first[axis] + tileX * job.perColumn[axis] +
                                                    (tileY + y) * job.perRow[axis])));
                float *const at = sums.data() + std::size_t(y) * rayTile + v * hn::Lanes(d);
                auto sum = hn::Load(d, at);
                const int inner0 = std::clamp(r.all0 + 1, begin, end);
                const int inner1 = std::clamp(r.all1 - 1, inner0, end);
                sum = addSamples<true>(job, start, begin, inner0, sum);
                sum = addSamples<false>(job, start, inner0, inner1, sum);
                sum = addSamples<true>(job, start, inner1, end, sum);
                hn::Store(sum, d, at);
            }
    const int columns = std::min(rayTile, job.width - tileX);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x)
            samples[std::size_t(tileY + y) * job.width + tileX + x] =
                job.scale * sums[std::size_t(y) * rayTile + x];
}

// Adds eight slices to one row of the sheared image: sums of eight 12-bit numbers fit 16 bits.
void addSlices(const ShearGroup &group, int width, std::int32_t *row) {
    const hn::ScalableTag<std::int16_t> d;
    const hn::RepartitionToWide<decltype(d)> dw;
    const hn::Half<decltype(d)> half;
    const auto lanes = int(hn::Lanes(d));
    for (int x = group.begin - group.begin % lanes; x < std::min(width, group.end); x += lanes) {
        auto sum = hn::Zero(d);
        for (int n = 0; n < shearSlices; ++n) {
            const ShearedSlice &s = group.slices[n];
            const int from = x - s.shift;
            if (from <= -lanes || from > s.width)
                continue;
            const auto wx = hn::Set(d, s.weightX), wy = hn::Set(d, s.weightY);
            const auto lerp = [&](const std::int16_t *at) {
                const auto a = hn::LoadU(d, at), b = hn::LoadU(d, at - 1);
                return hn::Add(a, hn::MulFixedPoint15(hn::Sub(b, a), wx));
            };
            const auto low = lerp(s.row + from), high = lerp(s.rowBefore + from);
            sum = hn::Add(sum, hn::Add(low, hn::MulFixedPoint15(hn::Sub(high, low), wy)));
        }
        std::int32_t *const to = row + x;
        const auto wide = std::size_t(lanes) / 2;
        hn::StoreU(hn::Add(hn::LoadU(dw, to), hn::PromoteTo(dw, hn::LowerHalf(half, sum))), dw, to);
        hn::StoreU(hn::Add(hn::LoadU(dw, to + wide), hn::PromoteTo(dw, hn::UpperHalf(half, sum))),
                   dw, to + wide);
    }
}

} // namespace pellucid::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::bench {

HWY_EXPORT(castTile);
HWY_EXPORT(addSlices);

void castRayTile(const RayJob &job, int tileX, int tileY, float *samples, std::size_t &count) {
    HWY_DYNAMIC_DISPATCH(castTile)(job, tileX, tileY, samples, count);
}

void addShearedSlices(const ShearGroup &group, int width, std::int32_t *row) {
    HWY_DYNAMIC_DISPATCH(addSlices)(group, width, row);
}

} // namespace pellucid::bench
#endif
