// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include <glm/vec3.hpp>

#include "core/volume/lattice.h"

namespace pellucid::decoder {

/// How a NRRD stores a sample.
enum class NrrdScalar : std::int32_t { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

constexpr std::size_t bytesOf(NrrdScalar scalar) {
    switch (scalar) {
    case NrrdScalar::i8:
    case NrrdScalar::u8:
        return 1;
    case NrrdScalar::i16:
    case NrrdScalar::u16:
        return 2;
    case NrrdScalar::i32:
    case NrrdScalar::u32:
    case NrrdScalar::f32:
        return 4;
    default:
        return 8;
    }
}

/// What a NRRD says before its samples.
struct NrrdLayout {
    /// In DICOM's space, whatever the file's is: a volume's lattice can be made of them.
    volume::GridSize size;
    glm::dvec3 originMm{0.0};
    std::array<glm::dvec3, 3> stepsMm{};
    NrrdScalar scalar = NrrdScalar::u8;
    bool isGzip = false;
    bool isSwapped = false; ///< not in this machine's byte order
    /// The header says how its space lies in the patient; else it is taken for DICOM's.
    bool isOfPatient = true;
    std::string dataFile; ///< as it stands there; empty: the samples follow in the same file
};

/// Which samples of a file are wanted.
struct NrrdSamples {
    std::uint64_t bytes = 0; ///< of all samples
    std::int32_t bytesEach = 1;
    bool isGzip = false, isSwapped = false;
    bool isBehindHeader = false; ///< of a NRRD; else they are the whole file
};

} // namespace pellucid::decoder
