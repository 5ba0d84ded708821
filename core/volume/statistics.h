// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/volume/volume.h"

namespace pellucid::volume {

/// Moments of the finite samples. All zero if there are none.
struct Statistics {
    double minimum = 0.0, maximum = 0.0, mean = 0.0, standardDeviation = 0.0;
    std::uint64_t finiteCount = 0;
};

/// Counts of finite samples in equal bins over [low, high]; samples outside count in the end bins.
struct Histogram {
    double low = 0.0, high = 1.0;
    std::vector<std::uint64_t> counts;
};

Statistics statistics(const Volume &volume);

/// *Shape*: `bins` counts over the range of the finite samples.
Histogram histogram(const Volume &volume, int bins);

/// Quantiles of the finite samples, interpolated linearly between neighbouring ranks
/// (rank = fraction (count - 1)). Exact: no binning. All zero if no sample is finite.
std::vector<double> quantiles(const Volume &volume, const std::vector<double> &fractions);

} // namespace pellucid::volume
