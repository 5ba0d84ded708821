// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>

namespace pellucid::fourier {

/// Sixteen complex numbers into a strip with real and imaginary parts exchanged, for a forward
/// transform.
void loadExchanged(const std::complex<float> *from, float *strip);
/// The first `count` strips, each `stripGap` floats apart from the next, exchanged back, times
/// `scale`, as rows of complex numbers `rowGap` apart.
void storeExchanged(const float *strips, int count, float scale, std::complex<float> *rows,
                    std::size_t rowGap);
/// The same as pairs of binary16 numbers: real part in the low half.
void storeExchanged(const float *strips, int count, float scale, std::uint32_t *rows,
                    std::size_t rowGap);
/// Copies lines of `bytes` (a multiple of 64) past the cache: they are not read again soon.
/// *Shape*: to: 64-byte aligned.
void streamLine(const void *from, void *to, std::size_t bytes);
/// Must follow the last streamLine of a thread before others read the lines.
void finishStreaming();

} // namespace pellucid::fourier
