// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/login_client.h"

#include <span>

#include "core/exchange/reasons.h"
#include "core/network/login_json.h"
#include "core/network/reasons.h"

namespace pellucid::network {

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

LoginClient::LoginClient(const exchange::Peer &peer, Control &control)
    : m_path(peer.path), m_http(peer, control) {}

exchange::Endpoints LoginClient::discover() {
    const auto answer = m_http.perform(
        {.path = m_path, .accept = "application/json", .longestText = longestAnswer});
    requireInOrder(answer.status);
    if (answer.status != 200)
        throw Error(ErrorCode::unusable, because::issuerHasNoDescription);
    return readEndpoints(answer.text);
}

exchange::Tokens LoginClient::requestTokens(const exchange::TokenRequest &request) {
    const std::string form = exchange::formEncoded(request);
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

} // namespace pellucid::network
