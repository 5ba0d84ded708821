// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/decoder/instance.h"

class DcmDataset;

namespace pellucid::parse {

/// The header of a loaded dataset. `fileBytes` bounds how many frames are believed: each takes a
/// byte at least.
decoder::InstanceHeader headerOf(DcmDataset &dataset, std::size_t fileBytes);

} // namespace pellucid::parse
