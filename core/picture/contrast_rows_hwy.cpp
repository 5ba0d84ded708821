// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/picture/contrast_rows_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <algorithm>
#include <hwy/highway.h>

#include <hwy/contrib/math/math-inl.h>

#include "core/picture/contrast_rows.h"

HWY_BEFORE_NAMESPACE();
namespace pellucid::picture::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, 16>;
using Vector = hn::Vec<Tag>;

HWY_INLINE Vector constant(float value) {
    return hn::Set(Tag(), value);
}

// A row of partial results, with the pixel before the first and those beyond the last.
class PaddedRow {
public:
    float *first() { return m_values + 1; }
    // Repeats the outermost pixels.
    void close(int width) {
        m_values[0] = m_values[1];
        std::fill_n(m_values + width + 1, 3, m_values[width]);
    }

private:
    float m_values[maxRowWidth + 1 + rowSlack];
};

void brightestRow(const float *pixels, int count, float *to) {
    const Tag d;
    const int lanes = int(hn::Lanes(d));
    int n = 0;
    for (; n + lanes <= count; n += lanes) {
        Vector red, green, blue;
        hn::LoadInterleaved3(d, pixels + 3 * n, red, green, blue);
        hn::StoreU(hn::Max(red, hn::Max(green, blue)), d, to + n);
    }
    for (; n < count; ++n)
        to[n] = std::max({pixels[3 * n], pixels[3 * n + 1], pixels[3 * n + 2]});
}

void averageRows(const float *const *rows, int factor, int width, float *to) {
    const Tag d;
    const int lanes = int(hn::Lanes(d)), whole = width / factor;
    const auto share = constant(1.0F / float(factor * factor));
    int n = 0;
    for (; n + lanes <= whole; n += lanes) {
        auto sum = hn::Zero(d);
        for (int row = 0; row < factor; ++row) {
            Vector a, b, c, e;
            if (factor == 2) {
                hn::LoadInterleaved2(d, rows[row] + 2 * n, a, b);
                sum = hn::Add(sum, hn::Add(a, b));
            } else {
                hn::LoadInterleaved4(d, rows[row] + 4 * n, a, b, c, e);
                sum = hn::Add(sum, hn::Add(hn::Add(a, b), hn::Add(c, e)));
            }
        }
        hn::StoreU(hn::Mul(sum, share), d, to + n);
    }
    for (; n * factor < width; ++n) {
        float sum = 0.0F;
        for (int row = 0; row < factor; ++row)
            for (int k = 0; k < factor; ++k)
                sum += rows[row][std::min(n * factor + k, width - 1)];
        to[n] = sum / float(factor * factor);
    }
}

HWY_INLINE Vector binomial(Vector a, Vector b, Vector c, Vector e) {
    return hn::Mul(hn::MulAdd(constant(3.0F), hn::Add(b, c), hn::Add(a, e)), constant(0.125F));
}

// Columns 2j - 1 .. 2j + 2 of a closed row.
void halveColumns(const float *row, int width, float *to) {
    const Tag d;
    const int half = (width + 1) / 2;
    for (int j = 0; j < half; j += int(hn::Lanes(d))) {
        Vector a, b, c, e;
        hn::LoadInterleaved2(d, row + 2 * j - 1, a, b);
        hn::LoadInterleaved2(d, row + 2 * j + 1, c, e);
        hn::StoreU(binomial(a, b, c, e), d, to + j);
    }
}

HWY_INLINE Vector shareOf(Vector value, const AirRamp &air) {
    const auto above = hn::Sub(value, constant(air.level));
    return hn::Min(hn::Max(hn::Mul(above, constant(air.scale)), hn::Zero(Tag())), constant(1.0F));
}

