// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <map>
#include <new>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <zlib.h>

#include "core/decoder/instance.h"
#include "core/parse/parse.h"
#include "core/task/error.h"
#include "core/task/text.h"

namespace pellucid::parse {

namespace {

using decoder::NrrdScalar;
using task::Error;
using task::ErrorCode;

constexpr std::size_t maxHeaderBytes = 1 << 20; // larger ones are not headers

std::string trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r\n");
    if (first == text.npos)
        return {};
    return std::string(text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1));
}

struct Header {
    std::map<std::string, std::string> fields;
    std::size_t bytes = 0; ///< the samples follow
    bool hasEnd = false;
};

// Of a file without an end of the header, or of a line, no more is read than a header may have.
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
        throw Error(ErrorCode::unusable, "is not a NRRD file");
    while (!header.hasEnd && !rest.empty()) {
        const std::string line = trimmed(nextLine());
        header.hasEnd = line.empty();
        if (header.hasEnd || line.front() == '#' || line.find(":=") != std::string::npos)
            continue;
        const auto colon = line.find(':');
        if (colon == std::string::npos)
            throw Error(ErrorCode::unusable, "the NRRD header has a line without a colon");
        const std::string name = task::lowered(trimmed(line.substr(0, colon)));
        if (!header.fields.try_emplace(name, trimmed(line.substr(colon + 1))).second)
            throw Error(ErrorCode::unusable,
                        fmt::format("the NRRD header has '{}' twice", name.substr(0, 60)));
    }
    if (!header.hasEnd && file.size() > maxHeaderBytes)
        throw Error(ErrorCode::unusable, "the NRRD header has no end");
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
        fail(fmt::format("the NRRD header has no '{}'", *names.begin()));
    }
    template <class T> std::vector<T> numbers(const std::string &text, std::size_t count) const {
        std::istringstream in(text);
        std::vector<T> values(count);
        for (T &value : values)
            if (!(in >> value))
                fail("NRRD numbers expected: " + text.substr(0, 60));
        return values;
    }
    [[noreturn]] void fail(const std::string &reason) const {
        throw Error(ErrorCode::unusable, reason);
    }

private:
    const Header &m_header;
};

std::optional<NrrdScalar> scalarOf(const std::string &name) {
    static const std::map<std::string, NrrdScalar> names = {
        {"signed char", NrrdScalar::i8},
        {"int8", NrrdScalar::i8},
        {"int8_t", NrrdScalar::i8},
        {"uchar", NrrdScalar::u8},
        {"unsigned char", NrrdScalar::u8},
        {"uint8", NrrdScalar::u8},
        {"uint8_t", NrrdScalar::u8},
        {"short", NrrdScalar::i16},
        {"short int", NrrdScalar::i16},
        {"signed short", NrrdScalar::i16},
        {"signed short int", NrrdScalar::i16},
        {"int16", NrrdScalar::i16},
        {"int16_t", NrrdScalar::i16},
        {"ushort", NrrdScalar::u16},
        {"unsigned short", NrrdScalar::u16},
        {"unsigned short int", NrrdScalar::u16},
        {"uint16", NrrdScalar::u16},
        {"uint16_t", NrrdScalar::u16},
        {"int", NrrdScalar::i32},
        {"signed int", NrrdScalar::i32},
        {"int32", NrrdScalar::i32},
        {"int32_t", NrrdScalar::i32},
        {"uint", NrrdScalar::u32},
        {"unsigned int", NrrdScalar::u32},
        {"uint32", NrrdScalar::u32},
        {"uint32_t", NrrdScalar::u32},
        {"longlong", NrrdScalar::i64},
        {"long long", NrrdScalar::i64},
        {"long long int", NrrdScalar::i64},
        {"signed long long", NrrdScalar::i64},
        {"signed long long int", NrrdScalar::i64},
        {"int64", NrrdScalar::i64},
        {"int64_t", NrrdScalar::i64},
        {"ulonglong", NrrdScalar::u64},
        {"unsigned long long", NrrdScalar::u64},
        {"unsigned long long int", NrrdScalar::u64},
        {"uint64", NrrdScalar::u64},
        {"uint64_t", NrrdScalar::u64},
        {"float", NrrdScalar::f32},
        {"double", NrrdScalar::f64}};
    const auto it = names.find(task::lowered(name));
    return it == names.end() ? std::nullopt : std::optional(it->second);
}

struct Space {
    glm::dvec3 toLps{1.0}; ///< signs
    bool isOfPatient = true;
};

