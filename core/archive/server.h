// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/network/client/peer.h"
#include "core/network/client/query.h"

namespace pellucid::archive {

/// How objects come from a DICOM server: on the same association (C-GET), sent to this program's
/// own server (C-MOVE), or by what the server offers.
enum class RetrieveMethod { automatic, get, move };

class Login;

/// How the user logs in in the browser (OAuth 2.0, RFC 6749).
struct LoginSettings {
    std::string issuer; ///< describes the addresses; empty: both are given
    std::string authorizationUrl, tokenUrl;
    std::string clientId; ///< of this program at the login server
    std::string scope;    ///< empty: what the login server grants by default

    bool operator==(const LoginSettings &) const = default;
};

/// A server that the user has entered. Its secrets are not part of the list on disk.
struct Server {
    std::string name;
    network::Peer peer;
    RetrieveMethod retrieve = RetrieveMethod::automatic;
    /// Other hosts from which it sends what C-MOVE asks for, such as the nodes of a cluster.
    std::vector<std::string> sendsFrom{};
    int connections = 4;       ///< at once, 1 to 8: the most; see RetrievalWork::awaitNeed
    std::uint32_t limit = 200; ///< of answers to a search
    /// Whether compressed files are sent uncompressed if the server does not accept their encoding.
    bool mayUncompress = false;
    LoginSettings loginSettings{}; ///< for Authentication::oauth
    /// The source of its tokens, shared by all connections; with the secrets, not on disk.
    std::shared_ptr<Login> login{};

    bool operator==(const Server &) const = default;
};

inline constexpr int maxConnections = 8;
inline constexpr std::uint32_t maxAnswers = network::maxMatches;
inline constexpr int defaultDicomPort = 104, defaultListenerPort = 11112;

/// AET@HOST:PORT, the port being optional; an IPv6 address in brackets. *Throws* Error{usage}.
network::Peer dicomPeer(const std::string &address);
/// http://HOST:PORT/PATH or https://... *Throws* Error{usage}.
network::Peer webPeer(const std::string &url);
/// The peer at the URL of a login server. Its path contains the query. Only https, except at this
/// computer. *Throws* Error{usage}.
network::Peer loginPeer(const std::string &url);
/// The hosts from which a server may send.
std::vector<std::string> hostsOf(const Server &server);
/// The address as the user entered it.
std::string addressOf(const network::Peer &peer);
/// *Throws* Error{usage} if it is not an AE title.
void requireAeTitle(const std::string &title);
/// *Throws* Error{usage} with what is wrong.
void requireValid(const Server &server);

/// Whether a private key in PEM format has to be unlocked by a password. A file that cannot be read
/// is reported when it is used.
bool isEncryptedKey(const std::filesystem::path &file);

/// The user's servers, a JSON file in the user's folder, written as a whole.
class ServerList {
public:
    /// *Throws* Error{usage} with the place if the file is not such a list. A missing file is an
    /// empty list.
    explicit ServerList(std::filesystem::path file);
    static ServerList ofUser();

    const std::vector<Server> &servers() const { return m_servers; }
    /// *Throws* Error{usage} if there is none of that name.
    const Server &get(const std::string &name) const;
    /// Adds or replaces the server of that name, and saves. *Throws* Error{usage}, also for a login
    /// that others could read; Error{output}.
    void put(const Server &server);
    void remove(const std::string &name);

private:
    void save() const;

    std::filesystem::path m_file;
    std::vector<Server> m_servers;
};

} // namespace pellucid::archive
