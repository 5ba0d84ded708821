// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/fourier/transforms/strip_transform_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <cmath>
#include <cstring>
#include <hwy/highway.h>
#include <utility>

#include "core/fourier/transforms/strip_transform.h"

HWY_BEFORE_NAMESPACE();
namespace pellucid::fourier::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
#include "core/fourier/transforms/strip_transform_hwy.inc"

float *runStripTransform(const StripTransform &plan, float *data, float *scratch, int outer) {
    return runTransform(plan, data, scratch, outer);
}

} // namespace pellucid::fourier::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::fourier {

HWY_EXPORT(runStripTransform);

float *StripTransform::run(float *data, float *scratch, int outer) const {
    return HWY_DYNAMIC_DISPATCH(runStripTransform)(*this, data, scratch, outer);
}

} // namespace pellucid::fourier
#endif
