// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/load_volume.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <tuple>

#include <tbb/parallel_for.h>

#include "core/decoder/decoder.h"
#include "core/decoder/read_volume_file.h"
#include "core/dicom/group_series.h"
#include "core/system/memory.h"
#include "core/task/error.h"
#include "core/volume/narrowing.h"

namespace pellucid::dicom {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;
using Clock = std::chrono::steady_clock;

// Previews copy the volume; more often than this they would cost more than the decoding.
constexpr auto previewInterval = std::chrono::milliseconds(400);

// Padding must not be taken for tissue, but some scanners write a padding value that is also a
// value of tissue (0 in a CT of signed HU): between these bounds it is believed to be tissue.
constexpr double lowestTissueHu = -900.0, highestTissueHu = 4000.0;

template <class T> struct Missing;
template <> struct Missing<std::int16_t> {
    static constexpr std::int16_t value = std::numeric_limits<std::int16_t>::min();
    static bool is(std::int16_t v) { return v == value; }
};
template <> struct Missing<float> {
    static constexpr float value = std::numeric_limits<float>::quiet_NaN();
    static bool is(float v) { return std::isnan(v); }
};

double rescaled(const InstanceHeader &h, int frame, int stored) {
    if (!h.modalityTable.empty()) {
        const int at =
            std::clamp(stored - h.modalityTableFirst, 0, int(h.modalityTable.size()) - 1);
        return h.modalityTable[std::size_t(at)];
    }
    const Rescale &r = h.frames[std::size_t(frame)].rescale;
    return r.slope * stored + r.intercept;
}

// Whether the values of a file are likely to fit int16 without loss. HU hardly ever use all of the
// 16 bits that their header announces, so they are tried.
bool fitsShort(const InstanceHeader &h, volume::ValueUnit unit) {
    if (!h.modalityTable.empty())
        return *std::max_element(h.modalityTable.begin(), h.modalityTable.end()) <= 32767;
    const double top = h.isSigned() ? std::exp2(h.bitsStored - 1) - 1 : std::exp2(h.bitsStored) - 1;
    const double bottom = h.isSigned() ? -std::exp2(h.bitsStored - 1) : 0.0;
    return std::all_of(h.frames.begin(), h.frames.end(), [&](const FrameHeader &f) {
        const Rescale &r = f.rescale;
        if (r.slope != std::round(r.slope) || r.intercept != std::round(r.intercept))
            return false;
        const double a = r.slope * bottom + r.intercept, b = r.slope * top + r.intercept;
        return unit == volume::ValueUnit::hounsfield
                   ? std::abs(r.slope) == 1.0
                   : std::max(a, b) <= 32767 && std::min(a, b) >= -32767;
    });
}

struct Padding {
    int low = 0, high = 0;
    bool holds(int stored) const { return stored >= low && stored <= high; }
};

std::optional<Padding> paddingOf(const InstanceHeader &h, volume::ValueUnit unit) {
    if (!h.paddingValue)
        return std::nullopt;
    int value = *h.paddingValue, limit = h.paddingLimit.value_or(value);
    if (h.isSigned()) { // written as unsigned by some
        value = value > 32767 ? value - 65536 : value;
        limit = limit > 32767 ? limit - 65536 : limit;
    }
    if (unit == volume::ValueUnit::hounsfield) {
        const double hu = rescaled(h, 0, value);
        if (hu > lowestTissueHu && hu < highestTissueHu)
            return std::nullopt;
    }
    return Padding{std::min(value, limit), std::max(value, limit)};
}

// False if a value does not fit T.
template <class T>
bool place(const decoder::DecodedFile &image, int frame, volume::ValueUnit unit, T *out,
           volume::Narrowing &narrowing) {
    const InstanceHeader &h = image.header;
    const std::size_t plane = std::size_t(h.rows) * h.columns;
    // Read once each: what decoded them may change them still.
    const volatile std::uint16_t *in = image.samples.data() + plane * std::size_t(frame);
    const auto padding = paddingOf(h, unit);
    for (std::size_t n = 0; n < plane; ++n) {
        const std::uint16_t code = in[n];
        const int stored = h.isSigned() ? int(std::int16_t(code)) : int(code);
        if (padding && padding->holds(stored)) {
            out[n] = Missing<T>::value;
            continue;
        }
        const double value = rescaled(h, frame, stored);
        if constexpr (std::is_same_v<T, float>)
            out[n] = narrowing.narrow(value);
        else if (std::abs(value) <= 32767.0) // the lowest code marks missing samples
            out[n] = T(value);
        else
            return false;
    }
    return true;
}

// Linear interpolation along the stack, from where the frames are to where the slices shall be.
template <class T>
std::vector<T> resampled(const std::vector<T> &frames, const StackGeometry &geometry,
                         const task::Progress &progress) {
    const volume::Lattice &lattice = geometry.lattice;
    const std::size_t plane = std::size_t(lattice.size().i) * lattice.size().j;
    const std::vector<double> &at = geometry.frameOffsetsMm;
    std::vector<T> out(lattice.size().count());
    tbb::parallel_for(0, lattice.size().k, [&](int k) {
        progress.check();
        const double depth = std::min(k * lattice.sliceDistanceMm(), at.back());
        const auto above = std::upper_bound(at.begin() + 1, at.end() - 1, depth);
        const auto high = std::size_t(above - at.begin()), low = high - 1;
        const double gap = at[high] - at[low];
        const double w = gap > 0.0 ? std::clamp((depth - at[low]) / gap, 0.0, 1.0) : 0.0;
        const T *a = frames.data() + low * plane, *b = frames.data() + high * plane;
        T *to = out.data() + std::size_t(k) * plane;
        for (std::size_t n = 0; n < plane; ++n) {
            const double value = double(a[n]) + w * (double(b[n]) - double(a[n]));
            if constexpr (std::is_same_v<T, float>)
                to[n] = float(value);
            else
                to[n] = T(std::lround(value));
        }
    });
    return out;
}

template <class T> void fillMissing(std::vector<T> &samples) {
    T lowest = std::numeric_limits<T>::max();
    bool any = false, all = true;
    for (const T v : samples)
        if (Missing<T>::is(v)) {
            any = true;
        } else {
            lowest = std::min(lowest, v);
            all = false;
        }
    if (any)
        std::replace_if(samples.begin(), samples.end(), Missing<T>::is, all ? T(0) : lowest);
}

class Assembly {
public:
    Assembly(const VolumeEntry &entry, const task::Progress &progress, const LoadObserver &observer)
        : m_entry(entry), m_progress(progress), m_observer(observer) {
        // Multi-frame files are read once for all of their frames.
        for (std::size_t n = 0; n < entry.frames.size(); ++n)
            m_files[entry.frames[n].path].push_back(n);
        for (const auto &[path, frames] : m_files)
            m_paths.push_back(path);
        std::sort(m_paths.begin(), m_paths.end(), [&](const auto &a, const auto &b) {
            return m_files[a].front() < m_files[b].front();
        });
    }

