// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/error/shown_rows.h"
#include "core/task/progress.h"

namespace pellucid::error {

/// D(s) = dV sum_n f[n] exp(-i 2 pi s.(x_n - c)) of each image at given frequencies, by direct
/// summation over all samples, c the centre of the lattice. A multiplication and an addition a
/// sample and frequency; rows of zeros cost nothing. A row is summed in float and rows in double,
/// which leaves an error of some 1e-8 of D(0), the same on every instruction set to 1e-6 of the
/// largest value, and the same bits for any number of threads. *Shape*: [image][frequency].
/// *Units*: frequencies in cycles per mm, LPS. *Throws* Cancelled within a plane of samples,
/// Error{outOfMemory}.
std::vector<std::vector<std::complex<double>>>
exactFrequencies(const ShownRows &rows, std::span<const glm::dvec3> frequencies,
                 const task::Progress &progress = {});

} // namespace pellucid::error
