// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace pellucid::fourier {

/// Sixteen complex numbers side by side: sixteen real parts, then sixteen imaginary parts. Sixteen
/// transforms run at once, one in each lane, so no transform needs a shuffle.
inline constexpr int stripLanes = 16;
inline constexpr int stripFloats = 2 * stripLanes;

/// One stage of a Stockham transform.
struct StripStage {
    int radix;
    int groups;          ///< length of this stage over radix
    int stride;          ///< product of the radices before
    std::size_t twiddle; ///< where this stage's factors begin
};

/// The plan of an unnormalised transform of one length with exp(+i 2 pi ...), for lengths
/// 2^a 3^b 5^c 7^d. The other sign is had by exchanging real and imaginary parts of input and
/// output. *Source*: Stockham 1966; radices as in Van Loan 1992.
class StripTransform {
public:
    explicit StripTransform(int length);

    int length() const { return m_length; }
    const std::vector<StripStage> &stages() const { return m_stages; }
    /// exp(+i 2 pi p j / (radix groups)), j = 1..radix-1, for p = 0..groups-1; real, imaginary.
    const std::vector<float> &twiddles() const { return m_twiddles; }
    /// Transforms `data` with `scratch` beside it and returns the one that holds the result.
    /// *Shape*: both: length() strips, 64-byte aligned. `data` is overwritten.
    float *run(float *data, float *scratch) const;

private:
    int m_length;
    std::vector<StripStage> m_stages;
    std::vector<float> m_twiddles;
};

} // namespace pellucid::fourier
