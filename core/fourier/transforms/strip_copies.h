// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>

namespace pellucid::fourier {

/// Copies sixteen complex numbers into a strip and exchanges real and imaginary parts, for a
/// forward transform.
void loadExchanged(const std::complex<float> *from, float *strip);
/// Copies the first `count` of adjacent strips into rows of complex numbers that are `rowGap`
/// apart, exchanges the parts back, and multiplies by `scale`.
void storeExchanged(const float *strips, int count, float scale, std::complex<float> *rows,
                    std::size_t rowGap);
/// The same into pairs of binary16 numbers, the real part in the low half.
void storeExchanged(const float *strips, int count, float scale, std::uint32_t *rows,
                    std::size_t rowGap);
/// Copies a line of `bytes` (a multiple of 64) past the cache, because it is not read again soon.
/// *Shape*: `to` is 64-byte aligned.
void streamLine(const void *from, void *to, std::size_t bytes);
/// Each thread calls it after its last `streamLine`, before others read the lines.
void finishStreaming();

} // namespace pellucid::fourier
