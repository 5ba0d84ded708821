// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/picture/tone_pixels_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <algorithm>
#include <hwy/highway.h>
#include <utility>

#include <hwy/contrib/math/math-inl.h>

#include "core/picture/tone_pixels.h"

HWY_BEFORE_NAMESPACE();
namespace pellucid::picture::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, 16>;
using Vector = hn::Vec<Tag>;
using LevelTag = hn::RebindToSigned<Tag>;

// A curve as vectors. The grey of a brightness, 0..1: x^exponent within the range, faded where the
// brightness is that of air.
class Curve {
public:
    explicit Curve(const ToneCurve &curve)
        : m_low(constant(curve.low)), m_scale(constant(curve.scale)),
          m_exponent(constant(curve.exponent)), m_air(constant(curve.air)),
          m_body(constant(curve.airFade > 0.0F ? 1.0F / curve.airFade : 0.0F)),
          m_isLinear(curve.exponent == 1.0F), m_hasAir(curve.airFade > 0.0F) {}

    HWY_INLINE Vector grey(Vector brightness, Vector correction) const {
        const Tag d;
        const auto one = constant(1.0F), zero = hn::Zero(d);
        const auto x = clamped(hn::Mul(hn::Sub(hn::Add(brightness, correction), m_low), m_scale));
        auto grey = x;
        if (!m_isLinear) {
            // Black pixels would be slow: their logarithm is infinite, their power denormal.
            const auto power =
                hn::Exp(d, hn::Mul(m_exponent, hn::Log(d, hn::Max(x, constant(1e-6F)))));
            grey = hn::IfThenElseZero(hn::Gt(x, zero), hn::Min(power, one));
        }
        if (!m_hasAir)
            return grey;
        const auto share = clamped(hn::Mul(hn::Sub(brightness, m_air), m_body));
        const auto smooth =
            hn::Mul(hn::Mul(share, share), hn::NegMulAdd(constant(2.0F), share, constant(3.0F)));
        return hn::Mul(grey, smooth);
    }

private:
    static HWY_INLINE Vector constant(float value) { return hn::Set(Tag(), value); }
    static HWY_INLINE Vector clamped(Vector x) {
        return hn::Min(hn::Max(x, hn::Zero(Tag())), constant(1.0F));
    }

    Vector m_low, m_scale, m_exponent, m_air, m_body;
    bool m_isLinear, m_hasAir;
};

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

HWY_INLINE Vector correctionAt(const float *corrections, std::size_t n) {
    const Tag d;
    return corrections == nullptr ? hn::Zero(d) : hn::LoadU(d, corrections + n);
}

void toneGrey(const float *samples, const float *corrections, std::size_t count,
              const ToneCurve &settings, std::uint8_t *bytes) {
    const Tag d;
    const Curve curve(settings);
    for (std::size_t n = 0; n < count; n += hn::Lanes(d)) {
        const auto level = levels(
            curve.grey(hn::LoadU(d, samples + n), correctionAt(corrections, n)), settings.inverted);
        storePixels(level, level, level, bytes + 4 * n);
    }
}

// The channels keep their ratio to the brightest. A range that starts below zero raises empty
// pixels to a grey without hue.
void toneColored(const float *samples, const float *corrections, std::size_t count,
                 const ToneCurve &settings, std::uint8_t *bytes) {
    const Tag d;
    const Curve curve(settings);
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0F),
               lift = hn::Min(zero, hn::Set(d, settings.low));
    for (std::size_t n = 0; n < count; n += hn::Lanes(d)) {
        Vector red, green, blue;
        hn::LoadInterleaved3(d, samples + 3 * n, red, green, blue);
        const auto most = hn::Max(red, hn::Max(green, blue));
        const auto curved = curve.grey(most, correctionAt(corrections, n));
        const auto largest = hn::Max(most, zero);
        const auto hasHue = hn::Gt(largest, lift);
        const auto share = hn::IfThenElse(hasHue, hn::Div(curved, hn::Sub(largest, lift)), curved);
        const auto level = [&](Vector channel) {
            const auto above = hn::IfThenElse(hasHue, hn::Sub(hn::Max(channel, zero), lift), one);
            return levels(hn::Mul(share, above), settings.inverted);
        };
        if (settings.blueFirst)
            std::swap(red, blue);
        storePixels(level(red), level(green), level(blue), bytes + 4 * n);
    }
}

void toneAll(const float *samples, const float *corrections, std::size_t count, int channels,
             const ToneCurve &curve, std::uint8_t *bytes) {
    const auto tone = channels == 1 ? toneGrey : toneColored;
    const std::size_t lanes = hn::Lanes(Tag()), whole = count / lanes * lanes, rest = count - whole;
    const auto values = std::size_t(channels);
    tone(samples, corrections, whole, curve, bytes);
    if (rest == 0)
        return;
    HWY_ALIGN float last[3 * hn::MaxLanes(Tag())] = {};
    HWY_ALIGN float lastCorrections[hn::MaxLanes(Tag())] = {};
    HWY_ALIGN std::uint8_t pixels[4 * hn::MaxLanes(Tag())];
    std::copy_n(samples + whole * values, rest * values, last);
    if (corrections != nullptr)
        std::copy_n(corrections + whole, rest, lastCorrections);
    tone(last, lastCorrections, rest, curve, pixels);
    std::copy_n(pixels, 4 * rest, bytes + 4 * whole);
}

} // namespace pellucid::picture::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::picture {

HWY_EXPORT(toneAll);

void tonePixels(const float *samples, const float *corrections, std::size_t count, int channels,
                const ToneCurve &curve, std::uint8_t *bytes) {
    HWY_DYNAMIC_DISPATCH(toneAll)(samples, corrections, count, channels, curve, bytes);
}

} // namespace pellucid::picture
#endif