void halveBodyRow(const FourRows &rows, int width, const AirRamp &air, float *values,
                  float *shares) {
    const Tag d;
    PaddedRow value, share;
    for (int n = 0; n < width; n += int(hn::Lanes(d))) {
        Vector v[4], s[4];
        for (int row = 0; row < 4; ++row) {
            v[row] = hn::LoadU(d, rows[std::size_t(row)] + n);
            s[row] = shareOf(v[row], air);
            v[row] = hn::Mul(v[row], s[row]);
        }
        hn::StoreU(binomial(v[0], v[1], v[2], v[3]), d, value.first() + n);
        hn::StoreU(binomial(s[0], s[1], s[2], s[3]), d, share.first() + n);
    }
    value.close(width);
    share.close(width);
    halveColumns(value.first(), width, values);
    halveColumns(share.first(), width, shares);
}

void halveRow(const FourRows &rows, int width, float *to) {
    const Tag d;
    PaddedRow value;
    for (int n = 0; n < width; n += int(hn::Lanes(d)))
        hn::StoreU(binomial(hn::LoadU(d, rows[0] + n), hn::LoadU(d, rows[1] + n),
                            hn::LoadU(d, rows[2] + n), hn::LoadU(d, rows[3] + n)),
                   d, value.first() + n);
    value.close(width);
    halveColumns(value.first(), width, to);
}

void expandRow(const float *near, const float *far, int coarseWidth, float *to, int width) {
    const Tag d;
    PaddedRow row;
    const auto most = constant(0.75F), rest = constant(0.25F);
    for (int n = 0; n < coarseWidth; n += int(hn::Lanes(d)))
        hn::StoreU(hn::MulAdd(most, hn::LoadU(d, near + n), hn::Mul(rest, hn::LoadU(d, far + n))),
                   d, row.first() + n);
    row.close(coarseWidth);
    for (int n = 0; 2 * n < width; n += int(hn::Lanes(d))) {
        const auto here = hn::Mul(most, hn::LoadU(d, row.first() + n));
        hn::StoreInterleaved2(hn::MulAdd(rest, hn::LoadU(d, row.first() + n - 1), here),
                              hn::MulAdd(rest, hn::LoadU(d, row.first() + n + 1), here), d,
                              to + 2 * n);
    }
}

HWY_INLINE Vector curved(Vector band, const BandFactors &factors) {
    const Tag d;
    const auto x = hn::Mul(band, constant(factors.scale)), u = hn::Mul(x, x);
    const auto amplified = hn::Mul(band, constant(factors.amplification));
    // Most bands are weak: below this, two terms of the series in u have an error of 2e-7.
    constexpr float weak = 0.01F;
    if (hn::AllTrue(d, hn::Lt(u, constant(weak)))) {
        const float b = factors.bend;
        const auto series = hn::MulAdd(u, constant(0.5F * b * (b + 1.0F)), constant(-b));
        return hn::MulAdd(amplified, hn::Mul(u, series), amplified);
    }
    const auto bent =
        hn::Exp(d, hn::Mul(constant(-factors.bend), hn::Log(d, hn::Add(u, constant(1.0F)))));
    return hn::Mul(amplified, bent);
}

void combineRow(const float *values, const float *shares, const float *coarser, float *processed,
                int width, const BandFactors &factors, float *means) {
    const Tag d;
    for (int n = 0; n < width; n += int(hn::Lanes(d))) {
        const auto share = hn::LoadU(d, shares + n), above = hn::LoadU(d, coarser + n);
        // value + (1 - share) x above, over 1, where values are weighted by the share.
        const auto mean = hn::NegMulAdd(hn::Min(share, constant(1.0F)), above,
                                        hn::Add(above, hn::LoadU(d, values + n)));
        hn::StoreU(mean, d, means + n);
        hn::StoreU(hn::Add(hn::LoadU(d, processed + n), curved(hn::Sub(mean, above), factors)), d,
                   processed + n);
    }
}

