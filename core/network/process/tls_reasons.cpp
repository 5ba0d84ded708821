// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/tls_reasons.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/network/process/reasons.h"

namespace pellucid::network::process {

namespace {

namespace because = task::because;

template <std::size_t N>
bool holdsAny(const std::string &text, const std::array<std::string_view, N> &signs) {
    return std::any_of(signs.begin(), signs.end(),
                       [&](std::string_view sign) { return text.find(sign) != std::string::npos; });
}

// The other side answers with something else, or hangs up.
constexpr std::array<std::string_view, 8> noTls{"wrong version number",
                                                "packet length too long",
                                                "http request",
                                                "unexpected eof",
                                                "I/O error",
                                                "SSL_ERROR_SYSCALL",
                                                "Connection reset",
                                                "record layer failure"};
constexpr std::array<std::string_view, 3> unknownAuthority{"self-signed", "issuer certificate",
                                                           "verify the first certificate"};

} // namespace

task::Reason tlsReason(const std::string &text) {
    if (text.find("certificate required") != std::string::npos)
        return because::serverNeedsACertificate;
    if (text.empty() || holdsAny(text, noTls))
        return because::tlsIsNotAnswered;
    return because::tlsFails(text);
}

task::Reason certificateReason(const std::string &text) {
    return holdsAny(text, unknownAuthority) ? because::certificateIsOfNoAuthority(text)
                                            : because::certificateIsRefused(text);
}

} // namespace pellucid::network::process
