// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "core/volume/field.h"

namespace pellucid::volume {

/// The values of a ramp of samples: the same bits with any instruction set.
void rampRow(const Ramp &ramp, const std::int16_t *from, int count, float *to);
void rampRow(const Ramp &ramp, const float *from, int count, float *to);

} // namespace pellucid::volume
