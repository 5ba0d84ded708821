// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/error/row_sums_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/highway.h>

#include "core/error/row_sums.h"

HWY_BEFORE_NAMESPACE();
namespace pellucid::error::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, RowGroup::lanes>;
using Vector = hn::Vec<Tag>;

// The sums of `Rows` rows from `row` on at the frequencies of one vector. As many rows as registers
// have room for.
template <int Rows>
HWY_INLINE void sumRows(const RowGroup &group, int row, const float *table, float *real,
                        float *imaginary) {
    const Tag d;
    Vector cosines[Rows], sines[Rows];
    HWY_UNROLL(8)
    for (int r = 0; r < Rows; ++r)
        cosines[r] = sines[r] = hn::Zero(d);
    const float *sums[Rows], *differences[Rows];
    HWY_UNROLL(8)
    for (int r = 0; r < Rows; ++r) {
        sums[r] = group.sums[std::size_t(row + r)];
        differences[r] = group.differences[std::size_t(row + r)];
    }
    table += std::size_t(group.firstPair) * 2 * RowGroup::lanes;
    for (int pair = group.firstPair; pair < group.pairs; ++pair, table += 2 * RowGroup::lanes) {
        const auto cosine = hn::Load(d, table), sine = hn::Load(d, table + RowGroup::lanes);
        HWY_UNROLL(8)
        for (int r = 0; r < Rows; ++r) {
            cosines[r] = hn::MulAdd(hn::Set(d, sums[r][pair]), cosine, cosines[r]);
            sines[r] = hn::MulAdd(hn::Set(d, differences[r][pair]), sine, sines[r]);
        }
    }
    HWY_UNROLL(8)
    for (int r = 0; r < Rows; ++r) {
        hn::Store(cosines[r], d, real + (row + r) * RowGroup::lanes);
        hn::Store(sines[r], d, imaginary + (row + r) * RowGroup::lanes);
    }
}

void addRows(const RowGroup &group, const float *table,
             const std::array<const double *, RowGroup::rows> &phases, double *real,
             double *imaginary) {
    const Tag d;
    HWY_ALIGN float cosines[RowGroup::rows * RowGroup::lanes];
    HWY_ALIGN float sines[RowGroup::rows * RowGroup::lanes];
    // 32 registers hold the sums of eight rows, 16 those of four.
    constexpr int together = HWY_TARGET <= HWY_AVX3 ? 8 : 4;
    for (int lane = 0; lane < RowGroup::lanes; lane += int(hn::Lanes(d)))
        for (int row = 0; row < RowGroup::rows; row += together)
            sumRows<together>(group, row, table + lane, cosines + lane, sines + lane);
    const hn::CappedTag<double, RowGroup::lanes / 2> dd;
    const hn::Rebind<float, decltype(dd)> half;
    for (std::size_t lane = 0; lane < RowGroup::lanes; lane += hn::Lanes(dd)) {
        auto sumReal = hn::Load(dd, real + lane), sumImaginary = hn::Load(dd, imaginary + lane);
        for (int row = 0; row < RowGroup::rows; ++row) {
            // (c - i s) (cos - i sin)
            const auto c = hn::PromoteTo(dd,
                                         hn::Load(half, cosines + row * RowGroup::lanes + lane)),
                       s = hn::PromoteTo(dd, hn::Load(half, sines + row * RowGroup::lanes + lane));
            const double *const phase = phases[std::size_t(row)];
            const auto cosine = hn::Load(dd, phase + lane),
                       sine = hn::Load(dd, phase + RowGroup::lanes + lane);
            sumReal = hn::NegMulAdd(s, sine, hn::MulAdd(c, cosine, sumReal));
            sumImaginary = hn::NegMulAdd(c, sine, hn::NegMulAdd(s, cosine, sumImaginary));
        }
        hn::Store(sumReal, dd, real + lane);
        hn::Store(sumImaginary, dd, imaginary + lane);
    }
}

int foldRow(const float *samples, int count, float *sums, float *differences) {
    const hn::CappedTag<float, 16> d;
    const int pairs = count / 2, lanes = int(hn::Lanes(d));
    int first = -1, n = 0;
    const auto note = [&](int from, bool isDark) {
        if (first < 0 && !isDark)
            first = from;
    };
    for (; n + lanes <= pairs; n += lanes) {
        const auto left = hn::LoadU(d, samples + n),
                   right = hn::Reverse(d, hn::LoadU(d, samples + count - n - lanes));
        hn::StoreU(hn::Add(right, left), d, sums + n);
        hn::StoreU(hn::Sub(right, left), d, differences + n);
        if (first < 0)
            note(n, hn::AllTrue(d, hn::And(hn::Eq(left, hn::Zero(d)), hn::Eq(right, hn::Zero(d)))));
    }
    for (; n < pairs; ++n) {
        const float left = samples[n], right = samples[count - 1 - n];
        sums[n] = right + left;
        differences[n] = right - left;
        note(n, left == 0.0F && right == 0.0F);
    }
    if (count % 2 != 0) {
        sums[n] = samples[n];
        differences[n] = 0.0F;
        note(n, samples[n] == 0.0F);
    }
    return first;
}

} // namespace pellucid::error::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::error {

HWY_EXPORT(addRows);
HWY_EXPORT(foldRow);

void addRows(const RowGroup &group, const float *table,
             const std::array<const double *, RowGroup::rows> &phases, double *real,
             double *imaginary) {
    HWY_DYNAMIC_DISPATCH(addRows)(group, table, phases, real, imaginary);
}

int foldRow(const float *samples, int count, float *sums, float *differences) {
    return HWY_DYNAMIC_DISPATCH(foldRow)(samples, count, sums, differences);
}

} // namespace pellucid::error
#endif
