// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/client/login.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "core/network/client/query.h"
#include "core/network/client/reasons.h"
#include "core/platform/socket.h"
#include "core/task/error.h"

namespace pellucid::network {

LoopbackPort openLoopbackPort() {
    constexpr int waiting = 8; // browsers open connections that they may not use
    try {
        auto [socket, port] =
            platform::listenOn("127.0.0.1", 0, waiting, platform::Accepting::neverWaits);
        return {std::move(socket), port};
    } catch (const std::system_error &error) {
        throw task::Error(task::ErrorCode::unreachable,
                          task::because::cannotConnect(task::systemReason(error.code())));
    }
}

bool isVisible(const std::string &text, std::size_t longest) {
    return !text.empty() && text.size() <= longest &&
           std::all_of(text.begin(), text.end(), [](char c) { return c > 0x20 && c < 0x7f; });
}

std::string formEncoded(const std::map<std::string, std::string> &fields) {
    std::string form;
    for (const auto &[name, value] : fields)
        form += (form.empty() ? "" : "&") + percentEncoded(name) + "=" + percentEncoded(value);
    return form;
}

} // namespace pellucid::network
