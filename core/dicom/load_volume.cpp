// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/load_volume.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include <tbb/parallel_for.h>

#include "core/decoding/client/decoder.h"
#include "core/decoding/client/read_volume_file.h"
#include "core/decoding/client/reasons.h"
#include "core/dicom/entry_files.h"
#include "core/dicom/modality_values.h"
#include "core/dicom/reasons.h"
#include "core/dicom/remaining_stack.h"
#include "core/dicom/resample_stack.h"
#include "core/dicom/value_warnings.h"
#include "core/system/memory.h"
#include "core/task/error.h"

namespace pellucid::dicom {

namespace {

namespace because = task::because;
using decoding::InstanceHeader;
using task::Error;
using task::ErrorCode;
using Clock = std::chrono::steady_clock;

// A preview copies the volume; at shorter intervals that would cost more than decoding.
constexpr auto previewInterval = std::chrono::milliseconds(400);

// Decodes the files of an entry. Thread-safe.
class EntryDecoder {
public:
    EntryDecoder(const VolumeEntry &entry, const task::Progress &progress,
                 const DecodedFiles *decoded)
        : m_files(filesOf(entry)), m_size(entry.geometry.lattice.size()), m_progress(progress),
          m_decoded(decoded) {}

    const std::vector<EntryFile> &files() const { return m_files; }

    // The first readable file, which is kept for `decode`. *Throws* the last file's error if there
    // is none.
    const InstanceHeader *firstReadable() {
        for (m_keptFile = 0; m_keptFile < m_files.size(); ++m_keptFile) {
            try {
                m_kept.emplace(decoded(m_files[m_keptFile].path));
                return &m_kept->header;
            } catch (const Error &error) {
                if (error.code() != ErrorCode::unusable)
                    throw;
                if (m_keptFile + 1 == m_files.size())
                    throw Error(codeIfNoneReadable(), error.reason(), error.path());
            }
        }
        return nullptr;
    }
    std::size_t keptBytes() const { return m_kept ? m_kept->samples.size_bytes() : 0; }

    // *Requires*: no two threads decode the same file. *Throws* Error{unusable} also for a file
    // that asks for too much memory: it is skipped like a damaged one.
    decoding::DecodedFile decode(std::size_t file) {
        if (file != m_keptFile || !m_kept)
            return decoded(m_files[file].path);
        decoding::DecodedFile kept = std::move(*m_kept);
        m_kept.reset();
        return kept;
    }

    // The error code if no file could be read.
    ErrorCode codeIfNoneReadable() const {
        return m_lacksMemory ? ErrorCode::outOfMemory : ErrorCode::unusable;
    }

private:
    decoding::DecodedFile decoded(const std::filesystem::path &path) {
        try {
            auto known = m_decoded != nullptr ? m_decoded->find(path)
                                              : std::optional<decoding::DecodedFile>();
            decoding::DecodedFile image =
                known ? std::move(*known) : decoding::Decoder::shared().image(path, m_progress);
            if (image.header.columns != m_size.i || image.header.rows != m_size.j)
                throw Error(ErrorCode::unusable, because::changedWhileRead, path);
            return image;
        } catch (const Error &error) {
            if (error.code() != ErrorCode::outOfMemory)
                throw;
            m_lacksMemory = true;
            throw Error(ErrorCode::unusable, because::needsTooMuchMemory, path);
        }
    }

    std::vector<EntryFile> m_files;
    volume::GridSize m_size;
    const task::Progress &m_progress;
    const DecodedFiles *m_decoded; ///< or null
    std::atomic<bool> m_lacksMemory = false;
    std::size_t m_keptFile = 0;
    std::optional<decoding::DecodedFile> m_kept;
};

// Properties of files that are known only after decoding.
class DecodingNotes {
public:
    void add(const InstanceHeader &header, const std::filesystem::path &path) {
        const std::lock_guard lock(m_guard);
        if ((header.oddities & decoding::otherPrecision) != 0)
            ++m_otherPrecision;
        if (header.hasDamagedPixels)
            m_damaged.insert(path.filename().string());
    }

