// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/connect.h"

#include <system_error>

#include "core/network/client/reasons.h"
#include "core/network/process/association.h"
#include "core/network/process/reasons.h"

namespace pellucid::network::process {

namespace because = task::because;

platform::Connected connectTo(const Peer &peer, Control &control) {
    const std::vector<std::string> addresses = platform::addressesOf(peer.host);
    if (addresses.empty())
        throw Lost{because::hostIsUnknown(peer.host)};
    control.step(Step::name, addresses.front());
    std::error_code error;
    for (const std::string &address : addresses)
        try {
            return {platform::connectTo(address, peer.port, peer.connectSeconds), address};
        } catch (const std::system_error &failure) {
            error = failure.code();
        }
    if (error == std::errc::connection_refused)
        throw Lost{because::connectionIsRefused};
    if (error == std::errc::timed_out)
        throw Lost{because::hostDoesNotAnswer};
    throw Lost{because::cannotConnect(task::systemReason(error))};
}

} // namespace pellucid::network::process
