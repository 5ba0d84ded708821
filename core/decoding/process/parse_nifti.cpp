// SPDX-License-Identifier: GPL-3.0-or-later
// NIfTI-1 and NIfTI-2 headers: https://nifti.nimh.nih.gov. Offsets are in bytes, for version 1 and
// version 2.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "core/decoding/client/instance.h"
#include "core/decoding/client/reasons.h"
#include "core/decoding/process/reasons.h"
#include "core/decoding/process/volume_formats.h"
#include "core/files/reasons.h"
#include "core/task/error.h"

namespace pellucid::decoding::process {

namespace {

namespace because = task::because;

[[noreturn]] void fail(const task::Reason &reason) {
    throw task::Error(task::ErrorCode::unusable, reason);
}

constexpr std::int32_t bytesOfVersion1 = 348, bytesOfVersion2 = 540;

std::int32_t swapped(std::int32_t value) {
    return std::int32_t(__builtin_bswap32(std::uint32_t(value)));
}

std::optional<std::int32_t> headerBytes(std::span<const std::byte> start) {
    std::int32_t bytes = 0;
    if (start.size() < sizeof(bytes))
        return std::nullopt;
    std::memcpy(&bytes, start.data(), sizeof(bytes));
    for (const std::int32_t known : {bytesOfVersion1, bytesOfVersion2})
        if (bytes == known || swapped(bytes) == known)
            return bytes;
    return std::nullopt;
}

// A header of either version and byte order.
class Header {
public:
    explicit Header(std::span<const std::byte> bytes) : m_bytes(bytes) {
        const auto size = headerBytes(bytes);
        if (!size)
            fail(because::isNoNiftiFile);
        isSwapped = *size != bytesOfVersion1 && *size != bytesOfVersion2;
        isVersion2 = (isSwapped ? swapped(*size) : *size) == bytesOfVersion2;
        if (bytes.size() < std::size_t(isVersion2 ? bytesOfVersion2 : bytesOfVersion1))
            fail(because::isTruncated);
    }

    // A number that is of type T1 in version 1 and of type T2 in version 2.
    template <class T1, class T2> double number(std::size_t at1, std::size_t at2) const {
        return isVersion2 ? double(read<T2>(at2)) : double(read<T1>(at1));
    }
    // The same for an element of an array.
    template <class T1, class T2>
    double number(std::size_t at1, std::size_t at2, std::size_t n) const {
        return number<T1, T2>(at1 + n * sizeof(T1), at2 + n * sizeof(T2));
    }

    bool isSwapped = false, isVersion2 = false;

private:
    template <class T> T read(std::size_t at) const {
        std::array<std::byte, sizeof(T)> raw{};
        std::memcpy(raw.data(), m_bytes.data() + at, sizeof(T));
        if (isSwapped)
            std::reverse(raw.begin(), raw.end());
        return std::bit_cast<T>(raw);
    }

    std::span<const std::byte> m_bytes;
};

StoredScalar scalarOf(int datatype) {
    switch (datatype) {
    case 2:
        return StoredScalar::u8;
    case 4:
        return StoredScalar::i16;
    case 8:
        return StoredScalar::i32;
    case 16:
        return StoredScalar::f32;
    case 64:
        return StoredScalar::f64;
    case 256:
        return StoredScalar::i8;
    case 512:
        return StoredScalar::u16;
    case 768:
        return StoredScalar::u32;
    case 1024:
        return StoredScalar::i64;
    case 1280:
        return StoredScalar::u64;
    case 128:
    case 2304:
        fail(because::holdsColors);
    default:
        fail(because::niftiType(datatype));
    }
}

// Voxels to patient space, which is right-anterior-superior.
struct Transform {
    std::array<glm::dvec3, 3> steps{};
    glm::dvec3 origin{0.0};

