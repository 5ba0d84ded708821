// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::volume {

/// Reads a three-dimensional scalar NRRD: any scalar type, either endianness, raw or gzip, attached
/// or detached, any three directions; RAS and LAS are converted to LPS, a missing origin is 0.
/// 8 and 16 bits become int16 where every value fits, everything else float32.
/// *Throws* Error{unusable} naming the file and what it does not support.
Volume readNrrd(const std::filesystem::path &path, const task::Progress &progress = {});

/// What a NRRD says before its samples. *Throws* as readNrrd.
struct NrrdHeader {
    Lattice lattice;
    VolumeNotes notes;
    std::filesystem::path samplesFile; ///< the file itself, or another one that it names
};
NrrdHeader readNrrdHeader(const std::filesystem::path &path);

/// True if a path looks like a NRRD header (.nrrd, .nhdr).
bool isNrrdPath(const std::filesystem::path &path);

enum class NrrdEncoding { raw, gzip };

/// Writes a volume in its stored type, attached, little endian, space left-posterior-superior.
/// The file appears only when complete. *Throws* Error{output}, Cancelled.
void writeNrrd(const std::filesystem::path &path, const Volume &volume,
               NrrdEncoding encoding = NrrdEncoding::raw, const task::Progress &progress = {});

} // namespace pellucid::volume
