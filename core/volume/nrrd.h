// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::volume {

enum class NrrdEncoding { raw, gzip };

/// Writes a volume in its stored type, attached, little endian, space left-posterior-superior.
/// The file appears only when complete. *Throws* Error{output}, Cancelled.
void writeNrrd(const std::filesystem::path &path, const Volume &volume,
               NrrdEncoding encoding = NrrdEncoding::raw, const task::Progress &progress = {});

} // namespace pellucid::volume
