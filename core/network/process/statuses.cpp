// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/statuses.h"

#include <fmt/format.h>

#include "core/network/client/reasons.h"
#include "core/network/process/reasons.h"

namespace pellucid::network::process {

namespace {

namespace because = task::because;

task::Reason meaning(std::uint16_t status) {
    switch (status) {
    case 0x0110:
        return because::serverHadAFailure;
    case 0x0117:
        return because::serverSaysInvalidInstance;
    case 0x0118:
    case 0x0122:
        return because::serverLacksTheService;
    case 0x0124:
        return because::serverDoesNotAllowIt;
    case 0x0211:
        return because::serverDoesNotKnowTheOperation;
    case 0x0213:
        return because::serverIsOutOfResources;
    case 0xa701:
        return because::serverCannotCountMatches;
    case 0xa702:
        return because::serverCannotSendMore;
    case 0xa801:
        return because::serverDoesNotKnowTheDestination;
    case 0xb000:
        return because::serverCouldNotSendAll;
    case 0xfe00:
        return because::wasCancelled;
    default:
        break;
    }
    switch (status & 0xff00) {
    case 0xa700:
        return because::serverIsOutOfResources;
    case 0xa900:
        return because::serverSaysTheDataDoNotMatch;
    default:
        return because::serverCannotProcessIt;
    }
}

std::string numberOf(std::uint16_t status) {
    return fmt::format("0x{:04X}", status);
}

} // namespace

task::Reason changeReason(std::uint16_t status) {
    return because::storedWithChanges(numberOf(status));
}

task::Reason statusReason(std::uint16_t status, const std::string &comment) {
    const std::string number = numberOf(status);
    return comment.empty() ? because::serverStatus(meaning(status), number)
                           : because::serverStatusWithComment(meaning(status), number, comment);
}

} // namespace pellucid::network::process
