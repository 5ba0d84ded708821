// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/crop_box.h"

#include <algorithm>
#include <cmath>

#include "core/classify/reasons.h"
#include "core/task/error.h"

namespace pellucid::classify {

namespace {

struct Range {
    int lo, hi;
};

// Sample centres are at (n + 1/2) / count. A fraction that was rounded from a face is that face.
Range samplesBetween(double low, double high, int count) {
    constexpr double rounding = 1e-9;
    int lo = int(std::ceil(low * count - 0.5 - rounding));
    int hi = int(std::floor(high * count - 0.5 + rounding)) + 1;
    lo = std::clamp(lo, 0, count - 1);
    hi = std::clamp(hi, lo + 1, count);
    return {lo, hi};
}

} // namespace

void validate(const CropBox &box) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(box.low[axis] >= 0.0 && box.high[axis] <= 1.0 && box.low[axis] < box.high[axis]))
            throw task::Error(task::ErrorCode::usage, task::because::cropBoxOutOfRange);
}

volume::VoxelBox samplesIn(const CropBox &box, const volume::GridSize &size) {
    const Range i = samplesBetween(box.low.x, box.high.x, size.i);
    const Range j = samplesBetween(box.low.y, box.high.y, size.j);
    const Range k = samplesBetween(box.low.z, box.high.z, size.k);
    return {{i.lo, j.lo, k.lo}, {i.hi, j.hi, k.hi}};
}

DensityField cropped(DensityField field, const CropBox &box) {
    if (box.isWhole())
        return field;
    const volume::VoxelBox in = samplesIn(box, field.values.lattice().size());
    return fieldOf(field.values.within(in));
}

ShownFields cropped(ShownFields fields, const CropBox &box) {
    for (DensityField &channel : fields.channels)
        channel = cropped(std::move(channel), box);
    return fields;
}

} // namespace pellucid::classify
