// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/platform/channel.h"

namespace pellucid::network::process {

/// Loads the tables that a confined process could not open any more. *Throws* Error{internal}.
void prepareToServe();

/// Connects as the program asks, then answers its requests through the channel until it closes.
/// *Returns* the exit status.
int serve(const platform::Channel &channel);

} // namespace pellucid::network::process
