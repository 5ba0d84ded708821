// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/dicom/instance.h"

class DcmDataset;

namespace pellucid::dicom {

/// The header of a loaded dataset. `fileBytes` bounds how many frames are believed: each takes a
/// byte at least.
InstanceHeader headerOf(DcmDataset &dataset, std::size_t fileBytes);

} // namespace pellucid::dicom