    LoadedVolume load() {
        // The first readable file decides the type; a value that does not fit sends all to float.
        bool shorts = true;
        for (const auto &path : m_paths) {
            try {
                shorts = fitsShort(decode(path).header, m_entry.unit);
                break;
            } catch (const Error &error) {
                if (error.code() != ErrorCode::unusable)
                    throw;
                if (path == m_paths.back())
                    throw Error(codeWithoutAny(), error.reason(), error.path());
            }
        }
        if (shorts)
            if (auto loaded = loadAs<std::int16_t>())
                return std::move(*loaded);
        return std::move(*loadAs<float>());
    }

private:
    static bool isStillThere(const FrameReference &meant, const InstanceHeader &found) {
        return meant.frame < int(found.frames.size()) &&
               meant.digest == digestOf(found.sopInstanceUid, found.frameOfReferenceUid,
                                        found.modality, found.frames[std::size_t(meant.frame)]);
    }

    // A file that asks for too much costs itself, as one that is damaged.
    decoder::DecodedFile decode(const std::filesystem::path &path) const {
        try {
            decoder::DecodedFile image = decoder::Decoder::ofProgram().image(path, m_progress);
            if (image.header.columns != m_columns() || image.header.rows != m_rows())
                throw Error(ErrorCode::unusable, because::changedWhileRead, path);
            return image;
        } catch (const Error &error) {
            if (error.code() != ErrorCode::outOfMemory)
                throw;
            m_lacksMemory = true;
            throw Error(ErrorCode::unusable, because::needsTooMuchMemory, path);
        }
    }
    // Where no file is left that could be read.
    ErrorCode codeWithoutAny() const {
        return m_lacksMemory ? ErrorCode::outOfMemory : ErrorCode::unusable;
    }
    int m_columns() const { return m_entry.geometry.lattice.size().i; }
    int m_rows() const { return m_entry.geometry.lattice.size().j; }

