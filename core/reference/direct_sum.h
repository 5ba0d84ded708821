// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/reference/slice_image.h"
#include "core/volume/field.h"

namespace pellucid::reference {

/// The reference image: D(s) by direct summation over all samples in double precision, without
/// transform or kernel. The cost is samples times frequencies; meant for at most 96 samples a side.
/// *Shape*: the result is camera.height x camera.width, field times mm.
std::vector<double> directSumImage(const volume::Field &field, const scene::Camera &camera,
                                   const scene::ImageDefinition &image);

/// The same D(s) at given frequencies.
void directSum(const volume::Field &field, const std::vector<glm::dvec3> &frequencies,
               std::vector<std::complex<double>> &values);

} // namespace pellucid::reference