    std::vector<task::Reason> warnings() const {
        constexpr std::size_t maxNamed = 5;
        std::vector<task::Reason> warnings;
        for (const std::string &name : m_damaged)
            if (warnings.size() < maxNamed)
                warnings.push_back(because::damagedPixelsOf(name));
        if (m_damaged.size() > maxNamed)
            warnings.push_back(because::damagedPixels(m_damaged.size()));
        if (m_otherPrecision > 0) {
            InstanceHeader header;
            header.oddities = decoding::otherPrecision;
            header.frames.resize(1);
            const std::vector<const InstanceHeader *> all(m_otherPrecision, &header);
            for (const task::Reason &warning : warningsOfValues(all))
                warnings.push_back(warning);
        }
        return warnings;
    }

private:
    std::mutex m_guard;
    std::set<std::string> m_damaged; ///< but decoded
    std::size_t m_otherPrecision = 0;
};

// A volume with samples of type T, int16 or float, while its files are decoded.
template <class T> class Assembly {
public:
    Assembly(const VolumeEntry &entry, EntryDecoder &decoder, const task::Progress &progress,
             const LoadObserver &observer)
        : m_entry(entry), m_decoder(decoder), m_progress(progress), m_observer(observer),
          m_plane(entry.geometry.lattice.size().offsetOf(0, 0, 1)),
          m_samples(requiredSamples(), missingValue<T>()), m_arrived(entry.frames.size()),
          m_failures(decoder.files().size()), m_narrowing(m_samples.size()) {}

    // Decodes all files. False if a value does not fit T.
    bool read() {
        tbb::parallel_for(std::size_t(0), m_decoder.files().size(), [&](std::size_t file) {
            m_progress.check();
            if (!readFile(file)) {
                m_fits = false;
                return;
            }
            if (!report())
                return;
            // Called without the lock: within the call this thread may be given other slices to
            // read.
            m_observer.preview(preview());
            const std::lock_guard lock(m_guard);
            m_lastPreview = Clock::now();
            m_isPreviewing = false;
        });
        return m_fits;
    }

    // Why files could not be read. *Shape*: one entry per file.
    const std::vector<std::optional<task::Reason>> &failures() const { return m_failures; }
    bool isComplete() const {
        return std::none_of(m_failures.begin(), m_failures.end(),
                            [](const auto &failure) { return failure.has_value(); });
    }

    // Moves the volume out.
    volume::Volume takeVolume() {
        m_narrowing.requireDistinct();
        volume::VolumeNotes notes = m_entry.notes;
        std::vector<task::Reason> ofValues = m_notes.warnings();
        if (const auto warning = m_narrowing.warning())
            ofValues.push_back(*warning);
        // The reason why images are not a volume remains last.
        notes.warnings.insert(notes.warnings.end() -
                                  (m_entry.placed || notes.warnings.empty() ? 0 : 1),
                              ofValues.begin(), ofValues.end());
        return volumeOf(std::move(m_samples), std::move(notes));
    }

private:
    // Checks the memory first. A preview or the resampled stack will exist as well; the file
    // that is already decoded needs no more memory.
    std::size_t requiredSamples() const {
        const double slices =
            std::max<double>(m_entry.geometry.lattice.size().k, double(m_entry.frames.size()));
        system::requireMemory(2.0 * sizeof(T) * double(m_plane) * slices -
                              double(m_decoder.keptBytes()));
        return m_plane * m_entry.frames.size();
    }

    ValueScale scale() const { return {m_entry.unit, m_entry.valueFactor}; }

    // False if a value does not fit T.
    bool readFile(std::size_t n) {
        const EntryFile &file = m_decoder.files()[n];
        try {
            const decoding::DecodedFile image = m_decoder.decode(n);
            if (std::is_same_v<T, std::int16_t> && !fitsInt16(image.header, scale()))
                return false;
            m_notes.add(image.header, file.path);
            volume::Narrowing ofFile(m_samples.size(), file.frames.front() * m_plane);
            for (const std::size_t slice : file.frames) {
                const FrameReference &frame = m_entry.frames[slice];
                if (!stillContains(frame, image.header))
                    throw Error(ErrorCode::unusable, because::changedWhileRead);
                if (!writeValues(image, frame.frame, scale(), m_samples.data() + slice * m_plane,
                                 ofFile))
                    return false;
                m_arrived[slice].store(true, std::memory_order_release);
            }
            const std::lock_guard lock(m_guard);
            m_narrowing.join(ofFile);
        } catch (const Error &error) {
            if (error.code() != ErrorCode::unusable)
                throw;
            m_failures[n] = error.reason();
        }
        return true;
    }

    // Counts a file. Returns whether the caller must make a preview; no other thread makes it then.
    bool report() {
        const std::lock_guard lock(m_guard);
        const std::size_t all = m_decoder.files().size();
        m_progress.report(0.9 * double(++m_done) / double(all));
        const bool isDue = m_observer.preview && m_done < all && !m_isPreviewing &&
                           Clock::now() - m_lastPreview > previewInterval;
        m_isPreviewing = m_isPreviewing || isDue;
        return isDue;
    }

    volume::Volume preview() const {
        std::vector<T> soFar(m_samples.size(), missingValue<T>());
        for (std::size_t slice = 0; slice < m_arrived.size(); ++slice)
            if (m_arrived[slice].load(std::memory_order_acquire))
                std::copy_n(m_samples.begin() + std::ptrdiff_t(slice * m_plane), m_plane,
                            soFar.begin() + std::ptrdiff_t(slice * m_plane));
        return volumeOf(std::move(soFar), m_entry.notes);
    }

    volume::Volume volumeOf(std::vector<T> samples, volume::VolumeNotes notes) const {
        fillMissing(samples);
        if (!m_entry.geometry.frameOffsetsMm.empty())
            samples = resampled(samples, m_entry.geometry, m_progress);
        return volume::Volume(m_entry.geometry.lattice, std::move(samples), m_entry.unit,
                              std::move(notes));
    }

    const VolumeEntry &m_entry;
    EntryDecoder &m_decoder;
    const task::Progress &m_progress;
    const LoadObserver &m_observer;
    std::size_t m_plane;
    std::vector<T> m_samples; ///< by frame of the entry
    /// Set when a frame is complete, so that a preview copies no partly written one.
    std::vector<std::atomic<bool>> m_arrived;
    std::vector<std::optional<task::Reason>> m_failures;
    DecodingNotes m_notes;
    std::atomic<bool> m_fits = true;

    std::mutex m_guard; ///< of the members below
    volume::Narrowing m_narrowing;
    std::size_t m_done = 0;
    bool m_isPreviewing = false;
    Clock::time_point m_lastPreview = Clock::now();
};

class Loader {
public:
    Loader(const VolumeEntry &entry, const task::Progress &progress, const LoadObserver &observer,
           const DecodedFiles *decoded)
        : m_entry(entry), m_decoder(entry, progress, decoded), m_progress(progress),
          m_observer(observer), m_decoded(decoded) {}

