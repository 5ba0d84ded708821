// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/servers.h"

#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "app/cli/reason_lines.h"
#include "app/cli/reasons.h"
#include "app/cli/terminal.h"
#include "core/archive/login.h"
#include "core/platform/process.h"
#include "core/task/error.h"
#include "core/task/naming.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;

void logIn(archive::Server &server, const Context &context) {
    server.login = std::make_shared<archive::Login>(server);
    const auto print = [&](const std::string &url) {
        fmt::print(stderr, "To log in to {}, open this address in a browser:\n{}\n",
                   printable(server.name), url);
    };
    task::naming(server.name, [&] { server.login->logIn(print, task::Progress(context.stop)); });
}

} // namespace

archive::Server serverNamed(const std::string &name, const Context &context) {
    return serversNamed({name}, context).front();
}

std::vector<archive::Server> serversNamed(const std::vector<std::string> &names,
                                          const Context &context) {
    const auto list = archive::ServerList::ofUser();
    std::vector<archive::Server> servers;
    for (const std::string &name : names) {
        archive::Server server = list.get(name);
        task::naming(name, [&] { network::requireSecureLogin(server.peer); }); // before asking
        if (server.peer.authentication == network::Authentication::basic)
            server.peer.secret = askHidden(
                fmt::format("Password of {} at {}: ", server.peer.user, server.name), context.stop);
        else if (server.peer.authentication == network::Authentication::bearer)
            server.peer.secret =
                askHidden(fmt::format("Token for {}: ", server.name), context.stop);
        else if (server.peer.authentication == network::Authentication::oauth)
            logIn(server, context);
        if (archive::isEncryptedKey(server.peer.key))
            server.peer.keyPassword =
                askHidden(fmt::format("Password of {}: ", server.peer.key), context.stop);
        servers.push_back(std::move(server));
    }
    return servers;
}

std::string rateText(std::uint64_t bytes, double seconds) {
    constexpr double perMegabyte = 1e6;
    const double megabytes = double(bytes) / perMegabyte;
    return seconds > 0.0 ? fmt::format("{:.1f} MB, {:.1f} MB/s", megabytes, megabytes / seconds)
                         : fmt::format("{:.1f} MB", megabytes);
}

archive::RetrievalReport watched(
    const std::function<archive::RetrievalReport(const archive::RetrievalObserver &)> &retrieve) {
    archive::RetrievalObserver observer;
    const bool isWatched = platform::isTerminal(stderr);
    if (isWatched)
        observer.changed = [](const archive::RetrievalState &state) {
            fmt::print(stderr, "\r{} of {}  {:.1f} MB ", state.present + state.received,
                       state.wanted, double(state.bytes) / 1e6);
        };
    const archive::RetrievalReport report = retrieve(observer);
    if (isWatched)
        std::fputs("\n", stderr);
    return report;
}

void warnOfObjects(const archive::RetrievalReport &report) {
    if (report.ofAnotherPatient > 0)
        warn(task::Reason(because::objectsAreOfAnotherPatient(report.ofAnotherPatient)).english());
    for (const archive::Correction &correction : report.corrections)
        warn(archive::reasonOf(correction).english());
    if (report.corrected > 0)
        warn(task::Reason(because::replaceTheCorrected(report.corrected)).english());
    std::vector<Named> lacking;
    for (const archive::RefusedObject &object : report.missing)
        lacking.push_back({object.sopInstanceUid, object.reason});
    for (const std::string &line : linesByReason(lacking, "not received"))
        warn(line);
}

void requireComplete(const archive::RetrievalReport &report, const std::string &server) {
    if (!report.isComplete())
        throw task::Error(
            task::ErrorCode::incomplete,
            because::objectsMissing(report.missing.size(), report.missing.front().reason), server);
}

} // namespace pellucid::cli
