// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::fourier {

/// The smallest even number 2^a 3^b 5^c 7^d that is at least `atLeast`. Transforms of these sizes
/// are fast: 724 = 4 * 181 takes ten times as long as 768.
int smoothEvenSize(int atLeast);

/// The padded size of an axis of `samples` samples: smooth, even, at least padding * samples, and
/// large enough that a kernel does not overlap its own periodic copy.
int paddedSize(int samples, double padding);

} // namespace pellucid::fourier
