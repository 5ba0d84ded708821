// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/commands.h"
#include "app/cli/input.h"
#include "app/cli/terminal.h"
#include "core/archive/listener.h"
#include "core/archive/reasons.h"
#include "core/archive/receiving.h"
#include "core/archive/refused_connections.h"
#include "core/archive/run_transfer.h"
#include "core/task/error.h"

namespace pellucid::cli {

namespace {

namespace fs = std::filesystem;

struct Options {
    archive::ListenerOptions listener;
    std::string folder;
    bool isForLibrary = false, allowsUnprotected = false;
};

// Every DICOM server of the list may send.
std::vector<archive::Sender> knownSenders() {
    std::vector<archive::Sender> senders;
    const auto list = archive::ServerList::ofUser();
    for (const archive::Server &server : list.servers())
        if (server.peer.protocol == network::Protocol::dicom)
            for (const std::string &host : archive::hostsOf(server))
                senders.push_back({server.peer.calledAe, host});
    return senders;
}

void listen(Options o, const Context &context) {
    requireProtection("listen", o.allowsUnprotected);
    if (!o.listener.acceptsAnyone) {
        o.listener.senders = knownSenders();
        if (o.listener.senders.empty())
            throw task::Error(task::ErrorCode::usage, task::because::noSenderIsKnown);
    }
    const archive::ObjectFolder folder(o.isForLibrary
                                           ? archive::libraryObjectFolder()
                                           : fs::absolute(o.folder.empty() ? "." : o.folder),
                                       archive::ObjectFolder::Durability::synced);
    folder.create();
    std::optional<archive::TransferLog> log;
    if (o.isForLibrary)
        log.emplace(archive::TransferLog::fileOfUser());
    archive::Receiving receiving(folder, log ? &*log : nullptr,
                                 {{}, [](const archive::RefusedObject &object) {
                                      warn(object.sopInstanceUid +
                                           ": not stored: " + object.reason.english());
                                  }});
    std::map<std::string, std::size_t> stored; // by sender
    archive::RefusedConnections refused;
    const archive::Listener listener(
        o.listener, [&] { return receiving.receiver(); }, {[&](const archive::ConnectionEnd &end) {
            const std::string sender =
                end.sender == end.address ? end.address : end.sender + " at " + end.address;
            if (end.reason && refused.isNew(end.address, *end.reason))
                warn(sender + ": " + end.reason->english());
            if (end.refused && refused.isNew(end.address, *end.refused))
                warn(sender + ": " + end.refused->english());
            if (end.stored == 0)
                return;
            std::size_t &count = stored[sender];
            count += end.stored;
            fmt::print("{}: {} stored so far\n", printable(sender), count);
            std::fflush(stdout);
        }});
    fmt::print("{} listens on {}port {}\n", o.listener.ae,
               o.listener.address.empty() ? "" : o.listener.address + ", ", listener.port());
    std::fflush(stdout);
    while (!context.stop.stop_requested()) {
        if (const auto summary = refused.summary())
            warn(summary->english());
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
}

} // namespace

void addListenCommand(CLI::App &app, const Context &context) {
    auto o = std::make_shared<Options>();
    CLI::App *c = app.add_subcommand(
        "listen", "Receive what the known servers send, until interrupted (C-STORE)");
    CLI::Option *to =
        c->add_option("--to", o->folder, "Folder to write to; default: the current one");
    c->add_flag("--library", o->isForLibrary, "Add what arrives to the library of the workstation")
        ->excludes(to);
    c->add_option("--address", o->listener.address,
                  "Address of this computer to receive on; default: all of them");
    c->add_option("--port", o->listener.port, "Port; default 11112; 0: any free one")
        ->check(CLI::Range(0, 65535));
    c->add_option("--ae", o->listener.ae, "AE title of this program; default PELLUCID");
    c->add_flag("--any", o->listener.acceptsAnyone, "Accept anyone, not only the known servers");
    CLI::Option *certificate = c->add_option("--certificate", o->listener.certificate,
                                             "Use TLS with this certificate, in PEM format")
                                   ->check(CLI::ExistingFile);
    CLI::Option *key =
        c->add_option("--key", o->listener.key, "Private key of the certificate, in PEM format")
            ->check(CLI::ExistingFile)
            ->needs(certificate);
    CLI::Option *authorities =
        c->add_option(
             "--authorities", o->listener.authorities,
             "CA certificates with TLS; a sender's certificate must be issued by one and name "
             "its host or address")
            ->check(CLI::ExistingFile)
            ->needs(certificate);
    certificate->needs(key);
    certificate->needs(authorities);
    addProtectionOption(*c, o->allowsUnprotected);
    c->callback([o, context] {
        o->listener.usesTls = !o->listener.certificate.empty();
        listen(*o, context);
    });
}

} // namespace pellucid::cli