Space spaceOf(const Fields &fields) {
    const auto space = fields.find({"space"});
    if (!space)
        return {glm::dvec3(1.0), false};
    const std::string name = task::lowered(*space);
    if (name == "left-posterior-superior" || name == "lps")
        return {};
    if (name == "right-anterior-superior" || name == "ras")
        return {{-1.0, -1.0, 1.0}};
    if (name == "left-anterior-superior" || name == "las")
        return {{1.0, -1.0, 1.0}};
    if (name == "scanner-xyz" || name == "3d-right-handed")
        return {glm::dvec3(1.0), false}; // of the scanner, or of nothing
    fields.fail("NRRD space '" + *space + "' is not supported");
}

std::vector<glm::dvec3> parseVectors(const Fields &fields, const std::string &text) {
    std::vector<glm::dvec3> vectors;
    for (std::size_t open = text.find('('); open != std::string::npos;
         open = text.find('(', open + 1)) {
        const std::size_t close = text.find(')', open);
        if (close == std::string::npos)
            fields.fail("NRRD vector without an end: " + text.substr(0, 60));
        std::string inside = text.substr(open + 1, close - open - 1);
        std::replace(inside.begin(), inside.end(), ',', ' ');
        const auto v = fields.numbers<double>(inside, 3);
        vectors.emplace_back(v[0], v[1], v[2]);
    }
    return vectors;
}

// "mm" "mm" "mm", or nothing of an axis; micrometres or metres would be another patient.
void requireMillimetres(const Fields &fields, const std::string &name, std::string units) {
    std::replace(units.begin(), units.end(), '"', ' ');
    std::istringstream each(units);
    for (std::string unit; each >> unit;)
        if (const std::string lowered = task::lowered(unit);
            lowered != "mm" && lowered != "millimeter" && lowered != "millimeters" &&
            lowered != "millimetre" && lowered != "millimetres")
            fields.fail("NRRD " + name + " '" + unit.substr(0, 20) + "' are not supported");
}

void parseLattice(const Fields &fields, NrrdLayout &layout) {
    for (const char *const name : {"space units", "units"})
        if (const auto units = fields.find({name}))
            requireMillimetres(fields, name, *units);
    std::array<glm::dvec3, 3> steps{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};
    const Space space = spaceOf(fields);
    const glm::dvec3 sign = space.toLps;
    if (const auto directions = fields.find({"space directions"})) {
        const auto vectors = parseVectors(fields, *directions);
        if (vectors.size() != 3)
            fields.fail("three NRRD space directions expected");
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
            fields.fail("one NRRD space origin expected");
        origin = sign * vectors[0];
    }
    (void)volume::Lattice::make(layout.size, {origin}, steps); // which says what is wrong
    if (glm::length(origin) > decoder::farthestMm)
        fields.fail("the NRRD space origin is farther away than a kilometre");
    for (const glm::dvec3 &step : steps)
        if (glm::length(step) < decoder::smallestSpacingMm ||
            glm::length(step) > decoder::largestSpacingMm)
            fields.fail("the NRRD samples are closer than a nanometre or farther apart than ten "
                        "metres");
    layout.originMm = origin;
    layout.stepsMm = steps;
    layout.isOfPatient = space.isOfPatient;
}

constexpr std::size_t partBytes = 1 << 20;

void swapEach(std::span<std::byte> bytes, int bytesEach) {
    for (std::size_t at = 0; at < bytes.size(); at += std::size_t(bytesEach))
        std::reverse(bytes.begin() + std::ptrdiff_t(at),
                     bytes.begin() + std::ptrdiff_t(at) + bytesEach);
}

// One member of a gzip file after the other, as tools append them.
class Inflated {
public:
    explicit Inflated(std::span<const std::byte> deflated) : m_rest(deflated) {
        constexpr int largestWindow = 15, ofGzip = 16;
        if (inflateInit2(&m_stream, largestWindow + ofGzip) != Z_OK)
            throw std::bad_alloc();
    }
    ~Inflated() { inflateEnd(&m_stream); }
    Inflated(const Inflated &) = delete;
    Inflated &operator=(const Inflated &) = delete;

    void read(std::span<std::byte> out) {
        m_stream.next_out = reinterpret_cast<Bytef *>(out.data());
        m_stream.avail_out = uInt(out.size());
        while (m_stream.avail_out > 0)
            inflateMore();
    }

    // All that was wanted is there: what follows is read as far as the sum of a gzip member, which
    // tells whether its bytes are those that were deflated. True if there is more instead.
    bool goesOn() {
        std::byte beyond{};
        m_stream.next_out = reinterpret_cast<Bytef *>(&beyond);
        m_stream.avail_out = 1;
        while (!m_isAtEnd && m_stream.avail_out > 0)
            inflateMore();
        if (m_stream.avail_out == 0)
            return true;
        // Another member, or padding of whoever stored it.
        return m_stream.avail_in > 1 && m_stream.next_in[0] == 0x1F && m_stream.next_in[1] == 0x8B;
    }

private:
    static constexpr std::size_t largestInput = 1U << 30;

