// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::volume {

enum class NrrdEncoding { raw, gzip };

/// Keys and values of a header that NRRD itself does not define. Line breaks become spaces.
using NrrdPairs = std::vector<std::pair<std::string, std::string>>;

/// Writes a volume in its stored type, attached, little endian, space left-posterior-superior.
/// The file appears only when complete. *Throws* Error{output}, Cancelled.
void writeNrrd(const std::filesystem::path &path, const Volume &volume,
               NrrdEncoding encoding = NrrdEncoding::raw, const task::Progress &progress = {},
               const NrrdPairs &pairs = {});

} // namespace pellucid::volume
