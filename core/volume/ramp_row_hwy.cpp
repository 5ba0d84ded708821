// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/volume/ramp_row_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target must come first.
#include <hwy/highway.h>

#include "core/volume/ramp_row.h"

HWY_BEFORE_NAMESPACE();
namespace pellucid::volume::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::ScalableTag<float>;

inline hn::Vec<Tag> load(const float *from) {
    return hn::LoadU(Tag(), from);
}
inline hn::Vec<Tag> load(const std::int16_t *from) {
    const Tag d;
    const hn::Rebind<std::int32_t, Tag> whole;
    const hn::Rebind<std::int16_t, Tag> half;
    return hn::ConvertTo(d, hn::PromoteTo(whole, hn::LoadU(half, from)));
}

template <class Sample> void ramp(const Ramp &line, const Sample *from, int count, float *to) {
    const Tag d;
    const auto width = int(hn::Lanes(d));
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0F), low = hn::Set(d, line.low),
               scale = hn::Set(d, line.scale);
    int n = 0;
    for (; n + width <= count; n += width) {
        const auto value = hn::Mul(hn::Sub(load(from + n), low), scale);
        // As `Ramp` does: NaN becomes 0.
        const auto most = hn::IfThenElse(hn::Lt(one, value), one, value);
        hn::StoreU(hn::IfThenElse(hn::Lt(zero, most), most, zero), d, to + n);
    }
    for (; n < count; ++n)
        to[n] = line(float(from[n]));
}

void rampShort(const Ramp &line, const std::int16_t *from, int count, float *to) {
    ramp(line, from, count, to);
}
void rampFloat(const Ramp &line, const float *from, int count, float *to) {
    ramp(line, from, count, to);
}

} // namespace pellucid::volume::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::volume {

HWY_EXPORT(rampShort);
HWY_EXPORT(rampFloat);

void rampRow(const Ramp &ramp, const std::int16_t *from, int count, float *to) {
    HWY_DYNAMIC_DISPATCH(rampShort)(ramp, from, count, to);
}

void rampRow(const Ramp &ramp, const float *from, int count, float *to) {
    HWY_DYNAMIC_DISPATCH(rampFloat)(ramp, from, count, to);
}

} // namespace pellucid::volume
#endif
