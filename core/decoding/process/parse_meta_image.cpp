// SPDX-License-Identifier: GPL-3.0-or-later
// MetaImage headers as ITK writes them: https://itk.org/Wiki/ITK/MetaIO/Documentation.
#include <bit>
#include <map>
#include <optional>
#include <sstream>
#include <vector>

#include "core/decoding/client/instance.h"
#include "core/decoding/client/reasons.h"
#include "core/decoding/process/reasons.h"
#include "core/decoding/process/volume_formats.h"
#include "core/system/text.h"
#include "core/task/error.h"

namespace pellucid::decoding::process {

namespace {

namespace because = task::because;

[[noreturn]] void fail(const task::Reason &reason) {
    throw task::Error(task::ErrorCode::unusable, reason);
}

// Fields by lower-case name; the samples follow the last field.
struct Header {
    std::map<std::string, std::string> fields;
    std::size_t bytes = 0;

    std::optional<std::string> find(std::initializer_list<const char *> names) const {
        for (const char *const name : names)
            if (const auto it = fields.find(name); it != fields.end())
                return it->second;
        return std::nullopt;
    }
    bool isTrue(std::initializer_list<const char *> names) const {
        return system::lowered(find(names).value_or("")) == "true";
    }
    template <class T>
    std::optional<std::vector<T>> numbers(std::initializer_list<const char *> names,
                                          std::size_t count) const {
        const auto text = find(names);
        if (!text)
            return std::nullopt;
        std::istringstream in(*text);
        std::vector<T> values(count);
        for (T &value : values)
            if (!(in >> value))
                fail(because::metaImageNumbers(text->substr(0, 60)));
        return values;
    }
};

Header readHeader(std::span<const std::byte> file) {
    constexpr std::size_t maxBytes = 1 << 20; // larger ones are not headers
    std::string_view rest(reinterpret_cast<const char *>(file.data()),
                          std::min(file.size(), maxBytes));
    Header header;
    while (!rest.empty()) {
        const auto end = rest.find('\n');
        const std::string line = trimmed(rest.substr(0, end));
        const std::size_t taken = end == rest.npos ? rest.size() : end + 1;
        rest.remove_prefix(taken);
        header.bytes += taken;
        if (line.empty())
            continue;
        const auto equals = line.find('=');
        if (equals == std::string::npos)
            fail(because::metaImageLineWithoutEquals);
        const std::string name = system::lowered(trimmed(line.substr(0, equals)));
        header.fields[name] = trimmed(line.substr(equals + 1));
        if (name == "elementdatafile") // always the last field
            return header;
    }
    fail(because::metaImageHasNo("ElementDataFile"));
}

StoredScalar scalarOf(const std::string &name) {
    static const std::map<std::string, StoredScalar> names = {
        {"MET_CHAR", StoredScalar::i8},       {"MET_UCHAR", StoredScalar::u8},
        {"MET_SHORT", StoredScalar::i16},     {"MET_USHORT", StoredScalar::u16},
        {"MET_INT", StoredScalar::i32},       {"MET_UINT", StoredScalar::u32},
        {"MET_LONG", StoredScalar::i32},      {"MET_ULONG", StoredScalar::u32},
        {"MET_LONG_LONG", StoredScalar::i64}, {"MET_ULONG_LONG", StoredScalar::u64},
        {"MET_FLOAT", StoredScalar::f32},     {"MET_DOUBLE", StoredScalar::f64}};
    const auto it = names.find(name);
    if (it == names.end())
        fail(because::metaImageType(name.substr(0, 60)));
    return it->second;
}

// Axes are listed one after the other; positions are DICOM's, whatever AnatomicalOrientation says
// (ITK).
void place(const Header &header, std::size_t dimensions, VolumeLayout &layout) {
    const std::size_t n = dimensions;
    const auto spacing = header.numbers<double>({"elementspacing", "elementsize"}, n)
                             .value_or(std::vector<double>(n, 1.0));
    const auto origin = header.numbers<double>({"offset", "position", "origin"}, n);
    const auto matrix =
        header.numbers<double>({"transformmatrix", "rotation", "orientation"}, n * n);
    layout.hasPatientSpace = origin.has_value() || matrix.has_value();
    for (std::size_t d = 0; d < 3; ++d)
        for (std::size_t along = 0; along < 3; ++along) {
            const double cosine = matrix ? (*matrix)[d * n + along] : d == along ? 1.0 : 0.0;
            layout.stepsMm[d][int(along)] = spacing[d] * cosine;
        }
    if (origin)
        layout.originMm = {(*origin)[0], (*origin)[1], (*origin)[2]};
}

} // namespace

VolumeLayout parseMetaImage(std::span<const std::byte> file) {
    const Header header = readHeader(file);
    const int dimensions = header.numbers<int>({"ndims"}, 1).value_or(std::vector<int>{0})[0];
    if (dimensions != 3 && dimensions != 4)
        fail(because::metaImageDimensions);
    const auto sizes = header.numbers<long long>({"dimsize"}, std::size_t(dimensions));
    if (!sizes)
        fail(because::metaImageHasNo("DimSize"));
    VolumeLayout layout;
    layout.size = gridSize({(*sizes)[0], (*sizes)[1], (*sizes)[2]});
    if (dimensions == 4) {
        if ((*sizes)[3] < 1 || (*sizes)[3] > maxVolumes)
            fail(because::holdsTooManyVolumes);
        layout.volumes = int((*sizes)[3]);
    }
    if (header.numbers<int>({"elementnumberofchannels"}, 1).value_or(std::vector<int>{1})[0] != 1)
        fail(because::holdsSeveralValues);
    if (header.find({"binarydata"}) && !header.isTrue({"binarydata"}))
        fail(because::metaImageText);
    layout.scalar = scalarOf(header.find({"elementtype"}).value_or(""));
    const bool isBig = header.isTrue({"binarydatabyteordermsb", "elementbyteordermsb"});
    layout.isSwapped =
        bytesOf(layout.scalar) > 1 && isBig == (std::endian::native == std::endian::little);
    layout.isDeflated = header.isTrue({"compresseddata"});
    const std::string where = header.find({"elementdatafile"}).value_or("");
    if (where.empty())
        fail(because::listsAFileOutside);
    if (where == "LIST" || where.find('%') != std::string::npos)
        fail(because::metaImageList);
    const bool isAttached = system::lowered(where) == "local";
    if (!isAttached)
        layout.dataFile = where;
    const long long headerSize =
        header.numbers<long long>({"headersize"}, 1).value_or(std::vector<long long>{0})[0];
    if (headerSize < 0)
        fail(because::metaImageHeaderSize);
    layout.at = isAttached ? header.bytes : std::uint64_t(headerSize);
    place(header, std::size_t(dimensions), layout);
    requireLattice(layout);
    return layout;
}

} // namespace pellucid::decoding::process
