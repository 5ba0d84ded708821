// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
PELLUCID_REASON(implausibleReply, "the network helper sent implausible data")
PELLUCID_REASON(helperCannotStart, "the network helper cannot be started: %1")
PELLUCID_REASON(helperCrashed, "the network helper crashed")
PELLUCID_REASON(helperBrokeItsConfinement, "the server made the network helper attempt a forbidden system call")
PELLUCID_REASON(helperDoesNotAnswer, "the network helper does not answer")
PELLUCID_REASON(cannotConnect, "cannot connect: %1")
PELLUCID_REASON(serverIsBusy, "the server is busy")
PELLUCID_REASON(serverHasTooManyConnections, "the server does not accept more connections")
PELLUCID_REASON(serverHungUp, "the other side closed the connection")
PELLUCID_REASON(senderIsUnknown, "the sender %1 is not known")
PELLUCID_REASON(serverStatus, "%1 (%2)")
PELLUCID_REASON(serverStatusWithComment, "%1 (%2: %3)")
PELLUCID_REASON(serverLacksTheService, "the server does not support this kind of object or service")
PELLUCID_REASON(serverDoesNotAllowIt, "the server does not allow it")
PELLUCID_REASON(serverDoesNotTakeTheEncoding, "the server does not accept the encoding %1")
PELLUCID_REASON(serverDoesNotAcceptTheLogin, "the server does not accept the user name, password or token")
PELLUCID_REASON(serverHasNothingThere, "the server has nothing at this address; check the path of the service")
PELLUCID_REASON(serverAnswersHttp, "the server answers with HTTP status %1")
PELLUCID_REASON(loginCanBeRead, "without TLS, others on the network can read the password or token: use https or TLS, or allow it for this server (in the window: save it again; on the command line: server add with --allow-insecure-login)")
PELLUCID_REASON(loginHasExpired, "the login has expired; log in again")
PELLUCID_REASON(receiverNeedsAuthorities, "to receive with TLS, this program needs the certificates of the CAs that issued the senders' certificates (on the command line: --authorities)")
PELLUCID_REASON(serverListsTooMuch, "the server lists more than %1 entries")
PELLUCID_REASON(serverSays, "%1; the server reports: %2")
PELLUCID_REASON(wasCancelled, "was cancelled")
// clang-format on

} // namespace pellucid::task::because
