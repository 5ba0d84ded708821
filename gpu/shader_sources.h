// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace pellucid::gpu {

/// The text of a file below shaders/, by its path there. *Throws* Error{internal} if there is none.
const std::string &shaderSource(const std::string &name);

} // namespace pellucid::gpu
