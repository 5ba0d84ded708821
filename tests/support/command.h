// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>

#include "tests/support/temporary_folder.h"

namespace pellucid::test {

/// The exit code and the output of a command.
struct CommandResult {
    int exitCode = -1; ///< 128 + signal if it was killed
    std::string out, error;
};

/// Runs a shell command line.
inline CommandResult run(const std::string &command) {
    const TemporaryFolder folder;
    const std::string full = "(" + command + ") >'" + (folder / "out").string() + "' 2>'" +
                             (folder / "err").string() + "' </dev/null";
    const int status = std::system(full.c_str());
    const auto read = [](const std::filesystem::path &path) {
        std::ostringstream text;
        text << std::ifstream(path).rdbuf();
        return text.str();
    };
    CommandResult result;
    result.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    result.out = read(folder / "out");
    result.error = read(folder / "err");
    return result;
}

} // namespace pellucid::test
