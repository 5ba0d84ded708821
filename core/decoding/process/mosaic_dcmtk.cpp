// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/process/mosaic.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include <glm/geometric.hpp>

#include "core/dicom_text/attributes.h"

namespace pellucid::decoding::process {

using namespace dicom_text;

namespace {

// Siemens' private header: named values, each a list of texts, little endian. Version 2 starts with
// "SV10"; in version 1 the lengths of values are relative to that of the first.
class CsaHeader {
public:
    explicit CsaHeader(std::span<const Uint8> bytes) : m_bytes(bytes) {}

    std::vector<double> numbers(std::string_view name) const {
        const bool isVersion2 = m_bytes.size() > 8 && std::memcmp(m_bytes.data(), "SV10", 4) == 0;
        std::size_t at = isVersion2 ? 8 : 0;
        const std::int64_t tags = integer(at);
        at += 8;
        constexpr std::int64_t maxTags = 1000, maxItems = 10000;
        std::int64_t counted = 0;
        for (std::int64_t tag = 0; tag < std::min(tags, maxTags) && at + 84 <= m_bytes.size();
             ++tag) {
            const auto *const text = reinterpret_cast<const char *>(m_bytes.data() + at);
            const std::string_view found(text, ::strnlen(text, 64));
            const std::int64_t items = integer(at + 76);
            at += 84;
            std::vector<double> values;
            for (std::int64_t item = 0; item < std::min(items, maxItems); ++item) {
                if (at + 16 > m_bytes.size())
                    return {};
                std::int64_t bytes = isVersion2 ? integer(at + 4) : integer(at);
                if (!isVersion2) {
                    if (tag == 0 && item == 0)
                        counted = bytes;
                    bytes -= counted;
                }
                at += 16;
                if (bytes < 0 || std::size_t(bytes) > m_bytes.size() - at)
                    return {};
                if (found == name && bytes > 0) {
                    const std::string value(reinterpret_cast<const char *>(m_bytes.data() + at),
                                            std::size_t(bytes));
                    values.push_back(std::strtod(value.c_str(), nullptr));
                }
                at += std::size_t(bytes + 3) / 4 * 4;
            }
            if (found == name)
                return values;
        }
        return {};
    }

private:
    std::int64_t integer(std::size_t at) const {
        std::int32_t value = 0;
        if (at + sizeof(value) <= m_bytes.size())
            std::memcpy(&value, m_bytes.data() + at, sizeof(value));
        return value;
    }

