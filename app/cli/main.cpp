// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "app/cli/commands.h"
#include "app/cli/terminal.h"
#include "app/exit_code.h"
#include "core/confined/protection.h"
#include "core/confined/reasons.h"
#include "core/files/session_folder.h"
#include "core/files/user_folders.h"
#include "core/fourier/transforms/wisdom.h"
#include "core/platform/memory.h"
#include "core/platform/process.h"
#include "core/platform/terminal.h"
#include "core/task/error.h"
#include "core/task/progress.h"

namespace {

constexpr int cancelledExit = 130;

int report(const std::string &what, int code) {
    std::fprintf(stderr, "pellucid-cli: %s\n", pellucid::cli::printable(what).c_str());
    return code;
}

// Ctrl+C stops the running command cleanly instead of killing it half way.
std::stop_source &stopOnInterrupt() {
    static std::stop_source source;
    // A second request does not wait for a transform to finish.
    pellucid::platform::whenAskedToEnd([] { source.request_stop(); },
                                       [] { pellucid::platform::endAtOnce(cancelledExit); });
    return source;
}

int run(int argc, char **argv) {
    using namespace pellucid;
    platform::letLongFilesFail();
    platform::letBrokenPipesFail();
    const cli::Context context{stopOnInterrupt().get_token()};

    confined::whenUnprotected([isReported = false]() mutable {
        if (!std::exchange(isReported, true))
            cli::warn(task::Reason(task::because::systemDoesNotProtect).english());
    });
    // A killed program's unpacked files contain patient data.
    files::removeAbandonedSessionFolders();
    if (const auto cache = files::userCacheFolder())
        fourier::keepWisdomIn(*cache / "fftw-wisdom");

    CLI::App app("X-ray-like pictures of DICOM studies, by Fourier projection", "pellucid-cli");
    app.allow_windows_style_options(false); // a path may begin with a slash
    app.set_version_flag("--version", "pellucid-cli " PELLUCID_VERSION);
    app.require_subcommand(1);
    cli::addInfoCommand(app, context);
    cli::addRenderCommand(app, context);
    cli::addVolumeCommand(app, context);
    cli::addSegmentCommand(app, context);
    cli::addPresetCommand(app, context);
    cli::addPhantomCommand(app, context);
    cli::addServerCommand(app, context);
    cli::addFindCommand(app, context);
    cli::addGetCommand(app, context);
    cli::addSendCommand(app, context);
    cli::addListenCommand(app, context);
    cli::addBatchCommand(app, context);
    cli::addRecipeCommand(app, context);
    // CLI11 itself would only report that a subcommand is missing.
    const auto commands = app.get_subcommands([](const CLI::App *) { return true; });
    const auto known = [&](const std::string &word) {
        return word == "--help" || word == "-h" || word == "--version" ||
               std::any_of(commands.begin(), commands.end(),
                           [&](const CLI::App *c) { return c->get_name() == word; });
    };
    if (argc > 1 && !known(argv[1]))
        return report(
            std::string("unknown command '") + argv[1] +
                "': use info, render, volume, segment, preset, phantom, server, echo, find, "
                "get, transfers, send, listen, batch or recipe",
            exitCode(task::ErrorCode::usage));
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success &success) {
        return app.exit(success);
    }
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
        return report("cannot write to standard output", exitCode(task::ErrorCode::output));
    return 0;
}

} // namespace

int main(int argc, char **argv) {
    using namespace pellucid;
    platform::hideMemory();
    try {
        return run(argc, argv);
    } catch (const CLI::ParseError &error) {
        return report(error.what(), exitCode(task::ErrorCode::usage));
    } catch (const task::Error &error) {
        return report(error.what(), exitCode(error.code()));
    } catch (const task::Cancelled &) {
        return report("cancelled", cancelledExit);
    } catch (const std::exception &error) {
        return task::isLackOfMemory(error)
                   ? report("not enough memory", exitCode(task::ErrorCode::outOfMemory))
                   : report(std::string("internal error: ") + error.what(),
                            exitCode(task::ErrorCode::internal));
    }
}
