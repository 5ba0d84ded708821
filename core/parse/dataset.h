// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/decoder/instance.h"
#include "core/parse/load_file.h"

class DcmDataset;
class DcmItem;

namespace pellucid::parse {

/// Drops all values that the file does not hold to their end, or that are longer than any that is
/// read; not the pixels. DCMTK gives what is in memory already for the rest of such a value: of
/// another file, perhaps, and gigabytes of it.
void dropUnreadable(DcmItem &dataset);

/// The header of a loaded dataset; a mosaic is still one image. `fileBytes` bounds how many frames
/// are believed: each takes a byte at least.
decoder::InstanceHeader headerOf(DcmDataset &dataset, std::size_t fileBytes);
/// With what else the file says.
decoder::InstanceHeader headerOf(const LoadedFile &file, std::size_t fileBytes);

} // namespace pellucid::parse
