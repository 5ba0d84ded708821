// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/task/reason.h"

namespace pellucid::network::process {

/// What a text of OpenSSL about a failed handshake, or about what follows it, means.
task::Reason tlsReason(const std::string &text);

/// The same for a server's certificate that is not accepted.
task::Reason certificateReason(const std::string &text);

} // namespace pellucid::network::process
