// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace pellucid::fourier {

/// Where FFTW's measured plans are kept from run to run. Reads the file at once; one that is
/// missing, broken or of another FFTW is ignored and replaced by the next plan that is measured. If
/// it cannot be written, and until this is called, plans are estimated.
void keepWisdomIn(const std::filesystem::path &file);

} // namespace pellucid::fourier
