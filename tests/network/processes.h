// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cctype>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/types.h>
#include <system_error>
#include <unistd.h>
#include <vector>

/// What the system shows of processes (proc(5)). They may end at any time: what cannot be read is
/// empty.
namespace pellucid::test {

struct ProcessEntry {
    pid_t pid = 0, parent = 0;
    std::string name;
    char state = ' '; ///< 'Z': it has ended, and nobody has asked how
};

inline std::string textOfProcess(pid_t pid, const std::string &file) {
    std::ostringstream text;
    text << std::ifstream("/proc/" + std::to_string(pid) + "/" + file, std::ios::binary).rdbuf();
    return text.str();
}

inline std::vector<ProcessEntry> processes() {
    std::vector<ProcessEntry> all;
    std::error_code ignored;
    for (std::filesystem::directory_iterator each("/proc", ignored), last; each != last;
         each.increment(ignored)) {
        const std::string number = each->path().filename().string();
        if (number.empty() || std::isdigit((unsigned char)(number[0])) == 0)
            continue;
        ProcessEntry entry;
        entry.pid = pid_t(std::strtol(number.c_str(), nullptr, 10));
        const std::string status = textOfProcess(entry.pid, "stat");
        // The name, in parentheses, may contain anything.
        const auto begin = status.find('('), end = status.rfind(')');
        if (begin == std::string::npos || end == std::string::npos)
            continue;
        entry.name = status.substr(begin + 1, end - begin - 1);
        std::istringstream(status.substr(end + 1)) >> entry.state >> entry.parent;
        all.push_back(entry);
    }
    return all;
}

/// The network helpers that this process has started, and that run.
inline std::vector<pid_t> ownHelpers() {
    std::vector<pid_t> helpers;
    for (const ProcessEntry &entry : processes())
        if (entry.parent == ::getpid() && entry.name == "pellucid-net" && entry.state != 'Z')
            helpers.push_back(entry.pid);
    return helpers;
}

} // namespace pellucid::test
