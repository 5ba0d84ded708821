// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/platform/helper.h"

namespace pellucid::decoding::process {

/// Gives up for good whatever decoding does not need: memory above what is free, files, processes,
/// the network, debuggers. *Returns* the bits of platform::Confinement that are in force.
int confine();

/// Loads everything that decoding opens files for: dictionary, codecs, character tables. Call it
/// before `confine`. *Throws* Error{internal}.
void prepareToServe();

/// Answers the requests of a `decoding::Decoder` through the channel until it closes. *Returns* the
/// exit status.
int serve(platform::HelpersEnds ends, int confinement);

} // namespace pellucid::decoding::process
