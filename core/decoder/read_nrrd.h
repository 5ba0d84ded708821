// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::decoder {

/// Reads a three-dimensional scalar NRRD: any scalar type, either endianness, raw or gzip, attached
/// or detached, any three directions; RAS and LAS are converted to LPS, a missing origin is 0.
/// 8 and 16 bits become int16 where every value fits, everything else float32.
/// *Throws* Error{unusable} naming the file and what it does not support, Error{outOfMemory},
/// Error{internal} if there is no decoder, Cancelled.
volume::Volume readNrrd(const std::filesystem::path &path, const task::Progress &progress = {});

/// What a NRRD says before its samples. *Throws* as readNrrd.
struct NrrdHeader {
    volume::Lattice lattice;
    volume::VolumeNotes notes;
    std::filesystem::path samplesFile; ///< the file itself, or another one that it names
};
NrrdHeader readNrrdHeader(const std::filesystem::path &path, const task::Progress &progress = {});

} // namespace pellucid::decoder
