// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoder/read_nrrd.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "core/decoder/decoder.h"
#include "core/task/error.h"
#include "core/task/memory.h"

namespace pellucid::decoder {

namespace {

namespace fs = std::filesystem;
using task::Error;
using task::ErrorCode;
using volume::Lattice;
using volume::Volume;
using volume::VolumeNotes;

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

struct Nrrd {
    NrrdLayout layout;
    NrrdHeader header;
};

Nrrd open(const fs::path &path, const task::Progress &progress) {
    Nrrd nrrd{Decoder::ofProgram().nrrd(path, progress), {}};
    const NrrdLayout &layout = nrrd.layout;
    try {
        nrrd.header.lattice = Lattice::make(layout.size, {layout.originMm}, layout.stepsMm);
    } catch (const Error &error) {
        throw Error(error.code(), error.reason(), path);
    }
    nrrd.header.notes.title = path.stem().string();
    if (!layout.isOfPatient)
        nrrd.header.notes.warnings.emplace_back(
            "names no space of the patient; taken for left-posterior-superior");
    nrrd.header.samplesFile = layout.dataFile.empty() ? path : detachedData(path, layout.dataFile);
    return nrrd;
}

// Before memory is asked for: a file cannot hold more than its bytes, deflated ones 1032 times
// that (RFC 1951).
void checkSize(const fs::path &path, const NrrdSamples &samples) {
    std::error_code unknown;
    const std::uint64_t there = fs::file_size(path, unknown);
    const bool fits = samples.isGzip ? samples.bytes / 1032 <= there : samples.bytes <= there;
    if (!unknown && !fits)
        throw Error(
            ErrorCode::unusable,
            samples.isGzip ? "the compressed data are damaged or truncated" : "is truncated", path);
}

// Samples as they are stored, of type Stored, appended part by part.
template <class Stored> class Values {
public:
    // What fits 16 bits stays so; of the unsigned ones that is known at the end.
    using Kept = std::conditional_t<
        sizeof(Stored) == 1 || std::is_same_v<Stored, std::int16_t>, std::int16_t,
        std::conditional_t<std::is_same_v<Stored, std::uint16_t>, std::uint16_t, float>>;

    explicit Values(std::size_t count) : m_values(count) {}

    void add(std::span<const std::byte> part) {
        for (std::size_t at = 0; at < part.size(); at += sizeof(Stored)) {
            Stored value;
            std::memcpy(&value, part.data() + at, sizeof(Stored));
            if constexpr (std::is_floating_point_v<Stored>)
                notFinite += std::isfinite(float(value)) ? 0 : 1;
            m_values[m_next++] = Kept(value);
        }
    }
    Volume volume(const Lattice &lattice, VolumeNotes notes) {
        const auto made = [&](auto values) {
            return Volume(lattice, std::move(values), volume::ValueUnit::none, std::move(notes));
        };
        if constexpr (std::is_same_v<Kept, std::uint16_t>) {
            for (const std::uint16_t value : m_values)
                if (value > std::numeric_limits<std::int16_t>::max())
                    return made(std::vector<float>(m_values.begin(), m_values.end()));
            return made(std::vector<std::int16_t>(m_values.begin(), m_values.end()));
        } else {
            return made(std::move(m_values));
        }
    }

    std::size_t notFinite = 0; ///< of the samples

private:
    std::vector<Kept> m_values;
    std::size_t m_next = 0;
};

template <class Stored> Volume read(const Nrrd &nrrd, const task::Progress &progress) {
    const NrrdLayout &layout = nrrd.layout;
    const std::size_t count = nrrd.header.lattice.size().count();
    const NrrdSamples samples{count * sizeof(Stored), sizeof(Stored), layout.isGzip,
                              layout.isSwapped, layout.dataFile.empty()};
    checkSize(nrrd.header.samplesFile, samples);
    using Kept = typename Values<Stored>::Kept;
    // Unsigned values of 16 bits are there twice, at the end.
    task::requireMemory(double(count) *
                        (sizeof(Kept) + (std::is_same_v<Kept, std::uint16_t> ? 4.0 : 0.0)));
    Values<Stored> values(count);
    std::uint64_t done = 0;
    const bool hasMore = Decoder::ofProgram().nrrdSamples(
        nrrd.header.samplesFile, samples,
        [&](std::span<const std::byte> part) {
            values.add(part);
            done += part.size();
            progress.report(double(done) / double(samples.bytes));
        },
        progress);
    VolumeNotes notes = nrrd.header.notes;
    if (hasMore)
        notes.warnings.emplace_back("holds more samples than its header says");
    if (values.notFinite > 0)
        notes.warnings.push_back(
            fmt::format("samples that are no finite numbers: {}", values.notFinite));
    return values.volume(nrrd.header.lattice, std::move(notes));
}

Volume read(const Nrrd &nrrd, NrrdScalar scalar, const task::Progress &progress) {
    switch (scalar) {
    case NrrdScalar::i8:
        return read<std::int8_t>(nrrd, progress);
    case NrrdScalar::u8:
        return read<std::uint8_t>(nrrd, progress);
    case NrrdScalar::i16:
        return read<std::int16_t>(nrrd, progress);
    case NrrdScalar::u16:
        return read<std::uint16_t>(nrrd, progress);
    case NrrdScalar::i32:
        return read<std::int32_t>(nrrd, progress);
    case NrrdScalar::u32:
        return read<std::uint32_t>(nrrd, progress);
    case NrrdScalar::i64:
        return read<std::int64_t>(nrrd, progress);
    case NrrdScalar::u64:
        return read<std::uint64_t>(nrrd, progress);
    case NrrdScalar::f32:
        return read<float>(nrrd, progress);
    case NrrdScalar::f64:
        break;
    }
    return read<double>(nrrd, progress);
}

} // namespace

NrrdHeader readNrrdHeader(const fs::path &path, const task::Progress &progress) {
    return open(path, progress).header;
}

Volume readNrrd(const fs::path &path, const task::Progress &progress) {
    // Header and samples are read one after the other, perhaps from two files.
    const auto stateOf = [](const fs::path &file) {
        std::error_code unknown;
        return std::pair(fs::last_write_time(file, unknown), fs::file_size(file, unknown));
    };
    const auto before = stateOf(path);
    const Nrrd nrrd = open(path, progress);
    const fs::path &samples = nrrd.header.samplesFile;
    const auto samplesBefore = stateOf(samples);
    try {
        Volume volume = read(nrrd, nrrd.layout.scalar, progress);
        if (stateOf(path) != before || stateOf(samples) != samplesBefore)
            throw Error(ErrorCode::unusable, "changed while it was read");
        return volume;
    } catch (const std::bad_alloc &) {
        throw Error(ErrorCode::outOfMemory, "not enough memory for the volume", path);
    } catch (const Error &error) {
        if (!error.path().empty())
            throw;
        throw Error(error.code(), error.reason(), path);
    }
}

} // namespace pellucid::decoder
