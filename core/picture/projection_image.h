// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace pellucid::picture {

/// A projection; values may be negative. *Units*: field times mm. *Shape*: height x width, rows
/// from the top, or height x width x 3 in linear red, green and blue.
struct ProjectionImage {
    int width = 0, height = 0;
    double pixelMm = 1.0;
    std::vector<float> samples;
    int channels = 1;
};

/// The durations of a frame's steps, milliseconds.
struct FrameTimes {
    double sliceMs = 0.0, transformMs = 0.0;
    double totalMs() const { return sliceMs + transformMs; }
};

} // namespace pellucid::picture
