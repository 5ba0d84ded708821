// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/decoding/client/reasons.h"
#include "core/decoding/process/reasons.h"
#include "core/decoding/process/volume_formats.h"
#include "core/dicom_text/attributes.h"
#include "core/files/reasons.h"
#include "core/system/text.h"
#include "core/task/error.h"

namespace pellucid::decoding::process {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

constexpr std::size_t maxHeaderBytes = 1 << 20; // larger ones are not headers
constexpr std::size_t maxQuotedLength = 60;     // of a field's text, in reasons

struct Header {
    std::map<std::string, std::string> fields;
    std::map<std::string, std::string> pairs; ///< of keys and values, which NRRD does not define
    std::size_t bytes = 0;                    ///< the samples follow
    bool hasEnd = false;
};

// Reads at most the largest header, in case the header or a line does not end.
Header readHeader(std::span<const std::byte> file) {
    std::string_view rest(reinterpret_cast<const char *>(file.data()),
                          std::min(file.size(), maxHeaderBytes));
    Header header;
    const auto nextLine = [&] {
        const auto end = rest.find('\n');
        const std::string_view line = rest.substr(0, end);
        const std::size_t taken = end == rest.npos ? rest.size() : end + 1;
        rest.remove_prefix(taken);
        header.bytes += taken;
        return line;
    };
    if (!nextLine().starts_with("NRRD000"))
        throw Error(ErrorCode::unusable, because::isNoNrrdFile);
    while (!header.hasEnd && !rest.empty()) {
        const std::string line = trimmed(nextLine());
        header.hasEnd = line.empty();
        if (header.hasEnd || line.front() == '#')
            continue;
        if (const auto pair = line.find(":="); pair != std::string::npos) {
            header.pairs.try_emplace(trimmed(line.substr(0, pair)), trimmed(line.substr(pair + 2)));
            continue;
        }
        const auto colon = line.find(':');
        if (colon == std::string::npos)
            throw Error(ErrorCode::unusable, because::nrrdLineWithoutColon);
        const std::string name = system::lowered(trimmed(line.substr(0, colon)));
        if (!header.fields.try_emplace(name, trimmed(line.substr(colon + 1))).second)
            throw Error(ErrorCode::unusable,
                        because::nrrdHasTwice(name.substr(0, maxQuotedLength)));
    }
    if (!header.hasEnd && file.size() > maxHeaderBytes)
        throw Error(ErrorCode::unusable, because::nrrdHasNoEnd);
    return header;
}

class Fields {
public:
    explicit Fields(const Header &header) : m_header(header) {}
    std::optional<std::string> find(std::initializer_list<const char *> names) const {
        for (const char *name : names)
            if (const auto it = m_header.fields.find(name); it != m_header.fields.end())
                return it->second;
        return std::nullopt;
    }
    std::string get(std::initializer_list<const char *> names) const {
        if (auto value = find(names))
            return *value;
        fail(because::nrrdHasNo(*names.begin()));
    }
    template <class T> std::vector<T> numbers(const std::string &text, std::size_t count) const {
        std::istringstream in(text);
        std::vector<T> values(count);
        for (T &value : values)
            if (!(in >> value))
                fail(because::nrrdNumbers(text.substr(0, maxQuotedLength)));
        return values;
    }
    [[noreturn]] void fail(const task::Reason &reason) const {
        throw Error(ErrorCode::unusable, reason);
    }

private:
    const Header &m_header;
};

std::optional<StoredScalar> scalarOf(const std::string &name) {
    static const std::map<std::string, StoredScalar> names = {
        {"signed char", StoredScalar::i8},
        {"int8", StoredScalar::i8},
        {"int8_t", StoredScalar::i8},
        {"uchar", StoredScalar::u8},
        {"unsigned char", StoredScalar::u8},
        {"uint8", StoredScalar::u8},
        {"uint8_t", StoredScalar::u8},
        {"short", StoredScalar::i16},
        {"short int", StoredScalar::i16},
        {"signed short", StoredScalar::i16},
        {"signed short int", StoredScalar::i16},
        {"int16", StoredScalar::i16},
        {"int16_t", StoredScalar::i16},
        {"ushort", StoredScalar::u16},
        {"unsigned short", StoredScalar::u16},
        {"unsigned short int", StoredScalar::u16},
        {"uint16", StoredScalar::u16},
        {"uint16_t", StoredScalar::u16},
        {"int", StoredScalar::i32},
        {"signed int", StoredScalar::i32},
        {"int32", StoredScalar::i32},
        {"int32_t", StoredScalar::i32},
        {"uint", StoredScalar::u32},
        {"unsigned int", StoredScalar::u32},
        {"uint32", StoredScalar::u32},
        {"uint32_t", StoredScalar::u32},
        {"longlong", StoredScalar::i64},
        {"long long", StoredScalar::i64},
        {"long long int", StoredScalar::i64},
        {"signed long long", StoredScalar::i64},
        {"signed long long int", StoredScalar::i64},
        {"int64", StoredScalar::i64},
        {"int64_t", StoredScalar::i64},
        {"ulonglong", StoredScalar::u64},
        {"unsigned long long", StoredScalar::u64},
        {"unsigned long long int", StoredScalar::u64},
        {"uint64", StoredScalar::u64},
        {"uint64_t", StoredScalar::u64},
        {"float", StoredScalar::f32},
        {"double", StoredScalar::f64}};
    const auto it = names.find(system::lowered(name));
    return it == names.end() ? std::nullopt : std::optional(it->second);
}

struct Space {
    glm::dvec3 toLps{1.0}; ///< signs
    bool hasPatientSpace = true;
};

Space spaceOf(const Fields &fields) {
    const auto space = fields.find({"space"});
    if (!space)
        return {glm::dvec3(1.0), false};
    const std::string name = system::lowered(*space);
    if (name == "left-posterior-superior" || name == "lps")
        return {};
    if (name == "right-anterior-superior" || name == "ras")
        return {{-1.0, -1.0, 1.0}};
    if (name == "left-anterior-superior" || name == "las")
        return {{1.0, -1.0, 1.0}};
    if (name == "scanner-xyz" || name == "3d-right-handed")
        return {glm::dvec3(1.0), false}; // scanner space, or no space
    fields.fail(because::nrrdSpace(space->substr(0, maxQuotedLength)));
}

std::vector<glm::dvec3> parseVectors(const Fields &fields, const std::string &text) {
    std::vector<glm::dvec3> vectors;
    for (std::size_t open = text.find('('); open != std::string::npos;
         open = text.find('(', open + 1)) {
        const std::size_t close = text.find(')', open);
        if (close == std::string::npos)
            fields.fail(because::nrrdVectorWithoutEnd(text.substr(0, maxQuotedLength)));
        std::string inside = text.substr(open + 1, close - open - 1);
        std::replace(inside.begin(), inside.end(), ',', ' ');
        const auto v = fields.numbers<double>(inside, 3);
        vectors.emplace_back(v[0], v[1], v[2]);
    }
    return vectors;
}

// Every spatial axis must be in "mm" or without a unit: micrometres or metres would be the wrong
// scale.
void requireMillimetres(const Fields &fields, task::Because<1> otherwise, std::string units) {
    std::replace(units.begin(), units.end(), '"', ' ');
    std::istringstream each(units);
    for (std::string unit; each >> unit;)
        if (const std::string lowered = system::lowered(unit);
            lowered != "mm" && lowered != "millimeter" && lowered != "millimeters" &&
            lowered != "millimetre" && lowered != "millimetres")
            fields.fail(otherwise(unit.substr(0, 20)));
}

void parseLattice(const Fields &fields, VolumeLayout &layout) {
    for (const auto &[name, otherwise] : {std::pair("space units", because::nrrdSpaceUnits),
                                          std::pair("units", because::nrrdUnits)})
        if (const auto units = fields.find({name}))
            requireMillimetres(fields, otherwise, *units);
    std::array<glm::dvec3, 3> steps{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};
    const Space space = spaceOf(fields);
    const glm::dvec3 sign = space.toLps;
    if (const auto directions = fields.find({"space directions"})) {
        const auto vectors = parseVectors(fields, *directions);
        if (vectors.size() != 3)
            fields.fail(because::nrrdDirections);
        for (int d = 0; d < 3; ++d)
            steps[d] = sign * vectors[d];
    } else if (const auto spacings = fields.find({"spacings"})) {
        const auto s = fields.numbers<double>(*spacings, 3);
        for (int d = 0; d < 3; ++d)
            steps[d] *= s[d];
    }
    glm::dvec3 origin(0.0);
    if (const auto text = fields.find({"space origin"})) {
        const auto vectors = parseVectors(fields, *text);
        if (vectors.size() != 1)
            fields.fail(because::nrrdOrigin);
        origin = sign * vectors[0];
    }
    layout.originMm = origin;
    layout.stepsMm = steps;
    layout.hasPatientSpace = space.hasPatientSpace;
    requireLattice(layout);
}

// The segments of a labelled volume, as 3D Slicer and dcmqi name them: Segment0_Name,
// Segment0_Color, Segment0_LabelValue, and so on. Incomplete ones and those with the label of
// another are left out.
std::vector<SegmentDescription> segmentsOf(const Header &header) {
    std::vector<SegmentDescription> segments;
    for (std::size_t n = 0; n < maxSegments; ++n) {
        const auto find = [&](const char *key) -> std::string {
            const auto it = header.pairs.find(fmt::format("Segment{}_{}", n, key));
            return it == header.pairs.end() ? std::string() : it->second;
        };
        if (find("Name").empty() && find("LabelValue").empty())
            break;
        const auto label = system::numberFrom(find("LabelValue"));
        const auto isTaken = [&](const auto &other) { return other.number == int(*label); };
        if (!label || !(*label >= 1.0 && *label <= 65535.0) ||
            std::any_of(segments.begin(), segments.end(), isTaken))
            continue;
        SegmentDescription segment;
        segment.number = int(*label);
        segment.label = dicom_text::oneLine(find("Name"));
        std::istringstream color(find("Color"));
        if (glm::dvec3 rgb{0.0}; color >> rgb.x >> rgb.y >> rgb.z)
            segment.color = glm::clamp(rgb, 0.0, 1.0);
        segments.push_back(std::move(segment));
    }
    return segments;
}

} // namespace

