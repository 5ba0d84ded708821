// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "core/task/reason.h"

namespace pellucid::network::process {

/// What a DIMSE status means, with its number and what the server adds in (0000,0902). PS3.7,
/// annex C; PS3.4, tables B.2-1, C.4-1, C.4-2, C.4-3.
task::Reason statusReason(std::uint16_t status, const std::string &comment);

/// What a warning of C-STORE means: the object is stored, but not as it was sent (PS3.4, table
/// B.2-1).
task::Reason changeReason(std::uint16_t status);

constexpr bool isPending(std::uint16_t status) {
    return status == 0xff00 || status == 0xff01;
}
constexpr bool isCancel(std::uint16_t status) {
    return status == 0xfe00;
}
/// B000 of a retrieval: some objects failed; of C-STORE: see changeReason.
constexpr bool isWarning(std::uint16_t status) {
    return (status & 0xf000) == 0xb000 || status == 0x0001 || status == 0x0107 || status == 0x0116;
}

/// B001 of a search: matches are left out, although the standard does not know it.
constexpr bool isLimitOfServer(std::uint16_t status) {
    return status == 0xb001;
}
constexpr bool isOutOfResources(std::uint16_t status) {
    return (status & 0xff00) == 0xa700;
}

} // namespace pellucid::network::process
