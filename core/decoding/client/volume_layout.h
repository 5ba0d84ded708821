// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/decoding/client/segmentation_file.h"
#include "core/volume/lattice.h"

namespace pellucid::decoding {

/// How a file stores a sample.
enum class StoredScalar : std::int32_t { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

constexpr std::size_t bytesOf(StoredScalar scalar) {
    switch (scalar) {
    case StoredScalar::i8:
    case StoredScalar::u8:
        return 1;
    case StoredScalar::i16:
    case StoredScalar::u16:
        return 2;
    case StoredScalar::i32:
    case StoredScalar::u32:
    case StoredScalar::f32:
        return 4;
    default:
        return 8;
    }
}

/// The header of a NRRD, NIfTI or MetaImage file.
struct VolumeLayout {
    /// In DICOM's space, whatever the file's is; valid for a volume's lattice.
    volume::GridSize size;
    int volumes = 1; ///< stored one after the other: a fourth axis
    glm::dvec3 originMm{0.0};
    std::array<glm::dvec3, 3> stepsMm{};
    StoredScalar scalar = StoredScalar::u8;
    /// value = slope * stored + intercept.
    double slope = 1.0, intercept = 0.0;
    bool isDeflated = false; ///< by gzip or zlib
    bool isSwapped = false;  ///< not in this machine's byte order
    /// Whether the header gives the orientation of its space; otherwise DICOM's is assumed.
    bool hasPatientSpace = true;
    /// Segments that the header names; the number of each is its label.
    std::vector<SegmentDescription> segments;
    std::string dataFile; ///< as written in the header; empty: the samples are in the same file
    /// The offset of the samples or of their deflated data, and the number of bytes to skip after
    /// inflating, for example a header that is deflated with them.
    std::uint64_t at = 0, skip = 0;
};

/// The requested samples of a file.
struct SampleRange {
    std::uint64_t bytes = 0; ///< of all samples
    std::int32_t bytesEach = 1;
    bool isDeflated = false, isSwapped = false;
    std::uint64_t at = 0, skip = 0; ///< as in `VolumeLayout`
};

} // namespace pellucid::decoding