VolumeLayout parseNrrd(std::span<const std::byte> file) {
    const Header header = readHeader(file);
    const Fields fields(header);
    if (fields.numbers<int>(fields.get({"dimension"}), 1)[0] != 3)
        fields.fail(because::nrrdDimensions);
    VolumeLayout layout;
    const auto sizes = fields.numbers<long long>(fields.get({"sizes"}), 3);
    layout.size = gridSize({sizes[0], sizes[1], sizes[2]});
    const std::string typeName = fields.get({"type"});
    const auto scalar = scalarOf(typeName);
    if (!scalar)
        fields.fail(because::nrrdType(typeName.substr(0, maxQuotedLength)));
    layout.scalar = *scalar;
    const std::string encoding = system::lowered(fields.get({"encoding"}));
    layout.isDeflated = encoding == "gzip" || encoding == "gz";
    if (!layout.isDeflated && encoding != "raw")
        fields.fail(because::nrrdEncoding(encoding.substr(0, maxQuotedLength)));
    if (bytesOf(*scalar) > 1) {
        const std::string endian = system::lowered(fields.get({"endian"}));
        if (endian != "little" && endian != "big")
            fields.fail(because::nrrdEndian(endian.substr(0, maxQuotedLength)));
        layout.isSwapped = (endian == "big") == (std::endian::native == std::endian::little);
    }
    for (const auto *skip : {"byte skip", "byteskip", "line skip", "lineskip"})
        if (const auto value = fields.find({skip}); value && *value != "0")
            fields.fail(because::nrrdField(skip));
    if (const auto detached = fields.find({"data file", "datafile"})) {
        if (detached->empty())
            fields.fail(because::listsAFileOutside);
        layout.dataFile = *detached;
    } else if (!header.hasEnd) {
        fields.fail(because::isTruncated);
    }
    if (layout.dataFile.empty())
        layout.at = header.bytes;
    parseLattice(fields, layout);
    layout.segments = segmentsOf(header);
    return layout;
}

} // namespace pellucid::decoding::process
