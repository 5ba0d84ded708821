// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace pellucid::fourier {

/// A strip is sixteen complex numbers: sixteen real parts, then sixteen imaginary parts. Sixteen
/// transforms run at once, one in each lane, so that none of them needs a shuffle.
inline constexpr int stripLanes = 16;
inline constexpr int stripFloats = 2 * stripLanes;

/// One stage of a Stockham transform.
struct StripStage {
    int radix;
    int groups;          ///< length of this stage over radix
    int stride;          ///< product of the radices of earlier stages
    std::size_t twiddle; ///< index of this stage's first factor
};

/// The plan of sixteen unnormalised transforms of one length with exp(+i 2 pi ...), for lengths
/// 2^a 3^b 5^c 7^d. Exchange real and imaginary parts of input and output for the other sign.
/// *Source*: Stockham 1966; radices as in Van Loan 1992.
///
/// Not FFTW: for sixteen transforms of 128 to 1024 points, planned patiently and run by one thread
/// of a processor with AVX-512, FFTW 3.3.10 takes 6 to 10 times as long on strips (its guru
/// interface with split parts), and 1.8 to 2.9 times as long on complex numbers whose transforms
/// are interleaved in the same way. If each transform is contiguous, it takes 0.9 to 1.7 times as
/// long, without the transposition that the slice would then need before and after.
class StripTransform {
public:
    explicit StripTransform(int length);

    int length() const { return m_length; }
    const std::vector<StripStage> &stages() const { return m_stages; }
    /// exp(+i 2 pi p j / (radix groups)), j = 1..radix-1, for p = 0..groups-1; real, imaginary.
    const std::vector<float> &twiddles() const { return m_twiddles; }
    /// Transforms `data` and returns the buffer that holds the result, `data` or `scratch`; the
    /// other is overwritten. The strips outer + 1 .. length - outer - 1 count as zero, whatever is
    /// there. *Shape*: both buffers: length() strips, 64-byte aligned.
    float *run(float *data, float *scratch, int outer) const;

private:
    int m_length;
    std::vector<StripStage> m_stages;
    std::vector<float> m_twiddles;
};

} // namespace pellucid::fourier