    void inflateMore() {
        if (m_isAtEnd)
            inflateReset(&m_stream);
        if (m_stream.avail_in == 0) {
            const auto next = m_rest.first(std::min(m_rest.size(), largestInput));
            m_stream.next_in = const_cast<Bytef *>(reinterpret_cast<const Bytef *>(next.data()));
            m_stream.avail_in = uInt(next.size());
            m_rest = m_rest.subspan(next.size());
        }
        const int status = inflate(&m_stream, Z_NO_FLUSH);
        if (status == Z_MEM_ERROR)
            throw std::bad_alloc();
        // Without any input left there is no progress, which is an error, too.
        if (status != Z_OK && status != Z_STREAM_END)
            throw Error(ErrorCode::unusable, "the compressed data are damaged or truncated");
        m_isAtEnd = status == Z_STREAM_END;
    }

    bool m_isAtEnd = false; ///< of a member
    std::span<const std::byte> m_rest;
    z_stream m_stream{};
};

} // namespace

NrrdLayout parseNrrd(std::span<const std::byte> file) {
    const Header header = readHeader(file);
    const Fields fields(header);
    if (fields.numbers<int>(fields.get({"dimension"}), 1)[0] != 3)
        fields.fail("only three-dimensional NRRD volumes are supported");
    const auto sizes = fields.numbers<long long>(fields.get({"sizes"}), 3);
    std::uint64_t count = 1;
    for (const long long n : sizes) {
        if (n < 1 || n > std::numeric_limits<int>::max() / 4)
            fields.fail("NRRD size out of range");
        // Divided, not multiplied: the product of three sizes may wrap.
        if (std::uint64_t(n) > std::uint64_t(volume::mostSamples) / count)
            fields.fail("the NRRD volume is too large");
        count *= std::uint64_t(n);
    }
    NrrdLayout layout;
    layout.size = {int(sizes[0]), int(sizes[1]), int(sizes[2])};
    const std::string typeName = fields.get({"type"});
    const auto scalar = scalarOf(typeName);
    if (!scalar)
        fields.fail("NRRD type '" + typeName + "' is not supported");
    layout.scalar = *scalar;
    const std::string encoding = task::lowered(fields.get({"encoding"}));
    layout.isGzip = encoding == "gzip" || encoding == "gz";
    if (!layout.isGzip && encoding != "raw")
        fields.fail("NRRD encoding '" + encoding + "' is not supported");
    if (decoder::bytesOf(*scalar) > 1) {
        const std::string endian = task::lowered(fields.get({"endian"}));
        if (endian != "little" && endian != "big")
            fields.fail("NRRD endian '" + endian + "' is not supported");
        layout.isSwapped = (endian == "big") == (std::endian::native == std::endian::little);
    }
    for (const auto *skip : {"byte skip", "byteskip", "line skip", "lineskip"})
        if (const auto value = fields.find({skip}); value && *value != "0")
            fields.fail(std::string("NRRD '") + skip + "' is not supported");
    if (const auto detached = fields.find({"data file", "datafile"})) {
        if (detached->empty())
            fields.fail("lists a file outside its folder");
        layout.dataFile = *detached;
    } else if (!header.hasEnd) {
        fields.fail("is truncated");
    }
    parseLattice(fields, layout);
    return layout;
}

void readNrrdSamples(std::span<const std::byte> file, const NrrdSamples &samples,
                     const std::function<void(std::span<const std::byte>, bool goesOn)> &take) {
    if (samples.bytesEach < 1 || samples.bytesEach > 8 ||
        partBytes % std::size_t(samples.bytesEach) != 0 ||
        samples.bytes % std::uint64_t(samples.bytesEach) != 0)
        throw Error(ErrorCode::usage, "is asked for in a way that the decoder does not know");
    auto stored = file.subspan(samples.isBehindHeader ? readHeader(file).bytes : 0);
    if (!samples.isGzip && stored.size() < samples.bytes)
        throw Error(ErrorCode::unusable, "is truncated");
    std::optional<Inflated> inflated;
    if (samples.isGzip)
        inflated.emplace(stored);
    std::vector<std::byte> buffer(partBytes);
    for (std::uint64_t done = 0; done < samples.bytes; done += buffer.size()) {
        buffer.resize(std::min<std::uint64_t>(partBytes, samples.bytes - done));
        if (inflated)
            inflated->read(buffer);
        else
            std::memcpy(buffer.data(), stored.data() + done, buffer.size());
        if (samples.isSwapped)
            swapEach(buffer, samples.bytesEach);
        const bool isLast = done + buffer.size() == samples.bytes;
        take(buffer, isLast && (inflated ? inflated->goesOn()
                                         : stored.size() >=
                                               samples.bytes + std::uint64_t(samples.bytesEach)));
    }
}

} // namespace pellucid::parse
