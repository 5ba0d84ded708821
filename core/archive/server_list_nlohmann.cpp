// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/archive/reasons.h"
#include "core/archive/server.h"
#include "core/files/atomic_file.h"
#include "core/files/json_value_nlohmann.h"
#include "core/files/read_text.h"
#include "core/files/user_folders.h"
#include "core/task/naming.h"
#include "core/task/reasons.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;
using files::JsonValue;
using network::Authentication;
using network::Peer;
using network::Protocol;
using Json = nlohmann::json;

constexpr const char *schema = "pellucid-servers/1";
constexpr std::size_t largestList = 4 << 20;

constexpr files::JsonWords<RetrieveMethod, 3> methods{{{"automatic", RetrieveMethod::automatic},
                                                       {"get", RetrieveMethod::get},
                                                       {"move", RetrieveMethod::move}}};
constexpr files::JsonWords<Authentication, 4> authentications{{{"none", Authentication::none},
                                                               {"basic", Authentication::basic},
                                                               {"bearer", Authentication::bearer},
                                                               {"oauth", Authentication::oauth}}};

struct LoginField {
    const char *name;
    std::string LoginSettings::*value;
};
constexpr LoginField loginFields[]{{"issuer", &LoginSettings::issuer},
                                   {"authorization_url", &LoginSettings::authorizationUrl},
                                   {"token_url", &LoginSettings::tokenUrl},
                                   {"client_id", &LoginSettings::clientId},
                                   {"scope", &LoginSettings::scope}};

Json toJson(const Server &server) {
    const Peer &peer = server.peer;
    Json json{{"name", server.name},
              {"address", addressOf(peer)},
              {"connections", server.connections},
              {"limit", server.limit}};
    if (peer.protocol == Protocol::dicom) {
        json["calling_ae"] = peer.callingAe;
        json["retrieve"] = files::wordFor(server.retrieve, methods);
        json["tls"] = peer.usesTls;
    }
    if (!server.sendsFrom.empty())
        json["sends_from"] = server.sendsFrom;
    if (!peer.authorities.empty())
        json["authorities"] = peer.authorities;
    if (!peer.certificate.empty()) {
        json["certificate"] = peer.certificate;
        json["key"] = peer.key;
    }
    if (peer.authentication != Authentication::none)
        json["authentication"] = files::wordFor(peer.authentication, authentications);
    for (const LoginField &field : loginFields)
        if (const std::string &value = server.loginSettings.*field.value; !value.empty())
            json["login"][field.name] = value;
    if (!peer.user.empty())
        json["user"] = peer.user;
    if (peer.allowsInsecureLogin)
        json["allow_insecure_login"] = true;
    if (!peer.characterSet.empty())
        json["character_set"] = peer.characterSet;
    if (server.mayUncompress)
        json["uncompress"] = true;
    return json;
}

std::string textOr(const JsonValue &value, const std::string &fallback) {
    return value ? value.text() : fallback;
}

Server fromJson(const JsonValue &json) {
    Server server;
    server.name = json.at("name").text();
    const JsonValue address = json.at("address");
    const std::string text = address.text();
    server.peer = address.checked([&] {
        return text.starts_with("http://") || text.starts_with("https://") ? webPeer(text)
                                                                           : dicomPeer(text);
    });
    Peer &peer = server.peer;
    peer.callingAe = textOr(json["calling_ae"], peer.callingAe);
    if (json["retrieve"])
        server.retrieve = json["retrieve"].meaning(methods);
    if (json["sends_from"])
        for (const JsonValue &host : json["sends_from"].elements())
            server.sendsFrom.push_back(host.text());
    if (json["tls"])
        peer.usesTls = json["tls"].boolean();
    if (json["connections"])
        server.connections = int(json["connections"].number(1000));
    if (json["limit"])
        server.limit = std::uint32_t(std::max(0.0, json["limit"].number(double(maxAnswers))));
    peer.authorities = textOr(json["authorities"], {});
    peer.certificate = textOr(json["certificate"], {});
    peer.key = textOr(json["key"], {});
    if (json["authentication"])
        peer.authentication = json["authentication"].meaning(authentications);
    for (const LoginField &field : loginFields)
        server.loginSettings.*field.value = textOr(json["login"][field.name], {});
    peer.user = textOr(json["user"], {});
    if (json["allow_insecure_login"])
        peer.allowsInsecureLogin = json["allow_insecure_login"].boolean();
    peer.characterSet = textOr(json["character_set"], {});
    if (json["uncompress"])
        server.mayUncompress = json["uncompress"].boolean();
    json.checked([&] { requireValid(server); });
    return server;
}

} // namespace

ServerList::ServerList(std::filesystem::path file) : m_file(std::move(file)) {
    std::error_code unknown;
    if (m_file.empty() || !std::filesystem::exists(m_file, unknown))
        return;
    task::naming(m_file, [&] {
        Json whole;
        try {
            whole = Json::parse(files::readText(m_file, largestList));
        } catch (const Json::exception &error) {
            throw task::Error(task::ErrorCode::usage,
                              because::isDamagedBy(files::jsonFault(error)));
        }
        const JsonValue json(whole);
        json.at("schema").checked([&] {
            if (json.at("schema").text() != schema)
                throw task::Error(task::ErrorCode::usage, because::isOfANewerVersion);
        });
        for (const JsonValue &each : json.at("servers").elements())
            m_servers.push_back(fromJson(each));
    });
}

ServerList ServerList::ofUser() {
    const auto data = files::userDataFolder();
    return ServerList(data ? *data / "servers.json" : std::filesystem::path());
}

const Server &ServerList::get(const std::string &name) const {
    for (const Server &server : m_servers)
        if (server.name == name)
            return server;
    throw task::Error(task::ErrorCode::usage, because::thereIsNoServer(name));
}

void ServerList::put(const Server &server) {
    requireValid(server);
    network::requireSecureLogin(server.peer);
    const auto same = std::find_if(m_servers.begin(), m_servers.end(),
                                   [&](const Server &one) { return one.name == server.name; });
    if (same != m_servers.end())
        *same = server;
    else
        m_servers.push_back(server);
    save();
}

void ServerList::remove(const std::string &name) {
    get(name);
    std::erase_if(m_servers, [&](const Server &one) { return one.name == name; });
    save();
}

void ServerList::save() const {
    if (m_file.empty())
        throw task::Error(task::ErrorCode::output, because::noFolderForData);
    Json servers = Json::array();
    for (const Server &server : m_servers)
        servers.push_back(toJson(server));
    files::AtomicFile file(m_file);
    file.write(Json{{"schema", schema}, {"servers", servers}}.dump(2) + "\n");
    file.commit();
}

} // namespace pellucid::archive
