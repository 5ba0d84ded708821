// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/network/client/login.h"
#include "core/task/reason.h"

namespace pellucid::network::process {

/// The description of a login server (OpenID Connect Discovery 1.0, 3). *Throws* Error{unusable}.
Endpoints readEndpoints(const std::string &json);

/// The answer to a request for tokens (RFC 6749, 5.1). *Throws* Error{unusable}.
Tokens readTokens(const std::string &json);

/// The error code of a refused request (RFC 6749, 5.2); empty if there is none.
std::string readError(const std::string &json);

/// The reason for an error code of a login server (RFC 6749, 4.1.2.1 and 5.2). Only codes of the
/// standards appear in it: anything else could contain a secret.
task::Reason loginRefusal(const std::string &error);

} // namespace pellucid::network::process
