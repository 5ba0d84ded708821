// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace pellucid::gpu {

/// The text of a file, by its path below shaders/. *Throws* Error{internal} if there is no such
/// file.
const std::string &shaderSource(const std::string &name);

} // namespace pellucid::gpu
