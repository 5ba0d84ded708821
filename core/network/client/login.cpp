// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/client/login.h"

#include <algorithm>
#include <arpa/inet.h>
#include <cerrno>
#include <netinet/in.h>
#include <sys/socket.h>

#include "core/network/client/query.h"
#include "core/network/client/reasons.h"
#include "core/task/error.h"

namespace pellucid::network {

LoopbackPort openLoopbackPort() {
    LoopbackPort opened{
        platform::Handle(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)), 0};
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof at;
    constexpr int waiting = 8; // browsers open connections that they may not use
    auto *const address = reinterpret_cast<sockaddr *>(&at);
    if (!opened.socket || ::bind(opened.socket.get(), address, size) != 0 ||
        ::listen(opened.socket.get(), waiting) != 0 ||
        ::getsockname(opened.socket.get(), address, &size) != 0)
        throw task::Error(task::ErrorCode::unreachable,
                          task::because::cannotConnect(task::systemReason(errno)));
    opened.port = ntohs(at.sin_port);
    return opened;
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
