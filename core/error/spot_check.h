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
    /// As many frequencies are summed as these multiplications pay for, a quarter of them first.
    /// Where they pay for half of all frequencies, all are, and none is left to chance.
    double multiplications = 5e8;
    /// At least this many, however large the field is. *Requires*: 256 or more.
    int atLeast = 1024;
    /// The estimate is good enough once chance moves its limits by less than this share of it.
    double within = 1.0 / 3.0;
    /// It is also good enough once its upper limit is at most this.
    double enough = 0.0;
    unsigned seed = 1; ///< the same seed draws the same frequencies
};

/// Measures the error of a picture. The error over a whole period is, by Parseval, a sum over the
/// frequencies of its slice:
///   error^2 = sum |P - P'|^2 / sum |P|^2,
/// with P' of the picture and P of the samples, each an exact sum, see `exactFrequencies`. The
/// frequencies within three steps of zero and the hundred brightest always count; the others are
/// drawn, half by the amplitude around them, half evenly, as the aliases of points are, and
/// weighted so that the sum is unbiased. Tiles order them, so that a pair from one stratum is close
/// together: kernels of different width make errors in patches. The interval is that of the spread
/// of these pairs. Everything that happened to the picture is in P': the spectrum, the kernels, the
/// transform, the graphics card. *Shape*: `period` is the whole period of the picture, in its
/// camera. For a part of the body, `relative` is what is expected if the error is spread evenly;
/// `low` and `high` allow it anywhere, so that `high` may be any number where a part shows little.
/// `refined` is called with each estimate but the last. *Throws* Cancelled within a transform of
/// the picture, Error{outOfMemory}.
StatedError spotCheck(const picture::PeriodPicture &period, const scene::ImageDefinition &image,
                      const ShownRows &rows, const CheckEffort &effort = {},
                      const task::Progress &progress = {},
                      const std::function<void(const StatedError &)> &refined = {});

} // namespace pellucid::error
