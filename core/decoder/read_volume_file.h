// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::decoder {

/// Reads a volume of a NRRD, NIfTI or MetaImage file: any scalar type, either endianness, raw or
/// deflated, attached or detached, any three directions; other spaces are converted to LPS, a
/// missing origin is 0. `volume`: which of several. 8 and 16 bits become int16 where every value
/// fits, everything else float32.
/// *Throws* Error{unusable} naming the file and what it does not support, also values that float32
/// cannot tell apart, Error{outOfMemory}, Error{internal} if there is no decoder, Cancelled.
volume::Volume readVolumeFile(const std::filesystem::path &path,
                              const task::Progress &progress = {}, int volume = 0);

/// What such a file says before its samples. *Throws* as readVolumeFile.
struct VolumeFileHeader {
    volume::Lattice lattice;
    int volumes = 1; ///< one after the other
    volume::VolumeNotes notes;
    std::filesystem::path samplesFile; ///< the file itself, or another one that it names
};
/// *Throws* Error{unusable}, also where the samples of the first volume cannot all be there.
VolumeFileHeader readVolumeFileHeader(const std::filesystem::path &path,
                                      const task::Progress &progress = {});

} // namespace pellucid::decoder
