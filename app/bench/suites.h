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
/// Every kernel at every padding and storage on one field: error against time. 64^3 noise in a
/// sphere and a head; or the given volume.
void runKernelsSuite(const Report &report, const Subject *given);
/// The default quality from 128^3 to 512^3 beside the ray sum and the shear-warp sum, with the
/// exponents of their growth.
void runScalingSuite(const Report &report, const Subject *given);
/// The fields that break projectors, at four tolerances.
void runHardSuite(const Report &report);
/// Cheng 2007, tables 4.1 to 4.6.
void runThesisSuite(const Report &report);
/// Looks on 128^3 and 256^3: what weights, colours and control points cost in each of the three
/// uses of linearity.
void runClassesSuite(const Report &report);
/// Depth cues and lights at 128^3 and 256^3, in turns with the plain frame.
void runShadingSuite(const Report &report);
/// Cuts of 512^2 pixels through 512 x 512 x 256 samples, thin and as slabs, against the integral
/// and the extremes of what is between samples.
void runPlanesSuite(const Report &report);
/// The engine on the graphics card at 128^3 to 512^3 beside the processor's and a ray sum on the
/// same card. *Throws* Error{noSuchDevice}.
void runGpuSuite(const Report &report);
/// A search for fields and views whose error is larger than what was predicted, for so many
/// minutes; each that is worse than all before is a row.
void runSearchSuite(const Report &report, double minutes, std::uint64_t seed);
/// The error stated beside random pictures over the measured one: the least, the median, where 95 %
/// are below, the largest.
void runPicturesSuite(const Report &report, int pictures, std::uint64_t seed);
/// Totsuka and Levoy 1993, table 1, and their adaptive filter.
void runTotsukaSuite(const Report &report);

} // namespace pellucid::bench
