// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/arriving_series.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <type_traits>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/decoding/client/decoder.h"
#include "core/dicom/modality_values.h"
#include "core/dicom/reasons.h"
#include "core/dicom/scan.h"
#include "core/system/memory.h"
#include "core/task/error.h"

namespace pellucid::dicom {

namespace {

namespace fs = std::filesystem;
namespace because = task::because;
using task::Error;
using task::ErrorCode;

// Fewer slices come in an instant, and every eighth of them shows nothing.
constexpr std::size_t leastToShow = 16;
// With fewer than every eighth slice, there is no projection, and one partial volume is enough.
constexpr std::size_t coarsestToProject = 8;

// A slice that is there.
struct Slice {
    std::size_t number = 0;
    fs::path path;
    glm::dvec3 positionMm{0.0};
    double depthMm = 0.0; ///< from the first slice that is there
};

// Sets the depths along the line through the slices at both ends. False if they do not lie on it in
// the order of their numbers. *Requires*: sorted by number; at least two.
bool sortsAlongALine(std::vector<Slice> &slices) {
    constexpr double tolerance = 0.25; // of the mean step
    const glm::dvec3 whole = slices.back().positionMm - slices.front().positionMm;
    const double length = glm::length(whole);
    const double limit = tolerance * length / double(slices.back().number - slices.front().number);
    if (!(length > 0.0))
        return false;
    double before = -length;
    for (Slice &slice : slices) {
        const glm::dvec3 from = slice.positionMm - slices.front().positionMm;
        slice.depthMm = glm::dot(from, whole) / length;
        if (slice.depthMm <= before || glm::distance(from, whole * slice.depthMm / length) > limit)
            return false;
        before = slice.depthMm;
    }
    return true;
}

// Even depths, in mm from the first slice that is there.
struct Depths {
    std::size_t count = 0;
    double firstMm = 0.0, stepMm = 0.0;
};

// The samples of slices at these depths, interpolated between those that are there; nothing if a
// value does not fit T.
template <class T>
std::optional<std::vector<T>>
interpolated(const std::vector<Slice> &slices, const Depths &depths, std::size_t plane,
             const ValueScale &scale, const DecodedFiles &decoded, const task::Progress &progress) {
    system::requireMemory(sizeof(T) * double(plane) * double(slices.size() + depths.count));
    std::vector<T> here(slices.size() * plane);
    std::atomic<bool> fits = true;
    tbb::parallel_for(std::size_t(0), slices.size(), [&](std::size_t n) {
        progress.check();
        volume::Narrowing ignored(plane);
        const auto file = decoded.find(slices[n].path);
        if (!file || !writeValues(*file, 0, scale, here.data() + n * plane, ignored))
            fits = false;
    });
    if (!fits)
        return std::nullopt;
    fillMissing(here);
    std::vector<T> all(depths.count * plane);
    const double stepMm = depths.stepMm;
    tbb::parallel_for(std::size_t(0), depths.count, [&](std::size_t k) {
        progress.check();
        constexpr double nearest = 1e-3; // of a step: written positions are rounded
        const double depthMm = depths.firstMm + stepMm * double(k);
        const auto above = std::find_if(slices.begin(), slices.end(), [&](const Slice &s) {
            return s.depthMm >= depthMm - nearest * stepMm;
        });
        const std::size_t upper = std::size_t(std::min(above, slices.end() - 1) - slices.begin());
        const bool isThere = slices[upper].depthMm <= depthMm + nearest * stepMm;
        const std::size_t lower = upper > 0 && !isThere ? upper - 1 : upper;
        const T *a = here.data() + lower * plane, *b = here.data() + upper * plane;
        T *const out = all.data() + k * plane;
        const double gapMm = slices[upper].depthMm - slices[lower].depthMm;
        const double weight = gapMm > 0.0 ? (depthMm - slices[lower].depthMm) / gapMm : 0.0;
        if (lower == upper) {
            std::copy(a, a + plane, out);
        } else if constexpr (std::is_integral_v<T>) {
            // In fixed point, which compilers vectorise. The largest difference of 16-bit values
            // times the largest weight just fits.
            constexpr int bits = 15;
            const auto share = std::int32_t(std::lrint(weight * (1 << bits)));
            for (std::size_t n = 0; n < plane; ++n)
                out[n] =
                    T(a[n] + (((std::int32_t(b[n]) - a[n]) * share + (1 << (bits - 1))) >> bits));
        } else {
            for (std::size_t n = 0; n < plane; ++n)
                out[n] = a[n] + float(weight) * (b[n] - a[n]);
        }
    });
    return all;
}

} // namespace

std::size_t finestStride(const std::vector<bool> &isHere) {
    if (isHere.empty() || !isHere.front() || !isHere.back())
        return 0;
    std::size_t stride = 1;
    for (std::size_t n = 0; n < isHere.size(); ++n)
        while (!isHere[n] && n % stride == 0)
            stride *= 2;
    return stride;
}

ArrivingSeries::ArrivingSeries(std::size_t count, std::size_t unlisted, bool mayHaveMore)
    : m_isHere(count), m_missing(count), m_unlisted(unlisted), m_mayHaveMore(mayHaveMore),
      m_paths(count), m_all(count + unlisted) {}

// With the lock held.
void ArrivingSeries::endIfComplete() {
    if (m_missing == 0 && m_unlisted == 0 && !m_mayHaveMore) {
        m_hasEnded = true;
        m_complete.request_stop();
    }
}

void ArrivingSeries::addUnlisted(const fs::path &path) {
    {
        const std::lock_guard lock(m_mutex);
        m_pending.emplace_back(count(), path);
        m_unlisted -= std::min<std::size_t>(1, m_unlisted);
        endIfComplete();
    }
    m_changed.notify_all();
}

void ArrivingSeries::add(std::size_t number, const fs::path &path) {
    {
        const std::lock_guard lock(m_mutex);
        if (m_isHere.at(number))
            return;
        m_isHere[number] = true;
        m_pending.emplace_back(number, path);
        --m_missing;
        endIfComplete();
    }
    m_changed.notify_all();
}

void ArrivingSeries::end() {
    {
        const std::lock_guard lock(m_mutex);
        m_hasEnded = true;
        m_complete.request_stop();
    }
    m_changed.notify_all();
}

// The files that came since; empty when all are decoded.
std::vector<ArrivingSeries::Arrival> ArrivingSeries::await(const task::Progress &progress) {
    constexpr std::chrono::milliseconds pause(20); // after a cancel
    std::unique_lock lock(m_mutex);
    while (m_pending.empty() && !m_hasEnded) {
        progress.check();
        m_changed.wait_for(lock, pause);
    }
    return std::exchange(m_pending, {});
}

void ArrivingSeries::decode(const std::vector<Arrival> &arrivals, const task::Progress &progress) {
    tbb::parallel_for(std::size_t(0), arrivals.size(), [&](std::size_t n) {
        progress.check();
        const fs::path &path = arrivals[n].second;
        try {
            m_decoded.keep(path, decoding::Decoder::shared().image(path, progress));
        } catch (const Error &error) {
            // It is read again with the others, which reports why.
            if (error.code() != ErrorCode::unusable && error.code() != ErrorCode::outOfMemory)
                throw;
        }
    });
    for (const auto &[number, path] : arrivals)
        if (number < count())
            m_paths[number] = path;
        else
            m_paths.push_back(path);
}

void ArrivingSeries::showPartial(std::size_t stride, const task::Progress &progress,
                                 const Show &show) const {
    std::map<fs::path, std::size_t> numbers;
    std::vector<fs::path> paths;
    for (std::size_t n = 0; n < count(); ++n)
        if (!m_paths[n].empty() && m_decoded.header(m_paths[n])) {
            numbers.emplace(m_paths[n], n);
            paths.push_back(m_paths[n]);
        }
    // Most gaps are slices that have yet to come.
    const Catalogue catalogue =
        scan(paths, progress, {.decoded = &m_decoded, .slices = Slices::arriving});
    if (catalogue.empty())
        return;
    const VolumeEntry &entry = *defaultSelection(catalogue).volume;
    std::vector<Slice> slices;
    for (const FrameReference &frame : entry.frames) {
        const auto header = m_decoded.header(frame.path);
        if (!entry.placed || !header || header->frames.size() != 1 ||
            !header->frames.front().positionMm)
            return;
        slices.push_back({numbers.at(frame.path), frame.path, *header->frames.front().positionMm});
    }
    std::sort(slices.begin(), slices.end(),
              [](const Slice &a, const Slice &b) { return a.number < b.number; });
    // Stacks are sorted along the normal of their slices, which numbers may run against.
    const volume::Lattice &found = entry.geometry.lattice;
    if (slices.size() < 2 || !sortsAlongALine(slices))
        return;
    const std::size_t count = slices.back().number - slices.front().number + 1;
    if (glm::dot(slices.back().positionMm - slices.front().positionMm, found.sliceNormal()) < 0.0) {
        std::reverse(slices.begin(), slices.end());
        const double length = slices.front().depthMm;
        for (Slice &slice : slices)
            slice.depthMm = length - slice.depthMm;
    }
    const double slicesMm = slices.back().depthMm / double(count - 1);
    const glm::dvec3 along =
        (slices.back().positionMm - slices.front().positionMm) / slices.back().depthMm;
    // The first slices are to be seen at once, and most of the time would be that of making room
    // for all of them. Viewers treat volumes of few slices differently.
    constexpr std::size_t leastPlanes = 48;
    const std::size_t planes =
        stride > coarsestToProject
            ? std::min(count, std::max(leastPlanes, (count - 1) / coarsestToProject + 1))
            : count;
    const double stepMm = slicesMm * double(count) / double(planes);
    const Depths depths{planes, 0.5 * (stepMm - slicesMm), stepMm};
    volume::GridSize size = found.size();
    size.k = int(planes);
    const volume::Lattice lattice =
        volume::Lattice::make(size, {slices.front().positionMm + along * depths.firstMm},
                              {found.step(0), found.step(1), along * stepMm});
    volume::VolumeNotes notes = entry.notes;
    notes.warnings = {because::slicesOfSeries(slices.size(), m_all)};
    const std::size_t plane = size.offsetOf(0, 0, 1);
    const ValueScale scale{entry.unit, entry.valueFactor};
    const auto deliver = [&](auto samples) {
        show({volume::Volume(lattice, std::move(samples), entry.unit, std::move(notes)),
              slices.size(), m_all, stride},
             progress);
    };
    if (auto whole = interpolated<std::int16_t>(slices, depths, plane, scale, m_decoded, progress))
        deliver(std::move(*whole));
    else if (auto real = interpolated<float>(slices, depths, plane, scale, m_decoded, progress))
        deliver(std::move(*real));
}

ArrivedSeries ArrivingSeries::load(const task::Progress &progress, const Show &show) {
    decoding::Decoder::shared().beginOpening();
    decoding::Decoder::shared().startAhead(2, progress); // the slices at both ends come first
    // Ends what is made of a part, when all is there.
    std::stop_source stop;
    const auto forward = [&stop] { stop.request_stop(); };
    const std::stop_callback cancelled(progress.stopToken(), forward);
    const std::stop_callback completed(m_complete.get_token(), forward);
    const task::Progress whileItArrives(stop.get_token());
    std::size_t shown = 0, done = 0;
    for (std::vector<Arrival> arrivals; !(arrivals = await(progress)).empty();) {
        decode(arrivals, progress);
        done += arrivals.size();
        progress.report(0.9 * double(done) / double(count()));
        std::vector<bool> isHere;
        for (std::size_t n = 0; n < count(); ++n)
            isHere.push_back(!m_paths[n].empty());
        const std::size_t stride = finestStride(isHere);
        const bool isFiner =
            stride > 0 && (shown == 0 || (stride < shown && stride <= coarsestToProject));
        if (!show || !isFiner || count() < leastToShow || stop.stop_requested())
            continue;
        shown = stride;
        try {
            showPartial(stride, whileItArrives, show);
        } catch (const task::Cancelled &) {
            progress.check(); // all is there
        } catch (const Error &error) {
            if (error.code() == ErrorCode::internal)
                throw;
        }
    }
    std::vector<fs::path> paths = m_paths;
    std::erase_if(paths, [](const fs::path &path) { return path.empty(); });
    if (paths.empty())
        throw Error(ErrorCode::unusable, because::holdsNoImages);
    // In the order of a folder: volumes are told apart by the order of files if by nothing else.
    std::sort(paths.begin(), paths.end());
    ArrivedSeries arrived;
    // Whoever retrieves a huge image wants it.
    arrived.catalogue = std::make_shared<const Catalogue>(
        scan(paths, progress.part(0.9, 0.92), {.includesHuge = true, .decoded = &m_decoded}));
    arrived.loaded = loadVolume(*defaultSelection(*arrived.catalogue).volume,
                                progress.part(0.92, 1.0), {}, &m_decoded);
    // A part of a series is never taken for all of it.
    const bool isPart = [&] {
        const std::lock_guard lock(m_mutex);
        return m_missing > 0 || m_unlisted > 0;
    }();
    if (isPart) {
        volume::VolumeNotes notes = arrived.loaded.volume.notes();
        notes.warnings.insert(
            notes.warnings.begin(),
            because::slicesOfSeries(paths.size(), std::max(m_all, paths.size() + 1)));
        arrived.loaded.volume = arrived.loaded.volume.withNotes(std::move(notes));
    }
    m_decoded.clear(); // whoever holds this object does not hold the volume twice
    return arrived;
}

} // namespace pellucid::dicom
