// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/client/read_volume_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>

#include "core/decoding/client/decoder.h"
#include "core/decoding/client/reasons.h"
#include "core/files/reasons.h"
#include "core/system/memory.h"
#include "core/task/error.h"
#include "core/volume/narrowing.h"
#include "core/volume/volume_file.h"

namespace pellucid::decoding {

namespace {

namespace fs = std::filesystem;
namespace because = task::because;
using task::Error;
using task::ErrorCode;
using volume::Lattice;
using volume::Volume;
using volume::VolumeNotes;

// Must be next to the header or below: a header that names another file is malicious.
fs::path detachedData(const fs::path &header, const std::string &name) {
    const fs::path relative = fs::path(name).lexically_normal();
    if (name.find('\0') != std::string::npos || relative.is_absolute() || relative.empty() ||
        *relative.begin() == "..")
        throw Error(ErrorCode::unusable, because::listsAFileOutside, header);
    const fs::path data = header.parent_path() / relative;
    // A link may lead elsewhere.
    std::error_code unknown;
    const fs::path folder = fs::weakly_canonical(
        header.parent_path().empty() ? fs::path(".") : header.parent_path(), unknown);
    const fs::path meant = fs::weakly_canonical(data, unknown).lexically_relative(folder);
    if (unknown || meant.empty() || *meant.begin() == "..")
        throw Error(ErrorCode::unusable, because::listsAFileOutside, header);
    return data;
}

struct OpenVolume {
    VolumeLayout layout;
    VolumeFileHeader header;
};

OpenVolume open(const fs::path &path, const task::Progress &progress) {
    OpenVolume file{Decoder::shared().layout(path, progress), {}};
    const VolumeLayout &layout = file.layout;
    try {
        file.header.lattice = Lattice::make(layout.size, {layout.originMm}, layout.stepsMm);
    } catch (const Error &error) {
        throw Error(error.code(), error.reason(), path);
    }
    file.header.volumes = layout.volumes;
    file.header.segments = layout.segments;
    const std::string name = path.filename().string();
    file.header.notes.title = name.substr(0, name.size() - volume::volumeSuffix(path).size());
    if (!layout.hasPatientSpace)
        file.header.notes.warnings.emplace_back(because::namesNoSpace);
    file.header.samplesFile = layout.dataFile.empty() ? path : detachedData(path, layout.dataFile);
    return file;
}

// Checked before memory is allocated: a file cannot contain more than its bytes, or 1032 times as
// much if deflated (RFC 1951).
void checkSize(const fs::path &path, const SampleRange &samples) {
    std::error_code unknown;
    const std::uint64_t there = fs::file_size(path, unknown);
    const std::uint64_t wanted = samples.bytes + samples.skip;
    const bool fits = samples.isDeflated ? wanted / 1032 <= there : wanted + samples.at <= there;
    if (!unknown && !fits)
        throw Error(ErrorCode::unusable,
                    samples.isDeflated ? because::compressedDataDamaged : because::isTruncated,
                    path);
}

SampleRange rangeOf(const OpenVolume &file, int volume) {
    const VolumeLayout &layout = file.layout;
    SampleRange samples{file.header.lattice.size().count() * bytesOf(layout.scalar),
                        std::int32_t(bytesOf(layout.scalar)),
                        layout.isDeflated,
                        layout.isSwapped,
                        layout.at,
                        layout.skip};
    samples.skip += std::uint64_t(volume) * samples.bytes;
    return samples;
}

// Values of samples that are stored as `Stored`, appended part by part.
template <class Stored> class Values {
public:
    // Values that fit 16 bits are kept so; for unsigned ones that is known only at the end.
    using Kept = std::conditional_t<
        sizeof(Stored) == 1 || std::is_same_v<Stored, std::int16_t>, std::int16_t,
        std::conditional_t<std::is_same_v<Stored, std::uint16_t>, std::uint16_t, float>>;

    explicit Values(std::size_t count) : m_values(count), m_narrowing(count) {}

    void add(std::span<const std::byte> part) {
        for (std::size_t at = 0; at < part.size(); at += sizeof(Stored)) {
            Stored value;
            std::memcpy(&value, part.data() + at, sizeof(Stored));
            if constexpr (std::is_same_v<Kept, float>)
                narrow(double(value));
            else
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

    // Covers only the values that are kept as floats.
    const volume::Narrowing &narrowing() const { return m_narrowing; }

protected:
    void narrow(double value) { m_values[m_next++] = Kept(m_narrowing.narrow(value)); }

    std::vector<Kept> m_values;

private:
    std::size_t m_next = 0;
    volume::Narrowing m_narrowing;
};

// The same for rescaled values.
template <class Stored> class RescaledValues : public Values<double> {
public:
    RescaledValues(std::size_t count, double slope, double intercept)
        : Values<double>(count), m_slope(slope), m_intercept(intercept) {}

    void add(std::span<const std::byte> part) {
        for (std::size_t at = 0; at < part.size(); at += sizeof(Stored)) {
            Stored value;
            std::memcpy(&value, part.data() + at, sizeof(Stored));
            narrow(m_slope * double(value) + m_intercept);
        }
    }
    // Usually Hounsfield units: 16-bit integers.
    Volume volume(const Lattice &lattice, VolumeNotes notes) {
        const bool fitInt16 = std::is_integral_v<Stored> &&
                              std::all_of(m_values.begin(), m_values.end(), [](float v) {
                                  return std::abs(v) <= std::numeric_limits<std::int16_t>::max() &&
                                         v == std::round(v);
                              });
        if (!fitInt16)
            return Values<double>::volume(lattice, std::move(notes));
        return Volume(lattice, std::vector<std::int16_t>(m_values.begin(), m_values.end()),
                      volume::ValueUnit::none, std::move(notes));
    }

private:
    double m_slope, m_intercept;
};

template <class Stored, class Taken>
Volume volumeFrom(const OpenVolume &file, int which, Taken values, const task::Progress &progress) {
    const VolumeLayout &layout = file.layout;
    const SampleRange samples = rangeOf(file, which);
    checkSize(file.header.samplesFile, samples);
    std::uint64_t done = 0;
    const bool hasMore = Decoder::shared().samples(
        file.header.samplesFile, samples,
        [&](std::span<const std::byte> part) {
            values.add(part);
            done += part.size();
            progress.report(double(done) / double(samples.bytes));
        },
        progress);
    VolumeNotes notes = file.header.notes;
    if (hasMore && which == layout.volumes - 1)
        notes.warnings.emplace_back(because::moreSamplesThanDeclared);
    const volume::Narrowing &narrowing = values.narrowing();
    if (narrowing.notFinite() > 0)
        notes.warnings.push_back(because::samplesNotFinite(narrowing.notFinite()));
    narrowing.requireDistinct();
    if (const auto warning = narrowing.warning())
        notes.warnings.push_back(*warning);
    return values.volume(file.header.lattice, std::move(notes));
}

template <class Stored>
Volume read(const OpenVolume &file, int which, const task::Progress &progress) {
    const VolumeLayout &layout = file.layout;
    const std::size_t count = file.header.lattice.size().count();
    using Kept = typename Values<Stored>::Kept;
    const bool isRescaled = layout.slope != 1.0 || layout.intercept != 0.0;
    // Values that may turn out to fit 16 bits exist twice at the end.
    const double bytesEach = isRescaled
                                 ? sizeof(float) + 2.0
                                 : sizeof(Kept) + (std::is_same_v<Kept, std::uint16_t> ? 4.0 : 0.0);
    system::requireMemory(double(count) * bytesEach);
    if (isRescaled)
        return volumeFrom<Stored>(
            file, which, RescaledValues<Stored>(count, layout.slope, layout.intercept), progress);
    return volumeFrom<Stored>(file, which, Values<Stored>(count), progress);
}

Volume read(const OpenVolume &file, int which, const task::Progress &progress) {
    switch (file.layout.scalar) {
    case StoredScalar::i8:
        return read<std::int8_t>(file, which, progress);
    case StoredScalar::u8:
        return read<std::uint8_t>(file, which, progress);
    case StoredScalar::i16:
        return read<std::int16_t>(file, which, progress);
    case StoredScalar::u16:
        return read<std::uint16_t>(file, which, progress);
    case StoredScalar::i32:
        return read<std::int32_t>(file, which, progress);
    case StoredScalar::u32:
        return read<std::uint32_t>(file, which, progress);
    case StoredScalar::i64:
        return read<std::int64_t>(file, which, progress);
    case StoredScalar::u64:
        return read<std::uint64_t>(file, which, progress);
    case StoredScalar::f32:
        return read<float>(file, which, progress);
    case StoredScalar::f64:
        break;
    }
    return read<double>(file, which, progress);
}

} // namespace

VolumeFileHeader readVolumeFileHeader(const fs::path &path, const task::Progress &progress) {
    OpenVolume file = open(path, progress);
    std::error_code unknown;
    if (!fs::exists(file.header.samplesFile, unknown))
        throw Error(ErrorCode::unusable,
                    because::samplesMissing(file.header.samplesFile.filename().string()), path);
    checkSize(file.header.samplesFile, rangeOf(file, 0));
    return file.header;
}

Volume readVolumeFile(const fs::path &path, const task::Progress &progress, int volume) {
    // Header and samples are read separately, perhaps from two files.
    const auto stateOf = [](const fs::path &file) {
        std::error_code unknown;
        return std::pair(fs::last_write_time(file, unknown), fs::file_size(file, unknown));
    };
    const auto before = stateOf(path);
    const OpenVolume file = open(path, progress);
    const fs::path &samples = file.header.samplesFile;
    const auto samplesBefore = stateOf(samples);
    try {
        if (volume < 0 || volume >= file.layout.volumes)
            throw Error(ErrorCode::unusable, because::holdsFewerVolumes);
        Volume read = decoding::read(file, volume, progress);
        if (stateOf(path) != before || stateOf(samples) != samplesBefore)
            throw Error(ErrorCode::unusable, because::changedWhileRead);
        return read;
    } catch (const std::bad_alloc &) {
        throw Error(ErrorCode::outOfMemory, because::noMemoryForTheVolume, path);
    } catch (const Error &error) {
        if (!error.path().empty())
            throw;
        throw Error(error.code(), error.reason(), path);
    }
}

} // namespace pellucid::decoding
