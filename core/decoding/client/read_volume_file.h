// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "core/decoding/client/segmentation_file.h"
#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::decoding {

/// Reads a volume of a NRRD, NIfTI or MetaImage file: any scalar type, either endianness, raw or
/// deflated, attached or detached, any three directions. Other spaces are converted to LPS; a
/// missing origin is 0. `volume`: the index if the file has several. 8 and 16 bits become int16 if
/// every value fits; everything else becomes float32. *Throws* Error{unusable} naming the file and
/// the unsupported feature, also for values that float32 cannot distinguish; Error{outOfMemory};
/// Error{internal} if there is no decoder; Cancelled.
volume::Volume readVolumeFile(const std::filesystem::path &path,
                              const task::Progress &progress = {}, int volume = 0);

/// The header of such a file. *Throws* as readVolumeFile.
struct VolumeFileHeader {
    volume::Lattice lattice;
    int volumes = 1; ///< stored one after the other
    volume::VolumeNotes notes;
    std::vector<SegmentDescription> segments; ///< that it names; the number of each is its label
    std::filesystem::path samplesFile;        ///< the file itself, or the file that it names
};
/// *Throws* Error{unusable}, also if the file is too short for the samples of the first volume.
VolumeFileHeader readVolumeFileHeader(const std::filesystem::path &path,
                                      const task::Progress &progress = {});

} // namespace pellucid::decoding
