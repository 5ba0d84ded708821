// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/fourier/transforms/strip_copies_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "core/fourier/transforms/strip_copies.h"
#include "core/fourier/transforms/strip_transform.h"

HWY_BEFORE_NAMESPACE();
namespace pellucid::fourier::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, stripLanes>;
using BitsTag = hn::RebindToUnsigned<Tag>;

void loadStrip(const std::complex<float> *from, float *strip) {
    const Tag d;
    const auto *in = reinterpret_cast<const float *>(from);
    for (std::size_t lane = 0; lane < stripLanes; lane += hn::Lanes(d)) {
        hn::Vec<Tag> re, im;
        hn::LoadInterleaved2(d, in + 2 * lane, re, im);
        hn::Store(im, d, strip + lane);
        hn::Store(re, d, strip + stripLanes + lane);
    }
}

void storeSingles(const float *strips, int count, float scale, std::complex<float> *rows,
                  std::size_t rowGap) {
    const Tag d;
    const auto unit = hn::Set(d, scale);
    for (int n = 0; n < count; ++n, strips += stripFloats, rows += rowGap)
        for (std::size_t lane = 0; lane < stripLanes; lane += hn::Lanes(d))
            hn::StoreInterleaved2(hn::Mul(unit, hn::Load(d, strips + stripLanes + lane)),
                                  hn::Mul(unit, hn::Load(d, strips + lane)), d,
                                  reinterpret_cast<float *>(rows) + 2 * lane);
}

// toBinary16 for vectors. Highway's own conversion truncates and wraps on processors without an
// instruction for it.
HWY_INLINE hn::Vec<BitsTag> halves(hn::Vec<Tag> value) {
    const Tag d;
    const BitsTag du;
    const auto bits = hn::BitCast(du, value);
    const auto sign = hn::And(hn::ShiftRight<16>(bits), hn::Set(du, 0x8000U));
    const auto magnitude = hn::And(bits, hn::Set(du, 0x7fffffffU));
    const auto small =
        hn::Sub(hn::BitCast(du, hn::Add(hn::BitCast(d, magnitude), hn::Set(d, 0.5F))),
                hn::Set(du, 0x3f000000U));
    const auto odd = hn::And(hn::ShiftRight<13>(magnitude), hn::Set(du, 1U));
    const auto rounded = hn::Add(hn::Add(magnitude, hn::Set(du, 0xfffU - 0x38000000U)), odd);
    const auto isSmall = hn::Lt(magnitude, hn::Set(du, 0x38800000U));
    return hn::Or(sign, hn::IfThenElse(isSmall, small, hn::ShiftRight<13>(rounded)));
}

void storeHalves(const float *strips, int count, float scale, std::uint32_t *rows,
                 std::size_t rowGap) {
    const Tag d;
    const BitsTag du;
    const auto unit = hn::Set(d, scale);
    for (int n = 0; n < count; ++n, strips += stripFloats, rows += rowGap)
        for (std::size_t lane = 0; lane < stripLanes; lane += hn::Lanes(d)) {
            const auto re = halves(hn::Mul(unit, hn::Load(d, strips + stripLanes + lane)));
            const auto im = halves(hn::Mul(unit, hn::Load(d, strips + lane)));
            hn::StoreU(hn::Or(re, hn::ShiftLeft<16>(im)), du, rows + lane);
        }
}

void stream(const void *from, void *to, std::size_t bytes) {
    const BitsTag du;
    const auto *in = static_cast<const std::uint32_t *>(from);
    auto *out = static_cast<std::uint32_t *>(to);
    for (std::size_t n = 0; n < bytes / 4; n += hn::Lanes(du))
        hn::Stream(hn::LoadU(du, in + n), du, out + n);
}

} // namespace pellucid::fourier::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::fourier {

HWY_EXPORT(loadStrip);
HWY_EXPORT(storeSingles);
HWY_EXPORT(storeHalves);
HWY_EXPORT(stream);

void loadExchanged(const std::complex<float> *from, float *strip) {
    HWY_DYNAMIC_DISPATCH(loadStrip)(from, strip);
}

void storeExchanged(const float *strips, int count, float scale, std::complex<float> *rows,
                    std::size_t rowGap) {
    HWY_DYNAMIC_DISPATCH(storeSingles)(strips, count, scale, rows, rowGap);
}

void storeExchanged(const float *strips, int count, float scale, std::uint32_t *rows,
                    std::size_t rowGap) {
    HWY_DYNAMIC_DISPATCH(storeHalves)(strips, count, scale, rows, rowGap);
}

void streamLine(const void *from, void *to, std::size_t bytes) {
    HWY_DYNAMIC_DISPATCH(stream)(from, to, bytes);
}

void finishStreaming() {
    hwy::FlushStream();
}

} // namespace pellucid::fourier
#endif
