// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include <glm/vec3.hpp>

#include "core/volume/lattice.h"

namespace pellucid::decoder {

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

/// What a NRRD, NIfTI or MetaImage file says before its samples.
struct VolumeLayout {
    /// In DICOM's space, whatever the file's is: a volume's lattice can be made of them.
    volume::GridSize size;
    int volumes = 1; ///< one after the other: a fourth axis
    glm::dvec3 originMm{0.0};
    std::array<glm::dvec3, 3> stepsMm{};
    StoredScalar scalar = StoredScalar::u8;
    /// value = slope * stored + intercept.
    double slope = 1.0, intercept = 0.0;
    bool isDeflated = false; ///< as gzip or zlib do
    bool isSwapped = false;  ///< not in this machine's byte order
    /// The header says how its space lies in the patient; else it is taken for DICOM's.
    bool isOfPatient = true;
    std::string dataFile; ///< as it stands there; empty: the samples are in the same file
    /// Where the samples begin, or what they are deflated to; and how much is to be skipped once it
    /// is inflated, as where the header is deflated with them.
    std::uint64_t at = 0, skip = 0;
};

/// Which samples of a file are wanted.
struct SampleRange {
    std::uint64_t bytes = 0; ///< of all samples
    std::int32_t bytesEach = 1;
    bool isDeflated = false, isSwapped = false;
    std::uint64_t at = 0, skip = 0; ///< as of `VolumeLayout`
};

} // namespace pellucid::decoder
