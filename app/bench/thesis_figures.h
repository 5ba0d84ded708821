// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/bench/suites.h"

namespace pellucid::bench {

/// A phantom head in an exact cube, as in the thesis; the phantom's own lattice is not quite one.
Subject headInCube(const volume::GridSize &size);
/// The subject with the whole lattice as its support, as the thesis transforms it.
Subject whole(Subject subject);
/// The settings of the thesis: its grid, no padding, floats.
Measurement thesisMeasurement(const Subject &head, const char *kernel);

/// Reports a row for each of figures 4.2 to 4.8 of Cheng 2007 on a head of n^3 samples: the error
/// of the figure's filter, and its parts.
void measureFigures(const Report &report, int n);

} // namespace pellucid::bench
