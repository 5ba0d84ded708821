// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/error/shown_rows.h"
#include "core/error/stated_error.h"
#include "core/picture/projector.h"
#include "core/task/progress.h"

namespace pellucid::error {

/// The effort of a spot check.
struct CheckEffort {
    int first = 128; ///< frequencies of the first estimate, besides those that are always summed
    int most = 1024; ///< of the last
    /// The estimate is good enough once its limits are within this share of it.
    double within = 1.0 / 3.0;
    /// Where all frequencies take no more multiplications than this, none is left to chance.
    double complete = 3e8;
    unsigned seed = 1; ///< the same seed draws the same frequencies
};

/// Measures the error of a picture. The error over a whole period is, by Parseval, a sum over the
/// frequencies of its slice:
///   error^2 = sum |P - P'|^2 / sum |P|^2,
/// with P' of the picture and P of the samples, each an exact sum, see `exactFrequencies`. The
/// frequencies within three steps of zero and the hundred brightest always count; the others are
/// drawn, half by the energy around them, which rounding follows, half evenly, as the aliases of
/// points are, and weighted so that the sum is unbiased. The interval is that of the spread of
/// pairs drawn from one stratum. Everything that happened to the picture is in P': the spectrum,
/// the kernels, the transform, the graphics card. *Shape*: `period` is the whole period of the
/// picture, in its camera. `refined` is called with each estimate but the last. *Throws* Cancelled
/// within milliseconds, Error{outOfMemory}.
StatedError spotCheck(const picture::PeriodPicture &period, const scene::ImageDefinition &image,
                      const ShownRows &rows, const CheckEffort &effort = {},
                      const task::Progress &progress = {},
                      const std::function<void(const StatedError &)> &refined = {});

} // namespace pellucid::error
