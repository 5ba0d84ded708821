// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/archive/retrieval.h"
#include "core/archive/transfer_log.h"

namespace pellucid::archive {

/// Where objects that belong to the library are stored, below the user's data.
std::filesystem::path libraryObjectFolder();

/// Does a transfer of the log, and records how far it came, so that it is continued after a kill.
/// Stops if the transfer is cancelled in the log, by any program. Objects for the library are
/// recorded as arrivals. A transfer of which the server has nothing, and nothing has ever arrived,
/// is removed from the log. `listed`: the patient whom the user was shown, and `existing`, see
/// Wanted, which the log does not keep. *Throws* as `retrieve`; Error{usage} if another program is
/// doing it.
RetrievalReport runTransfer(TransferLog &log, std::int64_t id, const Server &server,
                            const RetrievalObserver &observer = {},
                            const task::Progress &progress = {},
                            const MoveDestination &destination = {}, const Patient &listed = {},
                            Existing existing = Existing::stays);

} // namespace pellucid::archive
