// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "core/dicom/instance.h"

namespace pellucid::dicom {

/// Reads a header without its pixels. *Throws* Error{unusable} with the reason.
InstanceHeader readHeader(const std::filesystem::path &path);

/// The one way from untrusted bytes to pixels: parses a whole file and decodes every frame of it.
/// No path, no global state beyond the codecs: it can run in a process of its own.
/// *Throws* Error{unusable, outOfMemory} with the reason.
DecodedImage decodeImage(std::span<const std::byte> file);

/// True if a file is a DICOMDIR by its content, whatever its name.
bool isDicomdir(const std::filesystem::path &path);

/// The files that a DICOMDIR lists, in its order, whether they exist or not.
/// *Throws* Error{unusable}.
std::vector<std::filesystem::path> readDicomdir(const std::filesystem::path &path);

/// Why a file's pixels cannot be part of a volume or an image set, or nothing if they can.
std::optional<std::string> whyUnusable(const InstanceHeader &header);

} // namespace pellucid::dicom
