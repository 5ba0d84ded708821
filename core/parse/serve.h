// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::parse {

/// Gives up all that decoding does not need: memory above what there is, files, processes, the
/// network, debuggers. *Shape*: bits of decoder::Confinement that hold. For good.
int confine();

/// Loads what decoding opens files for: dictionary, codecs, tables of characters. Before `confine`.
/// *Throws* Error{internal}.
void prepareToServe();

/// Answers what a `decoder::Decoder` asks through the socket until it goes away. *Shape*: the exit
/// status.
int serve(int socket, int arena, int confinement);

} // namespace pellucid::parse
