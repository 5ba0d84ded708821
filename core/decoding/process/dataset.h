// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/decoding/client/instance.h"
#include "core/decoding/process/load_file.h"

class DcmDataset;
class DcmItem;

namespace pellucid::decoding::process {

/// Drops all values, except the pixels, that the file truncates or that are longer than any that is
/// read. DCMTK would fill the rest of a truncated value with old memory contents: perhaps of
/// another file, perhaps gigabytes.
void dropUnreadable(DcmItem &dataset);

/// The header of a loaded dataset; a mosaic is still one image. `fileBytes` limits the number of
/// frames: each takes at least one byte.
InstanceHeader headerOf(DcmDataset &dataset, std::size_t fileBytes);
/// The same, with the rest of the file's information.
InstanceHeader headerOf(const LoadedFile &file, std::size_t fileBytes);

} // namespace pellucid::decoding::process
