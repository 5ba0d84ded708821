// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/picture/tone_pixels_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <algorithm>
#include <hwy/highway.h>
#include <utility>

#include <hwy/contrib/math/math-inl.h>

#include "core/picture/compose.h"
#include "core/picture/tone_pixels.h"

HWY_BEFORE_NAMESPACE();
namespace pellucid::picture::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, 16>;
using Vector = hn::Vec<Tag>;
using LevelTag = hn::RebindToSigned<Tag>;

// x^toneExponent for x in 0..1.
HWY_INLINE Vector displayed(Vector x) {
    const Tag d;
    const auto power = hn::Exp(d, hn::Mul(hn::Set(d, float(toneExponent)), hn::Log(d, x)));
    return hn::IfThenElseZero(hn::Gt(x, hn::Zero(d)), hn::Min(power, hn::Set(d, 1.0F)));
}

HWY_INLINE hn::Vec<LevelTag> levels(Vector x, bool inverted) {
    const Tag d;
    const auto one = hn::Set(d, 1.0F), full = hn::Set(d, 255.0F), half = hn::Set(d, 0.5F);
    return hn::ConvertTo(LevelTag(), hn::MulAdd(full, inverted ? hn::Sub(one, x) : x, half));
}

HWY_INLINE void storePixels(hn::Vec<LevelTag> first, hn::Vec<LevelTag> green,
                            hn::Vec<LevelTag> third, std::uint8_t *to) {
    const LevelTag d;
    const auto pixel = hn::Or(hn::Or(first, hn::ShiftLeft<8>(green)),
                              hn::Or(hn::ShiftLeft<16>(third), hn::Set(d, -0x1000000)));
    const hn::Repartition<std::uint8_t, LevelTag> bytes;
    hn::StoreU(hn::BitCast(bytes, pixel), bytes, to);
}

void toneGrey(const float *samples, std::size_t count, const ToneCurve &curve,
              std::uint8_t *bytes) {
    const Tag d;
    const auto low = hn::Set(d, curve.low), scale = hn::Set(d, curve.scale);
    for (std::size_t n = 0; n < count; n += hn::Lanes(d)) {
        const auto x = hn::Mul(hn::Sub(hn::LoadU(d, samples + n), low), scale);
        const auto level =
            levels(displayed(hn::Min(hn::Max(x, hn::Zero(d)), hn::Set(d, 1.0F))), curve.inverted);
        storePixels(level, level, level, bytes + 4 * n);
    }
}

// The channels keep their ratio to the brightest. A range that starts below zero raises empty
// pixels to a grey without hue.
void toneColored(const float *samples, std::size_t count, const ToneCurve &curve,
                 std::uint8_t *bytes) {
    const Tag d;
    const auto low = hn::Set(d, curve.low), scale = hn::Set(d, curve.scale), zero = hn::Zero(d),
               one = hn::Set(d, 1.0F), lift = hn::Min(zero, low);
    for (std::size_t n = 0; n < count; n += hn::Lanes(d)) {
        Vector red, green, blue;
        hn::LoadInterleaved3(d, samples + 3 * n, red, green, blue);
        const auto most = hn::Max(red, hn::Max(green, blue));
        const auto x = hn::Mul(hn::Sub(most, low), scale);
        const auto curved = displayed(hn::Min(hn::Max(x, zero), one));
        const auto largest = hn::Max(most, zero);
        const auto hasHue = hn::Gt(largest, lift);
        const auto share = hn::IfThenElse(hasHue, hn::Div(curved, hn::Sub(largest, lift)), curved);
        const auto level = [&](Vector channel) {
            const auto above = hn::IfThenElse(hasHue, hn::Sub(hn::Max(channel, zero), lift), one);
            return levels(hn::Mul(share, above), curve.inverted);
        };
        if (curve.blueFirst)
            std::swap(red, blue);
        storePixels(level(red), level(green), level(blue), bytes + 4 * n);
    }
}

void toneAll(const float *samples, std::size_t count, int channels, const ToneCurve &curve,
             std::uint8_t *bytes) {
    const auto tone = channels == 1 ? toneGrey : toneColored;
    const std::size_t lanes = hn::Lanes(Tag()), whole = count / lanes * lanes, rest = count - whole;
    const auto values = std::size_t(channels);
    tone(samples, whole, curve, bytes);
    if (rest == 0)
        return;
    HWY_ALIGN float last[3 * hn::MaxLanes(Tag())] = {};
    HWY_ALIGN std::uint8_t pixels[4 * hn::MaxLanes(Tag())];
    std::copy_n(samples + whole * values, rest * values, last);
    tone(last, rest, curve, pixels);
    std::copy_n(pixels, 4 * rest, bytes + 4 * whole);
}

} // namespace pellucid::picture::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::picture {

HWY_EXPORT(toneAll);

void tonePixels(const float *samples, std::size_t count, int channels, const ToneCurve &curve,
                std::uint8_t *bytes) {
    HWY_DYNAMIC_DISPATCH(toneAll)(samples, count, channels, curve, bytes);
}

} // namespace pellucid::picture
#endif
