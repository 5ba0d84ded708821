// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/cli/json_text.h"
#include "app/cli/servers.h"
#include "app/cli/terminal.h"
#include "core/archive/login.h"
#include "core/archive/server.h"
#include "core/network/client/link.h"
#include "core/task/error.h"
#include "core/task/naming.h"
#include "core/task/reasons.h"

namespace pellucid::cli {

namespace {

using archive::Server;
using network::Authentication;
using network::Step;

// The words of options and of JSON.
constexpr std::array methods{std::pair("automatic", archive::RetrieveMethod::automatic),
                             std::pair("get", archive::RetrieveMethod::get),
                             std::pair("move", archive::RetrieveMethod::move)};
constexpr std::array authentications{
    std::pair("none", Authentication::none), std::pair("basic", Authentication::basic),
    std::pair("bearer", Authentication::bearer), std::pair("oauth", Authentication::oauth)};

template <class Words> auto meaningOf(const std::string &given, const Words &words) {
    for (const auto &[word, meaning] : words)
        if (given == word)
            return meaning;
    return words.front().second;
}

template <class T, class Words> const char *wordFor(T value, const Words &words) {
    for (const auto &[word, meaning] : words)
        if (meaning == value)
            return word;
    return "";
}

struct Options {
    std::string name, dicom, web, tls = "off", authorities, certificate, key,
                                  callingAe = "PELLUCID", retrieve = "automatic",
                                  authentication = "none", user, set;
    std::vector<std::string> sendsFrom;
    archive::LoginSettings login;
    int connections = 4;
    std::uint32_t limit = 200;
    bool json = false, uncompress = false, allowsInsecureLogin = false;
};

// The program may be started in another folder the next time.
std::string absolute(const std::string &path) {
    return path.empty() ? path : std::filesystem::absolute(path).string();
}

void add(const Options &o) {
    Server server;
    server.name = o.name;
    server.peer = o.dicom.empty() ? archive::webPeer(o.web) : archive::dicomPeer(o.dicom);
    network::Peer &peer = server.peer;
    peer.callingAe = o.callingAe;
    if (!o.dicom.empty())
        peer.usesTls = o.tls == "on";
    peer.authorities = absolute(o.authorities);
    peer.certificate = absolute(o.certificate);
    peer.key = absolute(o.key);
    peer.user = o.user;
    peer.characterSet = o.set;
    peer.authentication = meaningOf(o.authentication, authentications);
    peer.allowsInsecureLogin = o.allowsInsecureLogin;
    // An association would be negotiated without the token.
    if (!o.dicom.empty() && peer.authentication == Authentication::bearer)
        throw task::Error(
            task::ErrorCode::usage,
            task::because::inWords("--authentication bearer is for DICOMweb servers only"));
    server.loginSettings = o.login;
    server.retrieve = meaningOf(o.retrieve, methods);
    server.sendsFrom = o.sendsFrom;
    server.connections = o.connections;
    server.limit = o.limit;
    server.mayUncompress = o.uncompress;
    auto list = archive::ServerList::ofUser();
    list.put(server);
    std::puts(printable(fmt::format("{}: {}", server.name, archive::addressOf(peer))).c_str());
}

// All settings; never a secret.
nlohmann::json jsonOf(const Server &server) {
    const network::Peer &peer = server.peer;
    const archive::LoginSettings &login = server.loginSettings;
    return {{"name", server.name},
            {"address", archive::addressOf(peer)},
            {"tls", peer.usesTls},
            {"calling_ae", peer.callingAe},
            {"retrieve", wordFor(server.retrieve, methods)},
            {"sends_from", server.sendsFrom},
            {"connections", server.connections},
            {"limit", server.limit},
            {"uncompress", server.mayUncompress},
            {"character_set", peer.characterSet},
            {"authentication", wordFor(peer.authentication, authentications)},
            {"user", peer.user},
            {"allow_insecure_login", peer.allowsInsecureLogin},
            {"login",
             {{"issuer", login.issuer},
              {"authorization_url", login.authorizationUrl},
              {"token_url", login.tokenUrl},
              {"client_id", login.clientId},
              {"scope", login.scope}}},
            {"authorities", peer.authorities},
            {"certificate", peer.certificate},
            {"key", peer.key}};
}

// Its settings that differ from the default.
std::string lineOf(const Server &server) {
    const network::Peer &peer = server.peer;
    const Server usual;
    std::string line = fmt::format("{:<20}  {}", server.name, archive::addressOf(peer));
    const auto add = [&](bool differs, const std::string &text) {
        if (differs)
            line += "  " + text;
    };
    add(peer.usesTls && peer.protocol == network::Protocol::dicom, "TLS");
    add(peer.callingAe != usual.peer.callingAe, "calling AE " + peer.callingAe);
    add(server.retrieve != usual.retrieve,
        std::string("retrieve ") + wordFor(server.retrieve, methods));
    add(!server.sendsFrom.empty(), fmt::format("sends from {}", fmt::join(server.sendsFrom, ", ")));
    add(server.connections != usual.connections,
        counted(std::size_t(server.connections), "connection"));
    add(server.limit != usual.limit,
        server.limit == 0 ? "no limit" : fmt::format("limit {}", server.limit));
    add(server.mayUncompress, "uncompress");
    add(!peer.characterSet.empty(), "character set " + peer.characterSet);
    add(peer.authentication != Authentication::none,
        std::string("authentication ") + wordFor(peer.authentication, authentications));
    add(!peer.user.empty(), "user " + peer.user);
    add(peer.allowsInsecureLogin, "insecure login allowed");
    add(!peer.authorities.empty(), "authorities " + peer.authorities);
    add(!peer.certificate.empty(), "certificate " + peer.certificate);
    return line;
}

void list(const Options &o) {
    const auto servers = archive::ServerList::ofUser().servers();
    if (o.json) {
        nlohmann::json out = nlohmann::json::array();
        for (const Server &server : servers)
            out.push_back(jsonOf(server));
        std::puts(jsonText(out).c_str());
        return;
    }
    for (const Server &server : servers)
        std::puts(printable(lineOf(server)).c_str());
}

const char *nameOf(Step step) {
    switch (step) {
    case Step::name:
        return "name";
    case Step::tcp:
        return "TCP";
    case Step::tls:
        return "TLS";
    case Step::association:
        return "association";
    case Step::refused: // of a client
    case Step::service:
        return "offers";
    }
    return "";
}

// Prints each step as it succeeds; the one that fails is the error.
void test(const Options &o, const Context &context, bool isVerbose) {
    const Server server = serverNamed(o.name, context);
    const task::Progress progress(context.stop);
    const auto print = [&](Step step, const std::string &found) {
        if (isVerbose)
            std::puts(printable(fmt::format("{:<12} {}", nameOf(step), found)).c_str());
    };
    task::naming(server.name, [&] {
        archive::withLogin(server, progress, [&](const network::Peer &peer) {
            network::Link link(network::Connection{peer, network::Purpose::echo}, progress, print);
            link.echo(progress, print);
        });
    });
    if (!isVerbose)
        std::puts(printable(fmt::format("{} answers", server.name)).c_str());
}

} // namespace

void addServerCommand(CLI::App &app, const Context &context) {
    auto o = std::make_shared<Options>();
    CLI::App *c = app.add_subcommand("server", "Add, list, test and remove servers");
    c->require_subcommand(1);
    CLI::App *put = c->add_subcommand("add", "Add a server, or replace the one of the same name");
    put->add_option("NAME", o->name, "Name of the server")->required();
    CLI::Option *dicom = put->add_option("--dicom", o->dicom, "AET@HOST:PORT of a DICOM server");
    CLI::Option *web =
        put->add_option("--web", o->web, "URL of a DICOMweb service")->excludes(dicom);
    dicom->excludes(web);
    put->add_option("--tls", o->tls,
                    "TLS for a DICOM server; default off. For a DICOMweb service, the URL decides "
                    "(http or https)")
        ->check(CLI::IsMember({"off", "on"}))
        ->excludes(web);
    put->add_option("--authorities", o->authorities,
                    "Certificates of the authorities that are trusted, in PEM format; default: "
                    "those of the system")
        ->check(CLI::ExistingFile);
    CLI::Option *certificate =
        put->add_option("--certificate", o->certificate, "Client certificate, in PEM format")
            ->check(CLI::ExistingFile);
    CLI::Option *key =
        put->add_option("--key", o->key, "Private key of the certificate, in PEM format")
            ->check(CLI::ExistingFile)
            ->needs(certificate);
    certificate->needs(key);
    put->add_option("--calling-ae", o->callingAe,
                    "AE title of this program for a DICOM server; default PELLUCID")
        ->excludes(web);
    put->add_option("--retrieve", o->retrieve,
                    "How objects of a DICOM server are retrieved; default automatic")
        ->check(CLI::IsMember({"automatic", "get", "move"}))
        ->excludes(web);
    put->add_option("--sends-from", o->sendsFrom,
                    "Other hosts from which a DICOM server sends what C-MOVE asks for, such as the "
                    "nodes of a cluster")
        ->delimiter(',')
        ->excludes(web);
    put->add_option(
           "--authentication,--login", o->authentication,
           "How this program authenticates itself; default none; bearer: by a token; oauth: "
           "by a login in the browser (both for DICOMweb)")
        ->check(CLI::IsMember({"none", "basic", "bearer", "oauth"}));
    put->add_option("--issuer", o->login.issuer,
                    "Issuer URL for oauth; the two endpoints are discovered from it")
        ->excludes(dicom);
    put->add_option("--authorization-url", o->login.authorizationUrl,
                    "Authorization endpoint, if there is no issuer")
        ->excludes(dicom);
    put->add_option("--token-url", o->login.tokenUrl, "Token endpoint, if there is no issuer")
        ->excludes(dicom);
    put->add_option("--client-id", o->login.clientId,
                    "ID that the login server has for this program")
        ->excludes(dicom);
    put->add_option("--scope", o->login.scope, "Scopes to request, such as 'openid offline_access'")
        ->excludes(dicom);
    put->add_option("--user", o->user, "User name for basic authentication");
    put->add_flag("--allow-insecure-login", o->allowsInsecureLogin,
                  "Send the password or token without TLS, although others on the network can read "
                  "it");
    put->add_option("--character-set", o->set,
                    "Character set, such as 'ISO_IR 100', if a DICOM server's answers "
                    "name none")
        ->excludes(web);
    put->add_option("--connections", o->connections,
                    "Maximum number of simultaneous connections, 1 to 8; default 4")
        ->check(CLI::Range(1, archive::maxConnections));
    put->add_option("--limit", o->limit, "Maximum number of results; default 200; 0: no limit");
    put->add_flag("--uncompress", o->uncompress,
                  "Decompress files whose encoding a DICOM server does not accept")
        ->excludes(web);
    put->callback([o] {
        if (o->dicom.empty() == o->web.empty())
            throw CLI::RequiredError("--dicom or --web");
        add(*o);
    });
    CLI::App *all = c->add_subcommand("list", "List the servers");
    all->add_flag("--json", o->json, "Print a JSON array");
    all->callback([o] { list(*o); });
    CLI::App *check =
        c->add_subcommand("test", "Connect step by step, and report the step that fails");
    check->add_option("NAME", o->name, "Name of the server")->required();
    check->callback([o, context] { test(*o, context, true); });
    CLI::App *remove = c->add_subcommand("remove", "Remove a server from the list");
    remove->add_option("NAME", o->name, "Name of the server")->required();
    remove->callback([o] { archive::ServerList::ofUser().remove(o->name); });

    auto e = std::make_shared<Options>();
    CLI::App *echo = app.add_subcommand("echo", "Ask whether a server answers");
    echo->add_option("NAME", e->name, "Name of the server")->required();
    echo->callback([e, context] { test(*e, context, false); });
}

} // namespace pellucid::cli
