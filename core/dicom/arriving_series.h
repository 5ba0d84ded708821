// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <utility>
#include <vector>

#include "core/dicom/catalogue.h"
#include "core/dicom/decoded_files.h"
#include "core/dicom/load_volume.h"
#include "core/task/progress.h"

namespace pellucid::dicom {

/// A volume with missing slices. It fills the same box as the whole, and has as many slices at
/// even distances, interpolated between those that are there; until every eighth is there, fewer if
/// the whole has many.
struct PartialVolume {
    volume::Volume volume; ///< its only warning says how much of it is there
    std::size_t slices = 0, count = 0;
    /// Every slice whose number is a multiple of this is there.
    std::size_t stride = 1;
};

/// A series, all of which is there.
struct ArrivedSeries {
    /// Of the series alone, as a scan of its files makes it.
    std::shared_ptr<const Catalogue> catalogue;
    /// The volume that is opened by default, as `loadVolume` loads it.
    LoadedVolume loaded;
};

/// A series whose files come one after the other, from coarse to fine. They are decoded as they
/// come, so that the volume is complete a moment after the last of them, and can be shown before.
class ArrivingSeries {
public:
    /// *Shape*: `count` files, which are numbered in the order of slices, as far as their sender
    /// knows it; and `unlisted` others, or more if nobody knows how many. *Requires*: at least one.
    explicit ArrivingSeries(std::size_t count, std::size_t unlisted = 0, bool mayHaveMore = false);

    std::size_t count() const { return m_isHere.size(); }
    /// A file is there. One that comes again is ignored. Thread-safe.
    void add(std::size_t number, const std::filesystem::path &path);
    /// The same for one whose place is not known. *Requires*: none comes twice.
    void addUnlisted(const std::filesystem::path &path);
    /// No other file comes. Thread-safe.
    void end();

    /// Receives what is there at first, and when every eighth, fourth and second slice is there.
    /// Its progress stops when the series is complete: then a partial volume is not needed.
    using Show = std::function<void(const PartialVolume &, const task::Progress &)>;
    /// Waits for all files, then assembles the volume of those that came, which says if some did
    /// not. Only series of single
    /// images that lie on a line in the order of their numbers are shown before. *Requires*: it is
    /// called once. *Throws* as `scan` and `loadVolume`; Error{unusable} if nothing came;
    /// Cancelled.
    ArrivedSeries load(const task::Progress &progress, const Show &show);

private:
    using Arrival = std::pair<std::size_t, std::filesystem::path>; ///< number and file
    void endIfComplete();
    std::vector<Arrival> await(const task::Progress &progress);
    void decode(const std::vector<Arrival> &arrivals, const task::Progress &progress);
    void showPartial(std::size_t stride, const task::Progress &progress, const Show &show) const;

    std::mutex m_mutex;
    std::condition_variable m_changed;
    std::vector<bool> m_isHere;        ///< by number
    std::size_t m_missing, m_unlisted; ///< files that have not come
    const bool m_mayHaveMore;
    std::vector<Arrival> m_pending; ///< not yet decoded
    bool m_hasEnded = false;
    std::stop_source m_complete;

    // Of the thread that loads.
    std::vector<std::filesystem::path> m_paths; ///< by number; empty: not there; then the unlisted
    std::size_t m_all;                          ///< files, unlisted ones too
    DecodedFiles m_decoded;
};

/// The smallest power of two such that every flag whose index is a multiple of it is set, and the
/// last flag is; 0 if there is none, not even the flags at both ends.
std::size_t finestStride(const std::vector<bool> &isHere);

} // namespace pellucid::dicom
