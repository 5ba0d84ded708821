// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/cli/input.h"
#include "app/cli/json_text.h"
#include "app/cli/servers.h"
#include "app/cli/terminal.h"
#include "core/archive/sending.h"
#include "core/dicom/file_list.h"
#include "core/task/error.h"
#include "core/task/naming.h"

namespace pellucid::cli {

namespace {

namespace fs = std::filesystem;

struct Options {
    std::string name;
    std::vector<std::string> paths;
    bool json = false;
};

// The files named, and those in folders named.
std::vector<fs::path> filesAt(const std::vector<std::string> &paths) {
    std::vector<fs::path> files;
    for (const fs::path path : paths) {
        std::error_code failed;
        if (!fs::exists(path, failed))
            throw task::Error(task::ErrorCode::unusable, task::because::doesNotExist, path);
        if (!fs::is_directory(path, failed)) {
            files.push_back(path);
            continue;
        }
        for (const auto &entry : fs::recursive_directory_iterator(path))
            if (entry.is_regular_file() && entry.path().filename().string()[0] != '.')
                files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

void send(const Options &o, const Context &context) {
    const archive::Server server = serverNamed(o.name);
    const archive::SendingReport report = task::naming(server.name, [&] {
        return archive::send(server, filesAt(o.paths), {}, task::Progress(context.stop));
    });
    if (o.json) {
        nlohmann::json notSent = nlohmann::json::array();
        for (const dicom::Skipped &file : report.notSent)
            notSent.push_back({{"path", file.path.string()}, {"reason", file.reason.english()}});
        std::puts(jsonText({{"files", report.state.files},
                            {"sent", report.state.sent},
                            {"bytes", report.state.bytes},
                            {"seconds", report.seconds},
                            {"not_sent", notSent}})
                      .c_str());
    } else {
        for (const dicom::Skipped &file : report.notSent)
            warn(file.path.string() + ": not sent: " + file.reason.english());
        std::puts(printable(fmt::format("{} of {}; {}", report.state.sent, report.state.files,
                                        rateText(report.state.bytes, report.seconds)))
                      .c_str());
    }
    if (!report.notSent.empty())
        throw task::Error(
            task::ErrorCode::incomplete,
            task::because::filesNotSent(report.notSent.size(), report.notSent.front().reason),
            server.name);
}

} // namespace

void addSendCommand(CLI::App &app, const Context &context) {
    auto o = std::make_shared<Options>();
    CLI::App *c = app.add_subcommand("send", "Send DICOM files to a server");
    c->add_option("NAME", o->name, "Name of the server")->required();
    c->add_option("PATH", o->paths, "Files, and folders with files")->required();
    c->add_flag("--json", o->json, "Print a report as one JSON object");
    c->callback([o, context] { send(*o, context); });
}

} // namespace pellucid::cli
