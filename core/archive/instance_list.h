// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/archive/object_folder.h"
#include "core/archive/server.h"
#include "core/network/client/query.h"
#include "core/task/progress.h"

namespace pellucid::archive {

/// An object of a study, as a server lists it.
struct Instance {
    std::string studyUid, seriesUid, sopInstanceUid;
    std::string sopClassUid; ///< empty if unknown
    int number = 0;          ///< 0 if unknown
};

/// Names a study, or some series of it.
struct Wanted {
    std::string studyUid;
    std::vector<std::string> seriesUids;
    Patient patient{}; ///< the one shown to the user; if unknown, the server is asked
    Existing existing = Existing::stays; ///< of objects of which the server lists corrected data
};

/// A series of which a server lists less than it has, as far as it says.
struct ShortSeries {
    std::string studyUid, seriesUid; ///< no series: the study
    std::size_t unlisted = 0;        ///< objects, as the server counts them
    std::size_t invalid = 0;         ///< of them, listed with an invalid UID
    bool mayHaveMore = false; ///< the server has a limit, and does not say how many there are
};

/// Each takes about 800 bytes while it is retrieved. The largest studies have a tenth of that.
inline constexpr std::size_t maxObjectsOfStudy = 100000;

/// A study as a server lists it.
struct Listing {
    /// Series by series, that with the most objects first, each in the order of slices.
    std::vector<Instance> instances;
    Patient patient; ///< unknown if the server does not report it
    std::string studyDate;
    std::vector<ShortSeries> shortSeries;
};

/// *Throws* as network::Link; Error{unusable} if the server has none of it, or lists more objects
/// than a study may have.
Listing listInstances(const Server &server, const Wanted &wanted,
                      const task::Progress &progress = {});

/// The indices 0 to n - 1 from coarse to fine: the ends, the middle, quarters, eighths ... After an
/// eighth of them, every eighth is there.
std::vector<std::size_t> coarseToFine(std::size_t n);

} // namespace pellucid::archive
