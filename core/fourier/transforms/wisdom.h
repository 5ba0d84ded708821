// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace pellucid::fourier {

/// Sets the file that keeps FFTW's measured plans from run to run, and reads it. A file that is
/// missing, broken or written by a different FFTW is ignored, and replaced when the next plan is
/// measured. Before this call, and if the file cannot be written, plans are estimated.
void keepWisdomIn(const std::filesystem::path &file);

/// Plans are estimated from now on, and forgotten as far as they were measured: then every run on a
/// processor of the same kind gives the same bits.
void estimatePlans();

} // namespace pellucid::fourier
