// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/network/process/association.h"

namespace pellucid::network::process {

// The requests of a client (PS3.4, annexes A to C). All *throw* Lost if the connection fails,
// Error{unusable} with the server's status if it refuses, Disconnected, CancelledByProgram after
// the server has ended the request or two seconds have passed.

void echo(Association &association, Control &control);
/// Sends a `match` for each answer.
QueryEnd find(Association &association, const Query &query, Control &control);
/// C-GET: the objects come on the same association, each as `Storage`.
RetrievalEnd get(Association &association, const Retrieval &retrieval, Control &control);
/// C-MOVE: the objects come to the server of the destination.
RetrievalEnd move(Association &association, const Retrieval &retrieval, Control &control);
/// C-STORE of an open file of this size: its data set goes out byte for byte. *Returns* how
/// the server changed the object; nothing if it stored it unchanged.
std::optional<task::Reason> store(Association &association, platform::HandleView file,
                                  std::uint64_t bytes, Control &control);

/// Answers a client until it releases the association: C-ECHO, and C-STORE as `Storage`.
void provide(Association &association, Control &control);

} // namespace pellucid::network::process
