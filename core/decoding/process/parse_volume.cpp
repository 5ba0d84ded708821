// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstring>
#include <limits>

#include <glm/geometric.hpp>

#include "core/decoding/client/instance.h"
#include "core/decoding/process/parse.h"
#include "core/decoding/process/reasons.h"
#include "core/decoding/process/volume_formats.h"
#include "core/task/error.h"

namespace pellucid::decoding::process {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

bool startsWith(std::span<const std::byte> file, std::string_view start) {
    return file.size() >= start.size() && std::memcmp(file.data(), start.data(), start.size()) == 0;
}

} // namespace

std::string trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r\n");
    if (first == text.npos)
        return {};
    return std::string(text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1));
}

volume::GridSize gridSize(const std::array<long long, 3> &sizes) {
    std::uint64_t count = 1;
    for (const long long n : sizes) {
        if (n < 1 || n > std::numeric_limits<int>::max() / 4)
            throw Error(ErrorCode::unusable, because::sizeOutOfRange);
        // Divided, not multiplied: the product of three sizes may wrap.
        if (std::uint64_t(n) > std::uint64_t(volume::maxSamples) / count)
            throw Error(ErrorCode::unusable, because::volumeTooLarge);
        count *= std::uint64_t(n);
    }
    return {int(sizes[0]), int(sizes[1]), int(sizes[2])};
}

void requireLattice(const VolumeLayout &layout) {
    // It throws the reason.
    (void)volume::Lattice::make(layout.size, {layout.originMm}, layout.stepsMm);
    if (glm::length(layout.originMm) > farthestMm)
        throw Error(ErrorCode::unusable, because::originTooFar);
    for (const glm::dvec3 &step : layout.stepsMm)
        if (glm::length(step) < smallestSpacingMm || glm::length(step) > largestSpacingMm)
            throw Error(ErrorCode::unusable, because::samplesTooCloseOrFar);
}

VolumeLayout parseVolumeLayout(std::span<const std::byte> file) {
    if (startsWith(file, "NRRD000"))
        return parseNrrd(file);
    if (startsWith(file, "\x1F\x8B")) {
        const auto start = inflatedStart(file, niftiHeaderBytes);
        if (looksLikeNifti(start))
            return parseNifti(start, true);
    } else if (looksLikeNifti(file)) {
        return parseNifti(file, false);
    } else if (startsWith(file, "ObjectType") || startsWith(file, "NDims") ||
               startsWith(file, "Comment")) {
        return parseMetaImage(file);
    }
    throw Error(ErrorCode::unusable, because::isNoVolumeFile);
}

} // namespace pellucid::decoding::process
