// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <unistd.h>

#include <fmt/format.h>
#include <zlib.h>

#include "core/files/descriptor.h"
#include "core/task/error.h"
#include "core/task/memory.h"
#include "core/volume/nrrd.h"

namespace pellucid::volume {

namespace {

namespace fs = std::filesystem;
using task::Error;
using task::ErrorCode;

// Larger headers are not headers; larger volumes do not fit any machine this runs on.
constexpr std::size_t maxHeaderBytes = 1 << 20;
constexpr std::uint64_t maxSamples = 1ULL << 36;

struct Header {
    std::map<std::string, std::string> fields;
    std::uint64_t dataOffset = 0;
};

std::string trimmed(const std::string &text) {
    const auto first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos)
        return {};
    return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return text;
}

using File = std::unique_ptr<std::FILE, int (*)(std::FILE *)>;

File openFile(const fs::path &path) {
    files::Descriptor file = files::openRegular(path);
    File stream(::fdopen(file.get(), "rb"), &std::fclose);
    if (!stream)
        throw Error(ErrorCode::unusable, std::strerror(errno), path);
    file.release(); // the stream's
    return stream;
}

Header readHeader(const fs::path &path) {
    const auto in = openFile(path);
    // One that has no line end is not read to its own.
    std::string text(maxHeaderBytes, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), in.get()));
    const bool isWhole = text.size() < maxHeaderBytes;
    Header header;
    std::istringstream lines(text);
    std::string line;
    if (!std::getline(lines, line) || line.rfind("NRRD000", 0) != 0)
        throw Error(ErrorCode::unusable, "is not a NRRD file", path);
    bool hasEnd = false;
    while (!hasEnd && std::getline(lines, line)) {
        line = trimmed(line);
        hasEnd = line.empty();
        if (hasEnd || line.front() == '#' || line.find(":=") != std::string::npos)
            continue;
        const auto colon = line.find(':');
        if (colon == std::string::npos)
            throw Error(ErrorCode::unusable, "the NRRD header has a line without a colon", path);
        header.fields[lower(trimmed(line.substr(0, colon)))] = trimmed(line.substr(colon + 1));
    }
    if (!hasEnd && !isWhole)
        throw Error(ErrorCode::unusable, "the NRRD header has no end", path);
    header.dataOffset = lines ? std::uint64_t(lines.tellg()) : 0;
    return header;
}

// Of a file beside the header or below: one that names others is after something else.
fs::path detachedData(const fs::path &header, const std::string &name) {
    const fs::path relative = fs::path(name).lexically_normal();
    if (name.find('\0') != std::string::npos || relative.is_absolute() || relative.empty() ||
        *relative.begin() == "..")
        throw Error(ErrorCode::unusable, "lists a file outside its folder", header);
    const fs::path data = header.parent_path() / relative;
    // A link leads elsewhere, too.
    std::error_code unknown;
    const fs::path folder = fs::weakly_canonical(
        header.parent_path().empty() ? fs::path(".") : header.parent_path(), unknown);
    const fs::path meant = fs::weakly_canonical(data, unknown).lexically_relative(folder);
    if (unknown || meant.empty() || *meant.begin() == "..")
        throw Error(ErrorCode::unusable, "lists a file outside its folder", header);
    return data;
}

class Fields {
public:
    Fields(const Header &header, const fs::path &path) : m_header(header), m_path(path) {}
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
        throw Error(ErrorCode::unusable, reason, m_path);
    }

private:
    const Header &m_header;
    const fs::path &m_path;
};

