// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/confined/process.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

#include "core/files/spawn.h"
#include "core/files/user_folders.h"

namespace pellucid::confined {

namespace {

using platform::Handle;
using Clock = std::chrono::steady_clock;

constexpr int cancelPollMs = 20; // the longest wait after a cancel
constexpr std::chrono::milliseconds endPatience(500);

[[noreturn]] void fail(int error) {
    throw std::system_error(error, std::generic_category());
}

// Moves it above the numbers that the helper starts with, so that none of them is overwritten.
Handle aboveReserved(int fd) {
    Handle low(fd);
    Handle high(fd < 0 ? -1 : ::fcntl(fd, F_DUPFD_CLOEXEC, 10));
    if (!high)
        fail(errno);
    return high;
}

std::vector<std::string> environment(const std::vector<std::string> &more) {
    std::vector<std::string> names{"LD_LIBRARY_PATH", "DCMDICTPATH",   "ASAN_OPTIONS",
                                   "TSAN_OPTIONS",    "UBSAN_OPTIONS", "LLVM_PROFILE_FILE"};
    names.insert(names.end(), more.begin(), more.end());
    std::vector<std::string> kept;
    for (const std::string &name : names)
        if (const char *const value = std::getenv(name.c_str()))
            kept.push_back(name + "=" + value);
    return kept;
}

} // namespace

Process::Process(const Program &program) {
    std::array<int, 2> ends{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0)
        fail(errno);
    m_socket = aboveReserved(ends[0]);
    const Handle childSocket = aboveReserved(ends[1]);
    Handle file;
    if (program.file >= 0)
        file = aboveReserved(::fcntl(program.file, F_DUPFD_CLOEXEC, 10));

    const files::SpawnAttributes attributes;
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, childSocket.get(), socketDescriptor);
    if (file)
        ::posix_spawn_file_actions_adddup2(&actions, file.get(), fileDescriptor);
    ::posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
#ifndef PELLUCID_SANITIZED // sanitizers report there
    ::posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
#endif
    std::string name = program.path.string();
    const std::array<char *, 2> arguments{name.data(), nullptr};
    std::vector<std::string> variables = environment(program.environment);
    std::vector<char *> pointers;
    for (std::string &variable : variables)
        pointers.push_back(variable.data());
    pointers.push_back(nullptr);
    const int failed = ::posix_spawn(&m_pid, program.path.c_str(), &actions, attributes.get(),
                                     arguments.data(), pointers.data());
    ::posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) {
        m_pid = -1;
        fail(failed);
    }
}

Process::Process(Process &&other) noexcept
    : m_pid(std::exchange(other.m_pid, -1)), m_socket(std::move(other.m_socket)) {}

Process &Process::operator=(Process &&other) noexcept {
    std::swap(m_pid, other.m_pid);
    std::swap(m_socket, other.m_socket);
    return *this;
}

Process::~Process() {
    if (m_pid <= 0)
        return;
    ::kill(m_pid, SIGKILL);
    while (::waitpid(m_pid, nullptr, 0) < 0 && errno == EINTR) {
    }
}

std::optional<int> Process::endSignal() {
    if (m_pid <= 0) // it would be any child
        return 0;
    return statusWithin(endPatience);
}

void Process::endWithin(std::chrono::milliseconds patience) {
    m_socket = Handle();
    if (m_pid > 0)
        statusWithin(patience);
    *this = Process();
}

std::optional<int> Process::statusWithin(std::chrono::milliseconds patience) {
    int status = 0;
    const auto end = Clock::now() + patience;
    for (pid_t ended = 0; ended != m_pid;) {
        ended = ::waitpid(m_pid, &status, WNOHANG);
        if (ended < 0 && errno != EINTR)
            break;
        if (ended == 0 && Clock::now() > end)
            return std::nullopt;
        if (ended == 0)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    m_pid = -1;
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

bool waitForPacket(int socket, double seconds, const task::Progress &progress) {
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(seconds));
    for (;;) {
        progress.check();
        pollfd waiting{socket, POLLIN, 0};
        if (::poll(&waiting, 1, cancelPollMs) > 0)
            return true;
        if (Clock::now() > end)
            return false;
    }
}

std::filesystem::path findProgram(const char *name, const char *variable) {
    namespace fs = std::filesystem;
    if (const char *const named = std::getenv(variable))
        return named;
    const fs::path own = files::programFolder();
    std::error_code ignored;
    for (const char *const place : {".", "../libexec/pellucid", "../lib/pellucid", "../bin"})
        if (const fs::path program = own / place / name; fs::exists(program, ignored))
            return program;
    return own / name; // reported as missing when it is needed
}

} // namespace pellucid::confined
