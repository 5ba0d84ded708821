// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/archive/instance_list.h"
#include "core/archive/object_folder.h"
#include "core/archive/server.h"
#include "core/task/progress.h"

namespace pellucid::archive {

/// How far a retrieval is.
struct RetrievalState {
    std::size_t wanted = 0;   ///< objects that the server has
    std::size_t present = 0;  ///< of them, here before
    std::size_t received = 0; ///< of them, now
    std::uint64_t bytes = 0;  ///< received now, also of incomplete objects
};

/// The result of a retrieval.
struct RetrievalReport {
    RetrievalState state;
    double seconds = 0.0;
    /// The missing objects, each with its reason.
    std::vector<RefusedObject> missing;
    /// Objects that came although nobody asked for them, or twice.
    std::size_t unwanted = 0;
    /// Objects here, received now or before, that name a patient who is not the one listed; and
    /// both, as the first of them shows.
    std::size_t ofAnotherPatient = 0;
    Patient listed, named;
    /// Objects that were here before and whose patient or date the server lists differently, and
    /// how, as the first of them shows: the archive has corrected them since. None if they were
    /// replaced.
    std::size_t corrected = 0;
    std::vector<Correction> corrections{};
    bool isComplete() const { return missing.empty(); }
};

/// Told from one thread at a time.
struct RetrievalObserver {
    std::function<void(const Listing &)> listed;
    std::function<void(const StoredObject &)> stored; ///< new ones
    /// An object, new or not, of the patient who is listed: it can be shown without a question.
    std::function<void(const StoredObject &)> matches;
    std::function<void(const RetrievalState &)> changed;
};

/// Where a server sends objects for C-MOVE: it must know this AE title with this computer's address
/// and port.
struct MoveDestination {
    std::string ae; ///< empty: that which this program calls the server by
    int port = defaultListenerPort;
    /// A listener of this program has the port, and stores what comes in the same folder.
    bool hasListener = false;
    /// A listener of this program has the port, with TLS switched differently.
    bool isTakenByOtherTls = false;
};

/// Retrieves the objects of a study that its folder does not have yet: compressed objects stay
/// compressed, series come from coarse to fine, over up to `Server::connections` connections, as
/// far as the server grants them and they save time. A connection that is lost is made again while
/// the others go on. The report lists the objects that never arrived. *Throws*
/// Error{unreachable} if nothing could be retrieved because the server cannot be reached, or
/// because the port of the destination is in use; as network::Link otherwise; Error{unusable,
/// loginHasExpired} if the user has to log in again; Error{output} if the folder cannot be written;
/// Cancelled. What has arrived stays in any case.
RetrievalReport retrieve(const Server &server, const Wanted &wanted, const ObjectFolder &folder,
                         const RetrievalObserver &observer = {},
                         const task::Progress &progress = {},
                         const MoveDestination &destination = {});

} // namespace pellucid::archive