    bool spansVolume() const {
        const double volume = glm::determinant(glm::dmat3(steps[0], steps[1], steps[2]));
        const double edges = glm::length(steps[0]) * glm::length(steps[1]) * glm::length(steps[2]);
        return std::isfinite(volume) && std::abs(volume) > 1e-6 * edges && edges > 0.0;
    }
};

Transform affine(const Header &h) {
    Transform t;
    for (int row = 0; row < 3; ++row) {
        const auto at1 = std::size_t(280 + 16 * row), at2 = std::size_t(400 + 32 * row);
        for (int d = 0; d < 3; ++d)
            t.steps[std::size_t(d)][row] = h.number<float, double>(at1, at2, std::size_t(d));
        t.origin[row] = h.number<float, double>(at1, at2, 3);
    }
    return t;
}

Transform quaternion(const Header &h) {
    const double b = h.number<float, double>(256, 352), c = h.number<float, double>(260, 360),
                 d = h.number<float, double>(264, 368);
    const double a = std::sqrt(std::max(0.0, 1.0 - b * b - c * c - d * d));
    // The sign of pixdim[0] flips the third axis.
    const double flip = h.number<float, double>(76, 104) < 0.0 ? -1.0 : 1.0;
    const auto pixel = [&](std::size_t n) { return h.number<float, double>(76, 104, n); };
    Transform t;
    t.steps[0] = pixel(1) * glm::dvec3(a * a + b * b - c * c - d * d, 2 * b * c + 2 * a * d,
                                       2 * b * d - 2 * a * c);
    t.steps[1] = pixel(2) * glm::dvec3(2 * b * c - 2 * a * d, a * a + c * c - b * b - d * d,
                                       2 * c * d + 2 * a * b);
    t.steps[2] =
        flip * pixel(3) *
        glm::dvec3(2 * b * d + 2 * a * c, 2 * c * d - 2 * a * b, a * a + d * d - c * c - b * b);
    t.origin = {h.number<float, double>(268, 376), h.number<float, double>(272, 384),
                h.number<float, double>(276, 392)};
    return t;
}

// Uses the affine transform if there is one, else the rotation, else only the spacings.
void place(const Header &h, VolumeLayout &layout) {
    Transform t;
    layout.hasPatientSpace = true;
    const bool hasAffine = h.number<std::int16_t, std::int32_t>(254, 348) > 0,
               hasRotation = h.number<std::int16_t, std::int32_t>(252, 344) > 0;
    if (hasAffine)
        t = affine(h);
    if ((!hasAffine || !t.spansVolume()) && hasRotation)
        t = quaternion(h);
    if ((!hasAffine && !hasRotation) || !t.spansVolume()) {
        layout.hasPatientSpace = false;
        for (int d = 0; d < 3; ++d) {
            const double mm = std::abs(h.number<float, double>(76, 104, std::size_t(d) + 1));
            t.steps[std::size_t(d)] = glm::dvec3(0.0);
            t.steps[std::size_t(d)][d] = mm > 0.0 ? mm : 1.0;
        }
        t.origin = glm::dvec3(0.0);
    }
    constexpr int lengths = 7, metres = 1, micrometres = 3;
    const int unit = int(h.number<std::int8_t, std::int32_t>(123, 500)) & lengths;
    const double scale = unit == metres ? 1000.0 : unit == micrometres ? 1e-3 : 1.0;
    // From right and anterior to left and posterior.
    const glm::dvec3 toLps = layout.hasPatientSpace ? glm::dvec3(-1.0, -1.0, 1.0) : glm::dvec3(1.0);
    for (std::size_t d = 0; d < 3; ++d)
        layout.stepsMm[d] = scale * toLps * t.steps[d];
    layout.originMm = scale * toLps * t.origin;
}

} // namespace

bool looksLikeNifti(std::span<const std::byte> start) {
    return headerBytes(start).has_value();
}

VolumeLayout parseNifti(std::span<const std::byte> header, bool isDeflated) {
    const Header h(header);
    const auto size = [&](std::size_t n) {
        return h.number<std::int16_t, std::int64_t>(40, 16, n);
    };
    const double dimensions = size(0);
    if (!(dimensions >= 2.0 && dimensions <= 7.0))
        fail(because::niftiHasNoDimensions);
    VolumeLayout layout;
    layout.size = gridSize(
        {(long long)(size(1)), (long long)(size(2)), dimensions >= 3.0 ? (long long)(size(3)) : 1});
    // Time points follow each other; further axes are vectors and tensors.
    const double volumes = dimensions >= 4.0 ? std::max(1.0, size(4)) : 1.0;
    for (std::size_t n = 5; double(n) <= dimensions; ++n)
        if (size(n) > 1.0)
            fail(because::holdsSeveralValues);
    if (volumes > maxVolumes)
        fail(because::holdsTooManyVolumes);
    layout.volumes = int(volumes);
    layout.scalar = scalarOf(int(h.number<std::int16_t, std::int16_t>(70, 12)));
    layout.isSwapped = h.isSwapped && bytesOf(layout.scalar) > 1;
    layout.isDeflated = isDeflated;
    const double slope = h.number<float, double>(112, 176),
                 intercept = h.number<float, double>(116, 184);
    if (slope != 0.0 && std::isfinite(slope) &&
        std::isfinite(intercept)) { // a slope of 0 means none
        if (std::abs(slope) > largestRescale || std::abs(intercept) > largestRescale)
            fail(because::rescaleGivesNoValues);
        layout.slope = slope;
        layout.intercept = intercept;
    }
    const double offset = h.number<float, std::int64_t>(108, 168);
    constexpr double maxOffset = 1e12;
    const double least = h.isVersion2 ? bytesOfVersion2 + 4 : bytesOfVersion1 + 4;
    if (!(offset <= maxOffset))
        fail(because::niftiSaysNoPlace);
    const std::size_t magic = h.isVersion2 ? 4 : 344;
    if (header.size() > magic + 1 && header[magic] == std::byte('n') &&
        header[magic + 1] == std::byte('i'))
        fail(because::niftiSamplesElsewhere);
    // Some writers write 0 if the samples follow the header.
    (isDeflated ? layout.skip : layout.at) = std::uint64_t(std::max(offset, least));
    place(h, layout);
    requireLattice(layout);
    return layout;
}

} // namespace pellucid::decoding::process