    // The first readable file decides the type; a value that does not fit switches to float.
    LoadedVolume load() {
        const InstanceHeader *const first = m_decoder.firstReadable();
        if (first == nullptr || fitsInt16(*first, {m_entry.unit, m_entry.valueFactor}))
            if (auto loaded = loadAs<std::int16_t>())
                return std::move(*loaded);
        return std::move(*loadAs<float>());
    }

private:
    // Empty if a value does not fit T.
    template <class T> std::optional<LoadedVolume> loadAs() {
        std::vector<std::optional<task::Reason>> failures;
        {
            Assembly<T> assembly(m_entry, m_decoder, m_progress, m_observer);
            if (!assembly.read())
                return std::nullopt;
            if (assembly.isComplete()) {
                LoadedVolume loaded{assembly.takeVolume(), {}};
                m_progress.report(1.0);
                return loaded;
            }
            failures = assembly.failures();
        } // frees the samples before the rest is loaded
        const RemainingStack rest = remainingStack(m_entry, m_decoder.files(), failures,
                                                   m_decoder.codeIfNoneReadable(), m_progress);
        LoadedVolume loaded = loadVolume(rest.entry, m_progress, m_observer, m_decoded);
        loaded.skipped.insert(loaded.skipped.begin(), rest.skipped.begin(), rest.skipped.end());
        return loaded;
    }

    const VolumeEntry &m_entry;
    EntryDecoder m_decoder;
    const task::Progress &m_progress;
    const LoadObserver &m_observer;
    const DecodedFiles *m_decoded; ///< or null
};

} // namespace

LoadedVolume loadVolume(const VolumeEntry &entry, const task::Progress &progress,
                        const LoadObserver &observer, const DecodedFiles *decoded) {
    try {
        if (!entry.volumeFile.empty())
            return {decoding::readVolumeFile(entry.volumeFile, progress, entry.fileVolume), {}};
        return Loader(entry, progress, observer, decoded).load();
    } catch (const std::bad_alloc &) {
        const volume::GridSize n = entry.geometry.lattice.size();
        throw Error(ErrorCode::outOfMemory, because::noMemoryForAVolume(n.i, n.j, n.k));
    }
}

} // namespace pellucid::dicom
