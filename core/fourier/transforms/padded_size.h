// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::fourier {

/// The smallest even number 2^a 3^b 5^c 7^d that is at least `atLeast`: the sizes for which the
/// transforms are fast (724 = 4 * 181 costs ten times 768).
int smoothEvenSize(int atLeast);

/// The padded size of an axis of `samples` samples: smooth, even, at least padding * samples, and
/// never so small that a kernel meets itself around the period.
int paddedSize(int samples, double padding);

} // namespace pellucid::fourier
