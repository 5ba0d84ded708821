// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/filter.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sstream>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include "core/platform/posix/spawn.h"

namespace pellucid::platform {

// With a socket as standard input, which reports an end without a signal.
Filter::Filter(const std::filesystem::path &program, const std::vector<std::string> &arguments,
               const MarkedFolder &folder, const std::string &messages) {
    std::array<int, 2> ends{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw std::system_error(errno, std::generic_category());
    m_input = Handle(ends[0], Opened::socket);
    const Handle childInput(ends[1], Opened::socket);
    ::fcntl(m_input.get(), F_SETFL, O_NONBLOCK);

    std::vector<std::string> words{program.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char *> pointers;
    for (std::string &word : words)
        pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const SpawnAttributes attributes;
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, childInput.get(), 0);
    ::posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_addfchdir_np(&actions, folder.view().get());
    ::posix_spawn_file_actions_addopen(&actions, 2, messages.c_str(), O_WRONLY | O_CREAT, 0600);
    const int failed = ::posix_spawn(&m_process, program.c_str(), &actions, attributes.get(),
                                     pointers.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (failed != 0)
        throw std::system_error(failed, std::generic_category());
}

Filter::~Filter() {
    if (m_process <= 0)
        return;
    ::kill(m_process, SIGKILL);
    while (::waitpid(m_process, nullptr, 0) < 0 && errno == EINTR) {
    }
}

std::size_t Filter::write(std::span<const std::byte> bytes, int milliseconds) {
    const ssize_t sent = ::send(m_input.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent > 0)
        return std::size_t(sent);
    if (sent < 0 && errno != EAGAIN && errno != EINTR)
        throw std::system_error(errno, std::generic_category());
    pollfd writable{m_input.get(), POLLOUT, 0};
    ::poll(&writable, 1, milliseconds);
    return 0;
}

std::optional<bool> Filter::ended() {
    int status = 0;
    if (m_process > 0 && ::waitpid(m_process, &status, WNOHANG) != m_process)
        return std::nullopt;
    m_process = -1;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::filesystem::path findOnSearchPath(const std::string &name) {
    const char *const path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
        const auto program = std::filesystem::absolute(std::filesystem::path(folder) / name);
        if (::access(program.c_str(), X_OK) == 0)
            return program;
    }
    return {};
}

} // namespace pellucid::platform
