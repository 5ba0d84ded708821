// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::network {

/// Loads everything that talking to a server opens files for. *Throws* Error{internal}.
void prepareToServe();

/// Connects as the program asks, then answers its requests through the socket until it closes.
/// *Shape*: the exit status.
int serve(int socket);

} // namespace pellucid::network