enum class Scalar { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

std::optional<Scalar> scalarOf(const std::string &name) {
    static const std::map<std::string, Scalar> names = {{"signed char", Scalar::i8},
                                                        {"int8", Scalar::i8},
                                                        {"int8_t", Scalar::i8},
                                                        {"uchar", Scalar::u8},
                                                        {"unsigned char", Scalar::u8},
                                                        {"uint8", Scalar::u8},
                                                        {"uint8_t", Scalar::u8},
                                                        {"short", Scalar::i16},
                                                        {"short int", Scalar::i16},
                                                        {"signed short", Scalar::i16},
                                                        {"signed short int", Scalar::i16},
                                                        {"int16", Scalar::i16},
                                                        {"int16_t", Scalar::i16},
                                                        {"ushort", Scalar::u16},
                                                        {"unsigned short", Scalar::u16},
                                                        {"unsigned short int", Scalar::u16},
                                                        {"uint16", Scalar::u16},
                                                        {"uint16_t", Scalar::u16},
                                                        {"int", Scalar::i32},
                                                        {"signed int", Scalar::i32},
                                                        {"int32", Scalar::i32},
                                                        {"int32_t", Scalar::i32},
                                                        {"uint", Scalar::u32},
                                                        {"unsigned int", Scalar::u32},
                                                        {"uint32", Scalar::u32},
                                                        {"uint32_t", Scalar::u32},
                                                        {"longlong", Scalar::i64},
                                                        {"long long", Scalar::i64},
                                                        {"long long int", Scalar::i64},
                                                        {"signed long long", Scalar::i64},
                                                        {"signed long long int", Scalar::i64},
                                                        {"int64", Scalar::i64},
                                                        {"int64_t", Scalar::i64},
                                                        {"ulonglong", Scalar::u64},
                                                        {"unsigned long long", Scalar::u64},
                                                        {"unsigned long long int", Scalar::u64},
                                                        {"uint64", Scalar::u64},
                                                        {"uint64_t", Scalar::u64},
                                                        {"float", Scalar::f32},
                                                        {"double", Scalar::f64}};
    const auto it = names.find(lower(name));
    return it == names.end() ? std::nullopt : std::optional(it->second);
}

std::size_t scalarBytes(Scalar scalar) {
    switch (scalar) {
    case Scalar::i8:
    case Scalar::u8:
        return 1;
    case Scalar::i16:
    case Scalar::u16:
        return 2;
    case Scalar::i32:
    case Scalar::u32:
    case Scalar::f32:
        return 4;
    default:
        return 8;
    }
}

std::vector<std::byte> readBytes(const fs::path &path, std::uint64_t offset, std::uint64_t count,
                                 bool gzip, const task::Progress &progress) {
    // gzread passes bytes through when a file is not compressed, so one loop serves both encodings;
    // an attached gzip payload starts at an offset, which gzdopen on a positioned descriptor
    // honours.
    const File file = openFile(path);
    if (fseeko(file.get(), off_t(offset), SEEK_SET) != 0)
        throw Error(ErrorCode::unusable, "cannot be read", path);
    constexpr std::uint64_t chunk = 1 << 24;
    std::vector<std::byte> bytes;
    if (!gzip) {
        std::error_code ignored;
        if (fs::file_size(path, ignored) < offset + count)
            throw Error(ErrorCode::unusable, "is truncated", path);
        bytes.resize(count);
        for (std::uint64_t done = 0; done < count; done += chunk) {
            const std::uint64_t part = std::min(chunk, count - done);
            if (std::fread(bytes.data() + done, 1, part, file.get()) != part)
                throw Error(ErrorCode::unusable, "is truncated", path);
            progress.report(double(done) / double(count));
        }
        return bytes;
    }
    const int descriptor = dup(fileno(file.get()));
    lseek(descriptor, off_t(offset), SEEK_SET);
    std::unique_ptr<gzFile_s, int (*)(gzFile)> stream(gzdopen(descriptor, "rb"), &gzclose);
    if (!stream)
        throw Error(ErrorCode::unusable, "cannot be read", path);
    bytes.reserve(count);
    while (bytes.size() < count) {
        const std::uint64_t done = bytes.size();
        const std::uint64_t part = std::min(chunk, count - done);
        bytes.resize(done + part);
        const int got = gzread(stream.get(), bytes.data() + done, unsigned(part));
        if (got <= 0 || std::uint64_t(got) != part)
            throw Error(ErrorCode::unusable, "the compressed data are damaged or truncated", path);
        progress.report(double(done) / double(count));
    }
    return bytes;
}

template <class Stored, class Out>
std::vector<Out> converted(const std::vector<std::byte> &bytes, bool swap) {
    std::vector<Out> out(bytes.size() / sizeof(Stored));
    for (std::size_t n = 0; n < out.size(); ++n) {
        std::array<std::byte, sizeof(Stored)> raw;
        std::memcpy(raw.data(), bytes.data() + n * sizeof(Stored), sizeof(Stored));
        if (swap)
            std::reverse(raw.begin(), raw.end());
        out[n] = Out(std::bit_cast<Stored>(raw));
    }
    return out;
}

template <class Stored>
Volume volumeFrom(const std::vector<std::byte> &bytes, bool swap, const Lattice &lattice,
                  VolumeNotes notes) {
    if constexpr (sizeof(Stored) == 1 || std::is_same_v<Stored, std::int16_t>)
        return Volume(lattice, converted<Stored, std::int16_t>(bytes, swap), ValueUnit::none,
                      std::move(notes));
    if constexpr (std::is_same_v<Stored, std::uint16_t>) {
        auto values = converted<Stored, std::uint16_t>(bytes, swap);
        if (*std::max_element(values.begin(), values.end()) <=
            std::numeric_limits<std::int16_t>::max())
            return Volume(lattice, std::vector<std::int16_t>(values.begin(), values.end()),
                          ValueUnit::none, std::move(notes));
    }
    return Volume(lattice, converted<Stored, float>(bytes, swap), ValueUnit::none,
                  std::move(notes));
}

Volume toVolume(Scalar scalar, const std::vector<std::byte> &bytes, bool swap,
                const Lattice &lattice, VolumeNotes notes) {
    switch (scalar) {
    case Scalar::i8:
        return volumeFrom<std::int8_t>(bytes, swap, lattice, std::move(notes));
    case Scalar::u8:
        return volumeFrom<std::uint8_t>(bytes, swap, lattice, std::move(notes));
    case Scalar::i16:
        return volumeFrom<std::int16_t>(bytes, swap, lattice, std::move(notes));
    case Scalar::u16:
        return volumeFrom<std::uint16_t>(bytes, swap, lattice, std::move(notes));
    case Scalar::i32:
        return volumeFrom<std::int32_t>(bytes, swap, lattice, std::move(notes));
    case Scalar::u32:
        return volumeFrom<std::uint32_t>(bytes, swap, lattice, std::move(notes));
    case Scalar::i64:
        return volumeFrom<std::int64_t>(bytes, swap, lattice, std::move(notes));
    case Scalar::u64:
        return volumeFrom<std::uint64_t>(bytes, swap, lattice, std::move(notes));
    case Scalar::f32:
        return volumeFrom<float>(bytes, swap, lattice, std::move(notes));
    case Scalar::f64:
        break;
    }
    return volumeFrom<double>(bytes, swap, lattice, std::move(notes));
}

// Signs that turn the header's space into LPS.
glm::dvec3 toLps(const Fields &fields) {
    const auto space = fields.find({"space"});
    if (!space)
        return glm::dvec3(1.0);
    const std::string name = lower(*space);
    if (name == "left-posterior-superior" || name == "lps")
        return glm::dvec3(1.0);
    if (name == "right-anterior-superior" || name == "ras")
        return {-1.0, -1.0, 1.0};
    if (name == "left-anterior-superior" || name == "las")
        return {1.0, -1.0, 1.0};
    if (name == "scanner-xyz" || name == "3d-right-handed")
        return glm::dvec3(1.0);
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

Lattice parseLattice(const Fields &fields, GridSize size) {
    std::array<glm::dvec3, 3> steps{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};
    const glm::dvec3 sign = toLps(fields);
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
    try {
        return Lattice::make(size, {origin}, steps);
    } catch (const Error &error) {
        fields.fail(error.reason());
    }
}

} // namespace

bool isNrrdPath(const fs::path &path) {
    const std::string suffix = lower(path.extension().string());
    return suffix == ".nrrd" || suffix == ".nhdr";
}

namespace {

// Where and how the samples lie.
struct Layout {
    Lattice lattice;
    Scalar scalar = Scalar::u8;
    bool gzip = false, swap = false;
    fs::path dataPath;
    std::uint64_t offset = 0;
};

Layout parseLayout(const fs::path &path) {
    const Header header = readHeader(path);
    const Fields fields(header, path);
    if (fields.numbers<int>(fields.get({"dimension"}), 1)[0] != 3)
        fields.fail("only three-dimensional NRRD volumes are supported");
    const auto sizes = fields.numbers<long long>(fields.get({"sizes"}), 3);
    std::uint64_t count = 1;
    for (const long long n : sizes) {
        if (n < 1 || n > std::numeric_limits<int>::max() / 4)
            fields.fail("NRRD size out of range");
        // Divided, not multiplied: the product of three sizes may wrap.
        if (std::uint64_t(n) > maxSamples / count)
            fields.fail("the NRRD volume is too large");
        count *= std::uint64_t(n);
    }
    Layout layout;
    const std::string typeName = fields.get({"type"});
    const auto scalar = scalarOf(typeName);
    if (!scalar)
        fields.fail("NRRD type '" + typeName + "' is not supported");
    layout.scalar = *scalar;
    const std::string encoding = lower(fields.get({"encoding"}));
    layout.gzip = encoding == "gzip" || encoding == "gz";
    if (!layout.gzip && encoding != "raw")
        fields.fail("NRRD encoding '" + encoding + "' is not supported");
    if (scalarBytes(*scalar) > 1) {
        const std::string endian = lower(fields.get({"endian"}));
        if (endian != "little" && endian != "big")
            fields.fail("NRRD endian '" + endian + "' is not supported");
        layout.swap = (endian == "big") == (std::endian::native == std::endian::little);
    }
    for (const auto *skip : {"byte skip", "byteskip", "line skip", "lineskip"})
        if (const auto value = fields.find({skip}); value && *value != "0")
            fields.fail(std::string("NRRD '") + skip + "' is not supported");
    layout.dataPath = path;
    layout.offset = header.dataOffset;
    if (const auto detached = fields.find({"data file", "datafile"})) {
        layout.dataPath = detachedData(path, *detached);
        layout.offset = 0;
    } else if (layout.offset == 0) {
        fields.fail("is truncated");
    }
    layout.lattice = parseLattice(fields, {int(sizes[0]), int(sizes[1]), int(sizes[2])});
    return layout;
}

VolumeNotes notesFor(const fs::path &path) {
    VolumeNotes notes;
    notes.title = path.stem().string();
    return notes;
}

} // namespace

NrrdHeader readNrrdHeader(const fs::path &path) {
    const Layout layout = parseLayout(path);
    return {layout.lattice, notesFor(path), layout.dataPath};
}

Volume readNrrd(const fs::path &path, const task::Progress &progress) {
    const Layout layout = parseLayout(path);
    try {
        const std::uint64_t count = layout.lattice.size().count() * scalarBytes(layout.scalar);
        // The file's bytes and the samples that they become, of 4 bytes at most.
        task::requireMemory(double(count) + 4.0 * double(layout.lattice.size().count()));
        const auto bytes =
            readBytes(layout.dataPath, layout.offset, count, layout.gzip, progress.part(0, 0.8));
        Volume volume = toVolume(layout.scalar, bytes, layout.swap, layout.lattice, notesFor(path));
        progress.report(1.0);
        return volume;
    } catch (const std::bad_alloc &) {
        throw Error(ErrorCode::outOfMemory, "not enough memory for the volume", path);
    } catch (const Error &error) {
        if (!error.path().empty())
            throw;
        throw Error(error.code(), error.reason(), path);
    }
}

} // namespace pellucid::volume
