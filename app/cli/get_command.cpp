// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/cli/json_text.h"
#include "app/cli/reasons.h"
#include "app/cli/servers.h"
#include "app/cli/terminal.h"
#include "core/archive/reasons.h"
#include "core/archive/run_transfer.h"
#include "core/task/error.h"
#include "core/task/naming.h"

namespace pellucid::cli {

namespace {

namespace fs = std::filesystem;
using archive::RetrievalReport;
using archive::Transfer;
using archive::TransferLog;
using archive::TransferState;

struct Options {
    std::string name, folder;
    archive::Wanted wanted;
    archive::MoveDestination destination;
    std::int64_t id = 0;
    bool isForLibrary = false, json = false, replaces = false;
};

nlohmann::json jsonOf(const RetrievalReport &report, const fs::path &folder) {
    nlohmann::json missing = nlohmann::json::array();
    for (const archive::RefusedObject &object : report.missing)
        missing.push_back(
            {{"instance_uid", object.sopInstanceUid}, {"reason", object.reason.english()}});
    return {{"folder", folder.string()},       {"wanted", report.state.wanted},
            {"present", report.state.present}, {"received", report.state.received},
            {"bytes", report.state.bytes},     {"seconds", report.seconds},
            {"unwanted", report.unwanted},     {"of_another_patient", report.ofAnotherPatient},
            {"corrected", report.corrected},   {"missing", missing}};
}

// "509 of 512, 100 of them already present; 42.0 MB, 8.4 MB/s"
std::string summaryOf(const RetrievalReport &report) {
    const std::size_t here = report.state.present + report.state.received;
    std::string text = fmt::format("{} of {}", here, report.state.wanted);
    if (report.state.present > 0)
        text += fmt::format(", {} of them already present", report.state.present);
    return text + "; " + rateText(report.state.bytes, report.seconds);
}

void run(TransferLog &log, std::int64_t id, const Options &o, const Context &context) {
    const Transfer transfer = log.transfer(id).value();
    const archive::Server server = serverNamed(transfer.server, context);
    const RetrievalReport report = task::naming(server.name, [&] {
        return watched([&](const archive::RetrievalObserver &observer) {
            return archive::runTransfer(
                log, id, server, observer, task::Progress(context.stop), o.destination, {},
                o.replaces ? archive::Existing::isReplaced : archive::Existing::stays);
        });
    });
    if (o.json) {
        std::puts(jsonText(jsonOf(report, transfer.folder)).c_str());
    } else {
        warnOfObjects(report);
        std::puts(printable(summaryOf(report)).c_str());
    }
    requireComplete(report, server.name);
}

void get(const Options &o, const Context &context) {
    if (!network::isUid(o.wanted.studyUid))
        throw task::Error(task::ErrorCode::usage, task::because::isNoUid(o.wanted.studyUid));
    for (const std::string &uid : o.wanted.seriesUids)
        if (!network::isUid(uid))
            throw task::Error(task::ErrorCode::usage, task::because::isNoUid(uid));
    archive::ServerList::ofUser().get(o.name); // before anything is written
    Transfer transfer;
    transfer.server = o.name;
    transfer.wanted = o.wanted;
    transfer.folder = o.isForLibrary ? archive::libraryObjectFolder()
                                     : fs::absolute(o.folder.empty() ? "." : o.folder);
    TransferLog log(TransferLog::fileOfUser());
    run(log, log.add(transfer), o, context);
}

const char *nameOf(TransferState state) {
    switch (state) {
    case TransferState::waiting:
        return "waiting";
    case TransferState::running:
        return "running";
    case TransferState::complete:
        return "complete";
    case TransferState::incomplete:
        return "incomplete";
    case TransferState::cancelled:
        return "cancelled";
    }
    return "";
}

void list(const Options &o) {
    const TransferLog log(TransferLog::fileOfUser());
    nlohmann::json out = nlohmann::json::array();
    for (const Transfer &t : log.transfers()) {
        const auto reason = task::Reason::decoded(t.reason);
        const std::string why = reason ? reason->english() : "";
        if (o.json)
            out.push_back({{"id", t.id},
                           {"server", t.server},
                           {"study_uid", t.wanted.studyUid},
                           {"series_uids", t.wanted.seriesUids},
                           {"folder", t.folder.string()},
                           {"state", nameOf(t.state)},
                           {"wanted", t.total},
                           {"received", t.received},
                           {"bytes", t.bytes},
                           {"seconds", t.seconds},
                           {"created", t.created},
                           {"reason", why}});
        else
            std::puts(printable(fmt::format("{:>4}  {:<10}  {} of {}  {}  {}  {}{}", t.id,
                                            nameOf(t.state), t.received, t.total,
                                            rateText(t.bytes, t.seconds), t.server,
                                            t.wanted.studyUid, why.empty() ? "" : "  " + why))
                          .c_str());
    }
    if (o.json)
        std::puts(jsonText(out).c_str());
}

Transfer known(TransferLog &log, std::int64_t id) {
    if (const auto transfer = log.transfer(id))
        return *transfer;
    throw task::Error(task::ErrorCode::usage, task::because::thereIsNoTransfer(id));
}

} // namespace

void addGetCommand(CLI::App &app, const Context &context) {
    auto o = std::make_shared<Options>();
    CLI::App *c =
        app.add_subcommand("get", "Retrieve a study from a server; if repeated with the same "
                                  "destination, retrieve only missing objects");
    c->add_option("NAME", o->name, "Name of the server")->required();
    c->add_option("--study", o->wanted.studyUid, "UID of the study")->required();
    c->add_option("--series", o->wanted.seriesUids, "UIDs of series; default: all of the study");
    CLI::Option *to =
        c->add_option("--to", o->folder, "Folder to write to; default: the current one");
    c->add_flag("--library", o->isForLibrary, "Add the study to the library of the workstation")
        ->excludes(to);
    c->add_option("--port", o->destination.port, "Local port for C-MOVE; default 11112")
        ->check(CLI::Range(1, 65535));
    c->add_option("--ae", o->destination.ae,
                  "AE title of this program for C-MOVE; default: the one in the list of servers");
    c->add_flag("--replace", o->replaces,
                "Retrieve received objects again if the server has since corrected the name, ID, "
                "birth date or study date");
    c->add_flag("--json", o->json, "Print a report as one JSON object");
    c->callback([o, context] { get(*o, context); });

    auto t = std::make_shared<Options>();
    CLI::App *transfers = app.add_subcommand("transfers", "List, retry and cancel retrievals");
    transfers->require_subcommand(1);
    CLI::App *all = transfers->add_subcommand("list", "List the retrievals, one per line");
    all->add_flag("--json", t->json, "Print a JSON array");
    all->callback([t] { list(*t); });
    CLI::App *retry = transfers->add_subcommand("retry", "Retrieve only what is missing");
    retry->add_option("ID", t->id, "Number of the retrieval, as listed")->required();
    retry->add_flag("--json", t->json, "Print a report as one JSON object");
    retry->callback([t, context] {
        TransferLog log(TransferLog::fileOfUser());
        known(log, t->id);
        run(log, t->id, *t, context);
    });
    CLI::App *cancel =
        transfers->add_subcommand("cancel", "Stop a retrieval; what has arrived stays");
    cancel->add_option("ID", t->id, "Number of the retrieval, as listed")->required();
    cancel->callback([t] {
        TransferLog log(TransferLog::fileOfUser());
        if (known(log, t->id).state <= TransferState::running)
            log.cancel(t->id);
    });
}

} // namespace pellucid::cli
