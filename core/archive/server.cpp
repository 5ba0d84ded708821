// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/server.h"

#include <algorithm>
#include <charconv>
#include <fstream>

#include "core/archive/reasons.h"
#include "core/network/client/login.h"
#include "core/platform/socket.h"
#include "core/task/error.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;

[[noreturn]] void fail(const task::Reason &reason) {
    throw task::Error(task::ErrorCode::usage, reason);
}

int portIn(const std::string &text) {
    int port = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
    if (error != std::errc() || end != text.data() + text.size() || port < 1 || port > 65535)
        fail(because::isNoPort(text));
    return port;
}

// "pacs", "pacs:104", "[2001:db8::7]:104" (RFC 3986, 3.2.2). Without a port, that of the peer
// stays.
void takeHostAndPort(network::Peer &peer, const std::string &text) {
    const auto bracket = text.starts_with('[') ? text.find(']') : std::string::npos;
    const auto colon = text.find(':', bracket == std::string::npos ? 0 : bracket);
    if (bracket != std::string::npos && std::min(colon, text.size()) != bracket + 1)
        fail(because::isNoHost(text));
    if (colon != std::string::npos)
        peer.port = portIn(text.substr(colon + 1));
    peer.host = bracket == std::string::npos ? text.substr(0, colon) : text.substr(1, bracket - 1);
}

// A name, or an address; only one of IPv6 contains colons.
bool isHost(const std::string &text) {
    return !text.empty() && text.find_first_of(" /@?#[]\"\\") == std::string::npos &&
           (text.find(':') == std::string::npos ||
            platform::addressKind(text) == platform::AddressKind::ipv6);
}

void requireValidLogin(const Server &server) {
    const LoginSettings &login = server.loginSettings;
    if (server.peer.protocol != network::Protocol::web)
        fail(because::loginIsForDicomWeb);
    if (!network::isPrivate(server.peer))
        fail(because::loginNeedsHttps);
    const bool hasUrls = !login.authorizationUrl.empty() && !login.tokenUrl.empty(),
               hasUrl = !login.authorizationUrl.empty() || !login.tokenUrl.empty();
    if (login.issuer.empty() ? !hasUrls : hasUrl)
        fail(because::loginNeedsAddresses);
    for (const std::string *const url : {&login.issuer, &login.authorizationUrl, &login.tokenUrl})
        if (!url->empty())
            loginPeer(*url);
    // RFC 6749, A.1 and A.4
    constexpr std::size_t longest = 1000;
    if (!network::isVisible(login.clientId, longest))
        fail(because::isNoClientId(login.clientId));
    std::string words = login.scope;
    std::erase(words, ' ');
    if (!login.scope.empty() &&
        (!network::isVisible(words, longest) || words.find_first_of("\"\\") != std::string::npos))
        fail(because::isNoScope(login.scope));
}

} // namespace

network::Peer dicomPeer(const std::string &address) {
    const auto at = address.find('@');
    if (at == std::string::npos)
        fail(because::isNoDicomAddress(address));
    network::Peer peer;
    peer.calledAe = address.substr(0, at);
    peer.port = defaultDicomPort;
    takeHostAndPort(peer, address.substr(at + 1));
    requireAeTitle(peer.calledAe);
    if (!isHost(peer.host))
        fail(because::isNoDicomAddress(address));
    return peer;
}

network::Peer webPeer(const std::string &url) {
    network::Peer peer;
    peer.protocol = network::Protocol::web;
    const std::string secure = "https://", plain = "http://";
    std::string rest;
    if (url.starts_with(secure)) {
        peer.usesTls = true;
        peer.port = 443;
        rest = url.substr(secure.size());
    } else if (url.starts_with(plain)) {
        peer.port = 80;
        rest = url.substr(plain.size());
    } else {
        fail(because::isNoWebAddress(url));
    }
    const auto slash = rest.find('/');
    peer.path = slash == std::string::npos ? "" : rest.substr(slash);
    while (!peer.path.empty() && peer.path.back() == '/')
        peer.path.pop_back();
    takeHostAndPort(peer, rest.substr(0, slash));
    // A name and a password in the address would end in logs and files.
    if (!isHost(peer.host) || peer.path.find_first_of(" ?#") != std::string::npos)
        fail(because::isNoWebAddress(url));
    return peer;
}

network::Peer loginPeer(const std::string &url) {
    // Paths of login servers keep a slash at their end and a query, which others do not have.
    const auto host = url.find("://");
    const auto path = host == std::string::npos ? host : url.find_first_of("/?", host + 3);
    network::Peer peer;
    try {
        peer = webPeer(url.substr(0, path));
    } catch (const task::Error &) {
        fail(because::isNoLoginAddress(url));
    }
    peer.path = path == std::string::npos ? "/" : url.substr(path);
    if (peer.path.front() == '?')
        peer.path.insert(0, "/");
    if (!network::isPrivate(peer) || !network::isVisible(url, network::longestUrl) ||
        url.find_first_of("#\"<>\\^`{|}") != std::string::npos)
        fail(because::isNoLoginAddress(url));
    return peer;
}

std::vector<std::string> hostsOf(const Server &server) {
    std::vector<std::string> hosts{server.peer.host};
    hosts.insert(hosts.end(), server.sendsFrom.begin(), server.sendsFrom.end());
    return hosts;
}

std::string addressOf(const network::Peer &peer) {
    if (peer.protocol == network::Protocol::dicom)
        return peer.calledAe + "@" + network::hostPart(peer.host) + ":" + std::to_string(peer.port);
    const int usual = peer.usesTls ? 443 : 80;
    return (peer.usesTls ? "https://" : "http://") + network::hostPart(peer.host) +
           (peer.port == usual ? "" : ":" + std::to_string(peer.port)) + peer.path;
}

// PS3.5, table 6.2-1: at most 16 characters, no backslash, no control characters, not blank.
void requireAeTitle(const std::string &title) {
    if (title.empty() || title.size() > 16 || title.find('\\') != std::string::npos ||
        title.find_first_not_of(' ') == std::string::npos ||
        std::any_of(title.begin(), title.end(),
                    [](char c) { return (unsigned char)(c) < 0x20 || (unsigned char)(c) > 0x7e; }))
        fail(because::isNoAeTitle(title));
}

void requireValid(const Server &server) {
    if (server.name.empty() || server.name.size() > 64 ||
        std::any_of(server.name.begin(), server.name.end(),
                    [](char c) { return (unsigned char)(c) < 0x20; }))
        fail(because::isNoServerName(server.name));
    if (server.peer.protocol == network::Protocol::dicom)
        requireAeTitle(server.peer.calledAe);
    requireAeTitle(server.peer.callingAe);
    for (const std::string &host : server.sendsFrom)
        if (!isHost(host))
            fail(because::isNoHost(host));
    if (server.connections < 1 || server.connections > maxConnections)
        fail(because::connectionsAreOutOfRange(maxConnections));
    if (server.limit > maxAnswers)
        fail(because::answersAreOutOfRange(maxAnswers));
    if (server.peer.certificate.empty() != server.peer.key.empty())
        fail(because::certificateNeedsItsKey);
    if (server.peer.authentication == network::Authentication::oauth)
        requireValidLogin(server);
}

bool isEncryptedKey(const std::filesystem::path &file) {
    std::ifstream in(file, std::ios::binary);
    std::string start(4096, '\0');
    in.read(start.data(), std::streamsize(start.size()));
    start.resize(std::size_t(in.gcount()));
    return start.find("ENCRYPTED") != std::string::npos;
}

} // namespace pellucid::archive
