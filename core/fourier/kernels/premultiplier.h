// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/fourier/kernels/kernel.h"

namespace pellucid::fourier {

/// 1/h at each sample of an axis, with the wrap voxel in the middle: the factors applied before the
/// transform.
inline std::vector<float> premultiplier(const Kernel &kernel, int samples, int padded) {
    std::vector<float> factors(std::size_t(samples), 0.0F);
    for (int n = 0; n < samples; ++n)
        factors[std::size_t(n)] =
            float(1.0 / kernel.apodisation(double(n - samples / 2) / padded)); // NOLINT: whole
    return factors;
}

} // namespace pellucid::fourier
