// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/login_client.h"

#include <span>

#include "core/network/client/reasons.h"
#include "core/network/process/login_json.h"
#include "core/network/process/reasons.h"

namespace pellucid::network::process {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

constexpr std::size_t longestAnswer = 256 << 10;

// A server that is out of order is asked again later.
void requireInOrder(long status) {
    if (status == 408 || status == 429 || status == 503)
        throw Lost{because::serverIsBusy};
    if (status >= 500)
        throw Lost{because::serverAnswersHttp(status)};
}

} // namespace

LoginClient::LoginClient(const Peer &peer, Control &control)
    : m_path(peer.path), m_http(peer, control) {}

Endpoints LoginClient::discover() {
    const auto answer = m_http.perform(
        {.path = m_path, .accept = "application/json", .longestText = longestAnswer});
    requireInOrder(answer.status);
    if (answer.status != 200)
        throw Error(ErrorCode::unusable, because::issuerHasNoDescription);
    return readEndpoints(answer.text);
}

Tokens LoginClient::requestTokens(const TokenRequest &request) {
    const std::string form = formEncoded(request);
    const auto answer = m_http.perform({.path = m_path,
                                        .accept = "application/json",
                                        .contentType = "application/x-www-form-urlencoded",
                                        .body = {std::as_bytes(std::span(form))},
                                        .longestText = longestAnswer});
    requireInOrder(answer.status);
    if (answer.status == 200)
        return readTokens(answer.text);
    const std::string error = readError(answer.text);
    const auto refresh = request.find("grant_type");
    if (error == "invalid_grant" && refresh != request.end() && refresh->second == "refresh_token")
        throw Error(ErrorCode::unusable, because::loginHasExpired);
    throw Error(ErrorCode::unusable, error.empty()
                                         ? task::Reason(because::serverAnswersHttp(answer.status))
                                         : loginRefusal(error));
}

} // namespace pellucid::network::process