    std::span<const Uint8> m_bytes;
};

CsaHeader csaHeaderOf(DcmItem &dataset) {
    const Uint8 *data = nullptr;
    unsigned long count = 0;
    if (dataset.findAndGetUint8Array(DcmTagKey(0x0029, 0x1010), data, &count).bad() ||
        data == nullptr)
        return CsaHeader({});
    return CsaHeader({data, count});
}

constexpr int largestSide = 100;

bool fits(const Mosaic &mosaic, const InstanceHeader &header) {
    return mosaic.slices >= 1 && mosaic.side >= 1 && mosaic.side <= largestSide &&
           header.rows >= mosaic.side && header.columns >= mosaic.side &&
           header.rows % mosaic.side == 0 && header.columns % mosaic.side == 0;
}

glm::dvec3 normalOf(const CsaHeader &csa, const FrameHeader &frame) {
    glm::dvec3 normal(0.0);
    if (const auto n = csa.numbers("SliceNormalVector"); n.size() == 3)
        normal = {n[0], n[1], n[2]};
    else if (frame.rowAxis && frame.columnAxis)
        normal = glm::cross(*frame.rowAxis, *frame.columnAxis);
    const double length = glm::length(normal);
    return std::abs(length - 1.0) < 0.05 ? normal / length : glm::dvec3(0.0);
}

// Rows and columns of the acquired matrix, which is that of a tile: the two of Acquisition Matrix
// that are not 0, or Siemens' text, such as "80*80" or "64p*64".
std::optional<std::pair<int, int>> acquiredMatrix(DcmItem &dataset) {
    std::vector<double> sizes = readNumbers(&dataset, DCM_AcquisitionMatrix, 4);
    std::erase(sizes, 0.0);
    if (sizes.size() != 2) {
        sizes.clear();
        const std::string text = readText(&dataset, DcmTagKey(0x0051, 0x100B));
        const std::size_t star = text.find('*');
        if (star == std::string::npos)
            return std::nullopt;
        sizes = {std::strtod(text.c_str(), nullptr), std::strtod(text.c_str() + star + 1, nullptr)};
    }
    if (!(std::min(sizes[0], sizes[1]) >= 1.0 && std::max(sizes[0], sizes[1]) <= 65535.0))
        return std::nullopt;
    return std::pair(int(sizes[0]), int(sizes[1]));
}

} // namespace

bool isMosaic(const InstanceHeader &header) {
    return header.frames.size() == 1 &&
           header.frames[0].imageType().find("MOSAIC") != std::string::npos;
}

std::optional<Mosaic> mosaicOf(DcmItem &dataset, const InstanceHeader &header) {
    if (!isMosaic(header))
        return std::nullopt;
    const CsaHeader csa = csaHeaderOf(dataset);
    Mosaic mosaic;
    Uint16 count = 0;
    if (dataset.findAndGetUint16(DcmTagKey(0x0019, 0x100A), count).good())
        mosaic.slices = count;
    else if (const auto numbers = csa.numbers("NumberOfImagesInMosaic"); !numbers.empty())
        mosaic.slices = int(std::clamp(numbers[0], 0.0, 65535.0));
    mosaic.side = int(std::ceil(std::sqrt(double(mosaic.slices))));
    if (!fits(mosaic, header))
        return std::nullopt;
    mosaic.normal = normalOf(csa, header.frames[0]);
    return mosaic;
}

std::optional<Mosaic> guessedMosaic(DcmItem &dataset, const InstanceHeader &header,
                                    std::span<const std::uint16_t> image) {
    const auto matrix = acquiredMatrix(dataset);
    if (!isMosaic(header) || !matrix)
        return std::nullopt;
    // A partial Fourier scan acquires fewer rows than a tile has: the larger size is that of both.
    const int size = std::max(matrix->first, matrix->second);
    Mosaic mosaic;
    mosaic.side = header.columns / size;
    mosaic.slices = mosaic.side * mosaic.side;
    // A tile may be interpolated: then it has more pixels than were acquired.
    const auto diameter = readNumber(&dataset, DCM_ReconstructionDiameter);
    const auto &spacing = header.frames[0].spacingMm;
    const bool isOtherSize =
        diameter && spacing && std::abs(size * spacing->x - *diameter) > 0.05 * *diameter;
    if (mosaic.side < 2 || header.columns % size != 0 || isOtherSize || !fits(mosaic, header))
        return std::nullopt;
    mosaic.normal = normalOf(csaHeaderOf(dataset), header.frames[0]);
    const int rows = header.rows / mosaic.side, columns = header.columns / mosaic.side;
    const auto isEmpty = [&](int tile) {
        for (int row = 0; row < rows; ++row) {
            const auto begin =
                image.begin() +
                std::ptrdiff_t(std::size_t(tile / mosaic.side * rows + row) *
                                   std::size_t(header.columns) +
                               std::size_t(tile % mosaic.side) * std::size_t(columns));
            if (std::any_of(begin, begin + columns, [](std::uint16_t v) { return v != 0; }))
                return false;
        }
        return true;
    };
    while (!image.empty() && mosaic.slices > 1 && isEmpty(mosaic.slices - 1))
        --mosaic.slices;
    return mosaic;
}

void splitTiles(InstanceHeader &header, const Mosaic &mosaic) {
    const int rows = header.rows / mosaic.side, columns = header.columns / mosaic.side;
    FrameHeader first = header.frames[0];
    if (first.positionMm && first.rowAxis && first.columnAxis && first.spacingMm)
        *first.positionMm +=
            *first.rowAxis * (first.spacingMm->x * 0.5 * (header.columns - columns)) +
            *first.columnAxis * (first.spacingMm->y * 0.5 * (header.rows - rows));
    if (mosaic.normal == glm::dvec3(0.0) || first.sliceThicknessMm <= 0.0)
        first.positionMm.reset();
    header.frames.assign(std::size_t(mosaic.slices), first);
    if (first.positionMm)
        for (int n = 0; n < mosaic.slices; ++n)
            *header.frames[std::size_t(n)].positionMm +=
                double(n) * first.sliceThicknessMm * mosaic.normal;
    header.mosaicSide = mosaic.side;
    header.declaredFrames = mosaic.slices;
    header.rows = rows;
    header.columns = columns;
}

std::vector<std::uint16_t> tilesOf(std::span<const std::uint16_t> image, const Mosaic &mosaic,
                                   int rows, int columns) {
    const std::size_t plane = std::size_t(rows) * std::size_t(columns),
                      width = std::size_t(columns) * std::size_t(mosaic.side);
    std::vector<std::uint16_t> tiles(plane * std::size_t(mosaic.slices));
    for (int n = 0; n < mosaic.slices; ++n)
        for (int row = 0; row < rows; ++row)
            std::copy_n(image.begin() +
                            std::ptrdiff_t(std::size_t(n / mosaic.side * rows + row) * width +
                                           std::size_t(n % mosaic.side) * std::size_t(columns)),
                        columns,
                        tiles.begin() + std::ptrdiff_t(std::size_t(n) * plane +
                                                       std::size_t(row) * std::size_t(columns)));
    return tiles;
}

} // namespace pellucid::decoding::process
