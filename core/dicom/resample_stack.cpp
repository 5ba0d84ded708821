// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/resample_stack.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <tbb/parallel_for.h>

namespace pellucid::dicom {

template <class T>
std::vector<T> resampled(const std::vector<T> &frames, const StackGeometry &geometry,
                         const task::Progress &progress) {
    const volume::Lattice &lattice = geometry.lattice;
    const volume::GridSize size = lattice.size();
    const std::size_t plane = size.offsetOf(0, 0, 1);
    const std::vector<double> &at = geometry.frameOffsetsMm;
    std::vector<T> out(size.count());
    tbb::parallel_for(0, size.k, [&](int k) {
        progress.check();
        const double depth = std::min(k * lattice.sliceDistanceMm(), at.back());
        const auto above = std::upper_bound(at.begin() + 1, at.end() - 1, depth);
        const auto high = std::size_t(above - at.begin()), low = high - 1;
        const double gap = at[high] - at[low];
        const double w = gap > 0.0 ? std::clamp((depth - at[low]) / gap, 0.0, 1.0) : 0.0;
        const T *a = frames.data() + low * plane, *b = frames.data() + high * plane;
        T *to = out.data() + size.offsetOf(0, 0, k);
        for (std::size_t n = 0; n < plane; ++n) {
            const double value = double(a[n]) + w * (double(b[n]) - double(a[n]));
            if constexpr (std::is_same_v<T, float>)
                to[n] = float(value);
            else
                to[n] = T(std::lround(value));
        }
    });
    return out;
}

template std::vector<std::int16_t> resampled(const std::vector<std::int16_t> &,
                                             const StackGeometry &, const task::Progress &);
template std::vector<float> resampled(const std::vector<float> &, const StackGeometry &,
                                      const task::Progress &);

} // namespace pellucid::dicom
