// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/decoding/process/load_file.h"
#include "core/decoding/process/parse.h"

namespace pellucid::decoding::process {

/// *Throws* Error{unusable} if the file ends within its pixels: DCMTK keeps the part that exists
/// and fills the rest.
void requireWholePixels(const LoadedFile &file, const InstanceHeader &header);

/// Decodes every frame of a loaded file's pixels. *Requires*: `whyUndecodable(header)` is empty.
/// *Throws* Error{unusable, outOfMemory}.
DecodedImage decodePixels(const LoadedFile &file, std::size_t fileBytes, InstanceHeader header);

} // namespace pellucid::decoding::process