void combineFinestRow(const float *values, const AirRamp &air, const float *coarser,
                      float *processed, int width, const BandFactors &factors) {
    const Tag d;
    for (int n = 0; n < width; n += int(hn::Lanes(d))) {
        const auto value = hn::LoadU(d, values + n);
        const auto band = hn::Mul(shareOf(value, air), hn::Sub(value, hn::LoadU(d, coarser + n)));
        const auto shown = hn::Add(hn::LoadU(d, processed + n), curved(band, factors));
        hn::StoreU(hn::Sub(shown, value), d, processed + n);
    }
}

void interpolateRow(const float *above, const float *below, float weightBelow, int coarseWidth,
                    int factor, float *to, int width) {
    const Tag d;
    const int lanes = int(hn::Lanes(d));
    PaddedRow row;
    const auto weight = constant(weightBelow);
    float *const blended = factor == 1 ? to : row.first();
    for (int n = 0; n < coarseWidth; n += lanes) {
        const auto first = hn::LoadU(d, above + n);
        hn::StoreU(hn::MulAdd(weight, hn::Sub(hn::LoadU(d, below + n), first), first), d,
                   blended + n);
    }
    if (factor == 1)
        return;
    row.close(coarseWidth);
    for (int n = 0; n * factor < width; n += lanes) {
        const auto here = hn::LoadU(d, row.first() + n);
        const auto before = hn::Sub(hn::LoadU(d, row.first() + n - 1), here),
                   after = hn::Sub(hn::LoadU(d, row.first() + n + 1), here);
        const auto at = [&](Vector toward, float share) {
            return hn::MulAdd(constant(share), toward, here);
        };
        if (factor == 2)
            hn::StoreInterleaved2(at(before, 0.25F), at(after, 0.25F), d, to + 2 * n);
        else
            hn::StoreInterleaved4(at(before, 0.375F), at(before, 0.125F), at(after, 0.125F),
                                  at(after, 0.375F), d, to + 4 * n);
    }
}

} // namespace pellucid::picture::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::picture {

HWY_EXPORT(brightestRow);
HWY_EXPORT(averageRows);
HWY_EXPORT(halveBodyRow);
HWY_EXPORT(halveRow);
HWY_EXPORT(expandRow);
HWY_EXPORT(combineRow);
HWY_EXPORT(combineFinestRow);
HWY_EXPORT(interpolateRow);

void brightest(const float *pixels, int count, int channels, float *to) {
    if (channels == 1)
        std::copy_n(pixels, count, to);
    else
        HWY_DYNAMIC_DISPATCH(brightestRow)(pixels, count, to);
}

void average(const float *const *rows, int factor, int width, float *to) {
    if (factor == 1)
        std::copy_n(rows[0], width, to);
    else
        HWY_DYNAMIC_DISPATCH(averageRows)(rows, factor, width, to);
}

void halveBody(const FourRows &rows, int width, const AirRamp &air, float *values, float *shares) {
    HWY_DYNAMIC_DISPATCH(halveBodyRow)(rows, width, air, values, shares);
}

void halve(const FourRows &rows, int width, float *to) {
    HWY_DYNAMIC_DISPATCH(halveRow)(rows, width, to);
}

void expand(const float *near, const float *far, int coarseWidth, float *to, int width) {
    HWY_DYNAMIC_DISPATCH(expandRow)(near, far, coarseWidth, to, width);
}

void combine(const float *values, const float *shares, const float *coarser, float *processed,
             int width, const BandFactors &factors, float *means) {
    HWY_DYNAMIC_DISPATCH(combineRow)
    (values, shares, coarser, processed, width, factors, means);
}

void combineFinest(const float *values, const AirRamp &air, const float *coarser, float *processed,
                   int width, const BandFactors &factors) {
    HWY_DYNAMIC_DISPATCH(combineFinestRow)
    (values, air, coarser, processed, width, factors);
}

void interpolate(const float *above, const float *below, float weightBelow, int coarseWidth,
                 int factor, float *to, int width) {
    HWY_DYNAMIC_DISPATCH(interpolateRow)
    (above, below, weightBelow, coarseWidth, factor, to, width);
}

} // namespace pellucid::picture
#endif
