// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/cli/input.h"
#include "app/cli/json_text.h"
#include "app/cli/reason_lines.h"
#include "app/cli/reasons.h"
#include "app/cli/servers.h"
#include "app/cli/terminal.h"
#include "core/archive/sending.h"
#include "core/task/error.h"
#include "core/task/naming.h"

namespace pellucid::cli {

namespace {

struct Options {
    std::string name;
    std::vector<std::string> paths;
    bool json = false;
};

void send(const Options &o, const Context &context) {
    const archive::Server server = serverNamed(o.name, context);
    const archive::SendingReport report = task::naming(server.name, [&] {
        return archive::send(server, {o.paths.begin(), o.paths.end()}, {},
                             task::Progress(context.stop));
    });
    if (o.json) {
        const auto jsonOf = [](const std::vector<dicom::Skipped> &files) {
            nlohmann::json all = nlohmann::json::array();
            for (const dicom::Skipped &file : files)
                all.push_back({{"path", file.path.string()}, {"reason", file.reason.english()}});
            return all;
        };
        std::puts(jsonText({{"files", report.state.files},
                            {"sent", report.state.sent},
                            {"bytes", report.state.bytes},
                            {"seconds", report.seconds},
                            {"uncompressed", report.uncompressed},
                            {"not_sent", jsonOf(report.notSent)},
                            {"with_changes", jsonOf(report.withChanges)},
                            {"left_out", jsonOf(report.leftOut)}})
                      .c_str());
    } else {
        const auto warnOf = [](const std::vector<dicom::Skipped> &files, const char *what) {
            std::vector<Named> named;
            for (const dicom::Skipped &file : files)
                named.push_back({file.path.string(), file.reason});
            for (const std::string &line : linesByReason(named, what))
                warn(line);
        };
        warnOf(report.notSent, "not sent");
        warnOf(report.withChanges, "sent");
        if (!report.leftOut.empty())
            warn(
                fmt::format("files of other kinds, which are not sent: {}", report.leftOut.size()));
        std::puts(printable(fmt::format("{} of {}; {}", report.state.sent, report.state.files,
                                        rateText(report.state.bytes, report.seconds)))
                      .c_str());
    }
    if (report.notSent.empty())
        return;
    std::set<std::string> reasons;
    for (const dicom::Skipped &file : report.notSent)
        reasons.insert(file.reason.english());
    const std::size_t count = report.notSent.size();
    throw task::Error(task::ErrorCode::incomplete,
                      reasons.size() > 1
                          ? task::because::filesNotSentForReasons(count, reasons.size())
                          : task::because::filesNotSent(count, report.notSent.front().reason),
                      server.name);
}

} // namespace

void addSendCommand(CLI::App &app, const Context &context) {
    auto o = std::make_shared<Options>();
    CLI::App *c = app.add_subcommand("send", "Send DICOM files to a server");
    c->add_option("NAME", o->name, "Name of the server")->required();
    c->add_option("PATH", o->paths, "Files, folders, DICOMDIRs and ZIP archives")->required();
    c->add_flag("--json", o->json, "Print a report as one JSON object");
    c->callback([o, context] { send(*o, context); });
}

} // namespace pellucid::cli
