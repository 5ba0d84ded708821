// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/decoding/client/segmentation_file.h"
#include "core/task/progress.h"
#include "core/task/reason.h"
#include "core/volume/coverage.h"
#include "core/volume/volume.h"

namespace pellucid::segment {

/// A named part of a volume, such as an organ.
struct Segment {
    std::string name;
    std::optional<glm::dvec3> color; ///< sRGB, each 0..1, as the file recommends
    decoding::CodedConcept category, type;
    std::shared_ptr<const volume::Coverage> coverage; ///< on the volume's lattice; not null
    double volumeMm3 = 0.0;                           ///< the volume that it occupies
    /// Different for every segment that was loaded since the program started.
    std::uint64_t id = 0;
};

/// The segments of a file, on the lattice of a volume.
struct Segmentation {
    std::string title;
    std::filesystem::path path;    ///< the file
    std::vector<Segment> segments; ///< with different names; each has a sample of the volume
    std::vector<task::Reason> warnings;
};

/// Reads a DICOM segmentation, an RT structure set, or a volume of labels (NRRD, NIfTI, MetaImage)
/// and places its segments on a volume. Segments without a name are named after their code or
/// number. Says in a warning how far masks are from the volume's samples, which contours are
/// between its slices, that masks were resampled, and which segments are not in the volume.
/// *Throws* Error{unusable} naming the file, also if it belongs to another study or frame of
/// reference, or if nothing of it is in the volume; Error{outOfMemory}; Cancelled.
Segmentation loadSegmentation(const std::filesystem::path &path, const volume::Volume &volume,
                              const task::Progress &progress = {});

/// The names of the segments of a DICOM segmentation or an RT structure set, as `loadSegmentation`
/// gives them. *Throws* Error{unusable, outOfMemory}, Cancelled.
std::vector<std::string> segmentNames(const std::filesystem::path &path,
                                      const task::Progress &progress = {});

} // namespace pellucid::segment
