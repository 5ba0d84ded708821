// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/fourier/kernels/kernel.h"
#include "core/system/recycled_memory.h"

namespace pellucid::picture {

/// A large array that is not set to zero before it is filled.
using Samples = std::vector<float, system::RecycledAllocator<float>>;

/// A projection; values may be negative. *Units*: field times mm. *Shape*: height x width, rows
/// from the top, or height x width x 3 in linear red, green and blue.
struct ProjectionImage {
    int width = 0, height = 0;
    double pixelMm = 1.0;
    Samples samples;
    int channels = 1;
};

/// The durations of a frame's steps, milliseconds, and what it read.
struct FrameTimes {
    double sliceMs = 0.0, transformMs = 0.0;
    /// The share of the frequencies that is read by a kernel of each width; 0: not read. All are 0
    /// if there is no slice.
    std::array<double, fourier::Kernel::largestWidth + 1> widthShares{};
    double totalMs() const { return sliceMs + transformMs; }
};

} // namespace pellucid::picture
