// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::platform {

/// Makes sockets in advance, because a confined process cannot make any. From then on, `acceptFrom`
/// uses these, and *throws* std::system_error when all are used up.
void makeSpareSockets(int count);

} // namespace pellucid::platform
