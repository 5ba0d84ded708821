// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "core/render/frame_inputs.h"

namespace pellucid::accuracy {

/// The energy that narrower kernels add to the error of a picture, by channel: estimated from a
/// sample of the frequencies that they read or leave out, each compared with the widest kernel,
/// plus twice the standard error of the sample. Half of the sample is in proportion to the errors
/// by which the widths were chosen, so that a few bright lines are not missed; half is spread
/// evenly. The same picture always has the same sample. All are 0 if one width reads everything.
/// *Units*: of the picture squared, times mm^2, over the whole period of the slice, whatever the
/// picture shows of it.
std::array<double, 3> narrowingEnergies(const render::EngineSpectra &spectra,
                                        const render::FrameInputs &inputs,
                                        const scene::Camera &camera,
                                        const scene::ImageDefinition &image);

} // namespace pellucid::accuracy
