// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::network::process {

/// Loads the tables that a confined process could not open any more. *Throws* Error{internal}.
void prepareToServe();

/// Connects as the program asks, then answers its requests through the socket until it closes.
/// *Returns* the exit status.
int serve(int socket);

} // namespace pellucid::network::process
