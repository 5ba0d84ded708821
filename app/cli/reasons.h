// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Servers on the network
PELLUCID_REASON(thereIsNoTransfer, "there is no transfer %1")
PELLUCID_REASON(objectsMissing, "%1 not received: %2")
PELLUCID_REASON(filesNotSent, "%1 not sent: %2")
PELLUCID_REASON(filesNotSentForReasons, "%1 not sent, for %2 reasons")
PELLUCID_REASON(notAllServersAnswered, "not all servers answered")
PELLUCID_REASON(objectsAreOfAnotherPatient, "%1 objects name a patient other than the one that the server lists")
PELLUCID_REASON(listMayBeShort, "the server has reached its limit: the list may be incomplete; narrow the search")
PELLUCID_REASON(entriesHaveNoUid, "entries without a valid UID, which cannot be opened: %1")
PELLUCID_REASON(replaceTheCorrected, "the server has corrected %1 objects since they were received; use 'get --replace' to retrieve them again")
PELLUCID_REASON(passwordNeedsATerminal, "a password is needed, and there is no terminal to ask for it")

// The decoding process
PELLUCID_REASON(systemDoesNotProtectUnattended, "%1; %2 runs only with --allow-unprotected")

// Looks, classes and presets
PELLUCID_REASON(classAwaitsPoints, "the class '%1' needs a point in the patient; set it with --point '%1=x,y,z'")

// Recipes
PELLUCID_REASON(noStudyMatches, "no study matches")
PELLUCID_REASON(onlyResultsAreThere, "all its studies are in the folder of results (--out), which is not searched")
// clang-format on

} // namespace pellucid::task::because
