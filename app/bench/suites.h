// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/bench/measure.h"

namespace pellucid::bench {

/// Takes each row as soon as it is measured.
using Report = std::function<void(const Row &)>;

/// Phantoms and noise at 64^3 to 256^3 in the default quality: seconds to run.
void runQuickSuite(const Report &report);
/// Every kernel at every padding and storage: error against time, on a noise sphere, a head and a
/// chest of 64^3 samples, or on the given volume.
void runKernelsSuite(const Report &report, const Subject *given);
/// The default quality from 128^3 to 512^3 compared with the ray sum and the shear-warp sum, and
/// the exponents of their growth.
void runScalingSuite(const Report &report, const Subject *given);
/// Fields that break projectors, at four tolerances.
void runHardSuite(const Report &report);
/// Cheng 2007, tables 4.1 to 4.6.
void runThesisSuite(const Report &report);
/// Looks on 128^3 and 256^3: the cost of weights, colors and control points in each of the three
/// uses of linearity, see reportLook.
void runClassesSuite(const Report &report);
/// Depth cues and lights at 128^3 and 256^3, alternating with the plain frame.
void runShadingSuite(const Report &report);
/// Cuts of 512^2 pixels through 512 x 512 x 256 samples, thin and as slabs, against the exact mean
/// and maximum of the interpolated volume.
void runPlanesSuite(const Report &report);
/// Frames that fit panes of 600 x 760 to 1800 x 2000 pixels: plain, in two colors, with a light.
void runPanesSuite(const Report &report);
/// How much contrast processing adds to frames of 1800 x 2000 pixels, alternating with plain
/// display.
void runRadiographSuite(const Report &report);
/// The exact sums from which the error of a picture is measured, at 256^3 to 512 x 512 x 800: their
/// time, and their error relative to the sum of all samples.
void runCheckSuite(const Report &report);
/// The engine on the graphics card at 128^3 to 512^3 compared with the processor's and with a ray
/// sum on the same card. *Throws* Error{noSuchDevice}.
void runGpuSuite(const Report &report);
/// Searches for `minutes` for fields and views whose error exceeds the prediction. Each one that is
/// worse than all before is a row.
void runSearchSuite(const Report &report, double minutes, std::uint64_t seed);
/// The predicted error of random pictures divided by the measured error: minimum, median, 95th
/// percentile and maximum.
void runPicturesSuite(const Report &report, int pictures, std::uint64_t seed);
/// Checks whether plans keep five tolerances for random fields of every kind in six views, and
/// reports the stated errors divided by the measured ones.
void runSweepSuite(const Report &report, int fields, std::uint64_t seed);
/// Totsuka and Levoy 1993, table 1, and their adaptive filter.
void runTotsukaSuite(const Report &report);

} // namespace pellucid::bench
