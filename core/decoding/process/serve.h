// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::decoding::process {

/// Gives up for good whatever decoding does not need: memory above what is free, files, processes,
/// the network, debuggers. *Shape*: the bits of confined::Confinement that are in force.
int confine();

/// Loads everything that decoding opens files for: dictionary, codecs, character tables. Call it
/// before `confine`. *Throws* Error{internal}.
void prepareToServe();

/// Answers the requests of a `decoding::Decoder` through the socket until it closes. *Shape*: the
/// exit status.
int serve(int socket, int arena, int confinement);

} // namespace pellucid::decoding::process