    // Nothing if a value does not fit T.
    template <class T> std::optional<LoadedVolume> loadAs() {
        const std::size_t plane = std::size_t(m_columns()) * m_rows();
        // A preview, or the resampled stack, is there as well.
        const double slices =
            std::max<double>(m_entry.geometry.lattice.size().k, double(m_entry.frames.size()));
        system::requireMemory(2.0 * sizeof(T) * double(plane) * slices);
        std::vector<T> samples(plane * m_entry.frames.size(), Missing<T>::value);
        // Set when a slice is complete, so that a preview copies no half-written one.
        std::vector<std::atomic<bool>> arrived(m_entry.frames.size());
        std::vector<std::pair<std::size_t, Skipped>> failed;
        std::set<std::string> damaged; // and decoded all the same
        std::atomic<int> otherwisePrecise = 0;
        volume::Narrowing narrowing(samples.size());
        std::mutex guard;
        std::size_t done = 0;
        bool fits = true, isPreviewing = false;
        auto lastPreview = Clock::now();
        tbb::parallel_for(std::size_t(0), m_paths.size(), [&](std::size_t n) {
            m_progress.check();
            const auto &frames = m_files.at(m_paths[n]);
            try {
                const decoder::DecodedFile image = decode(m_paths[n]);
                if (std::is_same_v<T, std::int16_t> && !fitsShort(image.header, m_entry.unit)) {
                    const std::lock_guard lock(guard);
                    fits = false;
                    return;
                }
                if ((image.header.oddities & decoder::otherPrecision) != 0)
                    ++otherwisePrecise;
                if (image.header.hasDamagedPixels) {
                    const std::lock_guard lock(guard);
                    damaged.insert(m_paths[n].filename().string());
                }
                volume::Narrowing ofFile(samples.size(), frames.front() * plane);
                for (const std::size_t slice : frames) {
                    const int frame = m_entry.frames[slice].frame;
                    if (!isStillThere(m_entry.frames[slice], image.header))
                        throw Error(ErrorCode::unusable, because::changedWhileRead);
                    if (!place(image, frame, m_entry.unit, samples.data() + slice * plane,
                               ofFile)) {
                        const std::lock_guard lock(guard);
                        fits = false;
                        return;
                    }
                    arrived[slice].store(true, std::memory_order_release);
                }
                const std::lock_guard lock(guard);
                narrowing.join(ofFile);
            } catch (const Error &error) {
                if (error.code() != ErrorCode::unusable)
                    throw;
                const std::lock_guard lock(guard);
                for (const std::size_t slice : frames)
                    failed.emplace_back(slice, Skipped{m_paths[n], error.reason()});
            }
            bool isDue = false;
            {
                const std::lock_guard lock(guard);
                m_progress.report(0.9 * double(++done) / double(m_paths.size()));
                isDue = m_observer.preview && done < m_paths.size() && !isPreviewing &&
                        Clock::now() - lastPreview > previewInterval;
                isPreviewing = isPreviewing || isDue;
            }
            if (!isDue)
                return;
            // Without the lock: inside, this thread may be given other slices to read.
            m_observer.preview(preview(samples, arrived));
            const std::lock_guard lock(guard);
            lastPreview = Clock::now();
            isPreviewing = false;
        });
        if (!fits)
            return std::nullopt;
        if (!failed.empty()) {
            samples = {};
            return loadWithout(failed);
        }
        narrowing.requireDistinct();
        fillMissing(samples);
        if (!m_entry.geometry.frameOffsetsMm.empty())
            samples = resampled(samples, m_entry.geometry, m_progress);
        volume::VolumeNotes notes = m_entry.notes;
        constexpr std::size_t mostNamed = 5;
        std::vector<task::Reason> ofValues;
        for (const std::string &name : damaged)
            if (ofValues.size() < mostNamed)
                ofValues.push_back(because::damagedPixelsOf(name));
        if (damaged.size() > mostNamed)
            ofValues.push_back(because::damagedPixels(damaged.size()));
        if (otherwisePrecise > 0) {
            InstanceHeader header;
            header.oddities = decoder::otherPrecision;
            const std::vector<const InstanceHeader *> all(std::size_t(otherwisePrecise.load()),
                                                          &header);
            for (const task::Reason &warning : warningsOfValues(all))
                ofValues.push_back(warning);
        }
        if (const auto warning = narrowing.warning())
            ofValues.push_back(*warning);
        // Why images are no volume stays the last.
        notes.warnings.insert(notes.warnings.end() -
                                  (m_entry.placed || notes.warnings.empty() ? 0 : 1),
                              ofValues.begin(), ofValues.end());
        LoadedVolume loaded{volumeOf(std::move(samples), m_entry.geometry.lattice, notes), {}};
        m_progress.report(1.0);
        return loaded;
    }

    template <class T>
    volume::Volume preview(const std::vector<T> &samples,
                           const std::vector<std::atomic<bool>> &arrived) const {
        const std::size_t plane = std::size_t(m_columns()) * m_rows();
        std::vector<T> soFar(samples.size(), Missing<T>::value);
        for (std::size_t slice = 0; slice < arrived.size(); ++slice)
            if (arrived[slice].load(std::memory_order_acquire))
                std::copy_n(samples.begin() + std::ptrdiff_t(slice * plane), plane,
                            soFar.begin() + std::ptrdiff_t(slice * plane));
        fillMissing(soFar);
        if (!m_entry.geometry.frameOffsetsMm.empty())
            soFar = resampled(soFar, m_entry.geometry, m_progress);
        return volumeOf(std::move(soFar), m_entry.geometry.lattice, m_entry.notes);
    }

    template <class T>
    volume::Volume volumeOf(std::vector<T> samples, const volume::Lattice &lattice,
                            const volume::VolumeNotes &notes) const {
        return volume::Volume(lattice, std::move(samples), m_entry.unit, notes);
    }

    // Slices that cannot be decoded are missing slices: the geometry is worked out again without
    // them, as if they had never been in the folder.
    LoadedVolume loadWithout(const std::vector<std::pair<std::size_t, Skipped>> &failed) const {
        std::vector<Skipped> skipped;
        std::vector<SeriesFile> files;
        // Grouping sees the frames of this volume only, renumbered; this leads back.
        std::map<std::filesystem::path, std::vector<FrameReference>> original;
        for (const auto &path : m_paths) {
            const auto &frames = m_files.at(path);
            const auto it = std::find_if(failed.begin(), failed.end(),
                                         [&](const auto &f) { return f.first == frames.front(); });
            if (it != failed.end()) {
                skipped.push_back(it->second);
                continue;
            }
            SeriesFile file{path, decoder::Decoder::ofProgram().header(path, m_progress)};
            if (!std::all_of(frames.begin(), frames.end(), [&](std::size_t slice) {
                    return isStillThere(m_entry.frames[slice], file.header);
                })) {
                skipped.push_back({path, because::changedWhileRead});
                continue;
            }
            std::vector<FrameHeader> kept;
            for (const std::size_t slice : frames) {
                const FrameReference &frame = m_entry.frames[slice];
                kept.push_back(file.header.frames[std::size_t(frame.frame)]);
                original[path].push_back(frame);
            }
            file.header.frames = std::move(kept);
            // All slices together were found to be one volume; fewer must not be split by it.
            file.header.frameOfReferenceUid.clear();
            files.push_back(std::move(file));
        }
        if (files.empty())
            throw Error(codeWithoutAny(), skipped.front().reason, skipped.front().path);
        std::vector<Skipped> ignored;
        const auto entries = groupSeries(files, ignored);
        // Several slices that are missing side by side leave runs; or all of it, as was asked for.
        const auto found = std::max_element(
            entries.begin(), entries.end(), [&](const VolumeEntry &a, const VolumeEntry &b) {
                const auto rank = [&](const VolumeEntry &e) {
                    return std::tuple(e.placed, e.fillsHoles == m_entry.fillsHoles,
                                      e.frames.size());
                };
                return rank(a) < rank(b);
            });
        if (entries.size() != 1 && (!found->placed || found->geometry.lattice.size().k < 2))
            throw Error(ErrorCode::unusable, because::othersMakeNoVolume(skipped.front().reason),
                        skipped.front().path);
        VolumeEntry rest = m_entry;
        rest.frames = found->frames;
        for (FrameReference &frame : rest.frames)
            frame = original.at(frame.path).at(std::size_t(frame.frame));
        rest.geometry = found->geometry;
        rest.placed = found->placed;
        rest.notes.placed = rest.placed;
        rest.notes.filled = found->notes.filled;
        // What was said of all slices no longer holds.
        std::erase_if(rest.notes.warnings,
                      [](const task::Reason &w) { return isOfStack(w) || isOfValues(w); });
        std::vector<const InstanceHeader *> headers;
        for (const SeriesFile &file : files)
            headers.push_back(&file.header);
        for (const task::Reason &warning : warningsOfValues(headers))
            rest.notes.warnings.push_back(warning);
        for (const Skipped &s : skipped)
            rest.notes.warnings.push_back(because::without(s.path.filename().string(), s.reason));
        for (const task::Reason &warning : found->notes.warnings)
            if (std::find(rest.notes.warnings.begin(), rest.notes.warnings.end(), warning) ==
                rest.notes.warnings.end())
                rest.notes.warnings.push_back(warning);
        if (!rest.placed)
            rest.notes.warnings.push_back(because::imagesOnly(*found->notPlacedReason));
        LoadedVolume loaded = loadVolume(rest, m_progress, m_observer);
        loaded.skipped.insert(loaded.skipped.begin(), skipped.begin(), skipped.end());
        return loaded;
    }

    const VolumeEntry &m_entry;
    const task::Progress &m_progress;
    const LoadObserver &m_observer;
    mutable std::atomic<bool> m_lacksMemory = false;
    std::map<std::filesystem::path, std::vector<std::size_t>> m_files;
    std::vector<std::filesystem::path> m_paths;
};

} // namespace

LoadedVolume loadVolume(const VolumeEntry &entry, const task::Progress &progress,
                        const LoadObserver &observer) {
    try {
        if (!entry.volumeFile.empty())
            return {decoder::readVolumeFile(entry.volumeFile, progress, entry.fileVolume), {}};
        return Assembly(entry, progress, observer).load();
    } catch (const std::bad_alloc &) {
        const volume::GridSize n = entry.geometry.lattice.size();
        throw Error(ErrorCode::outOfMemory, because::noMemoryForAVolume(n.i, n.j, n.k));
    }
}

} // namespace pellucid::dicom
