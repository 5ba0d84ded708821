// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/helper.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

#include "core/platform/posix/spawn.h"

namespace pellucid::platform {

namespace {

using Clock = std::chrono::steady_clock;

// The numbers of the files that a helper starts with.
constexpr int channelNumber = 3, fileNumber = 4;
constexpr std::chrono::milliseconds endPatience(500);

[[noreturn]] void fail(int error) {
    throw std::system_error(error, std::generic_category());
}

// Moves it above the numbers that the helper starts with, so that none of them is overwritten.
Handle aboveReserved(HandleView low) {
    Handle high(low ? ::fcntl(low.get(), F_DUPFD_CLOEXEC, 10) : -1);
    if (!high)
        fail(errno);
    return high;
}

std::vector<std::string> keptEnvironment() {
    std::vector<std::string> kept;
    for (const char *const name : {"LD_LIBRARY_PATH", "DCMDICTPATH", "ASAN_OPTIONS", "TSAN_OPTIONS",
                                   "UBSAN_OPTIONS", "LLVM_PROFILE_FILE"})
        if (const char *const value = std::getenv(name))
            kept.push_back(std::string(name) + "=" + value);
    return kept;
}

Ending::How howOf(int signal) {
    switch (signal) {
    case SIGPROF:
        return Ending::How::tookTooLong;
    case SIGBUS:
        return Ending::How::lostAFile;
    case SIGKILL:
        return Ending::How::wasKilled;
    case SIGSYS:
        return Ending::How::brokeConfinement;
    default:
        return Ending::How::crashed;
    }
}

} // namespace

Helper::Helper(const std::filesystem::path &program, HandleView file) {
    const auto [own, other] = makeChannel();
    m_channel = Channel(aboveReserved(own.end()));
    const Handle channel = aboveReserved(other.end());
    Handle given;
    if (file)
        given = aboveReserved(file);

    const SpawnAttributes attributes;
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, channel.get(), channelNumber);
    if (given)
        ::posix_spawn_file_actions_adddup2(&actions, given.get(), fileNumber);
    ::posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
#ifndef PELLUCID_SANITIZED // sanitizers report there
    ::posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
#endif
    std::string name = program.string();
    const std::array<char *, 2> arguments{name.data(), nullptr};
    std::vector<std::string> variables = keptEnvironment();
    std::vector<char *> pointers;
    for (std::string &variable : variables)
        pointers.push_back(variable.data());
    pointers.push_back(nullptr);
    const int failed = ::posix_spawn(&m_process, program.c_str(), &actions, attributes.get(),
                                     arguments.data(), pointers.data());
    ::posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) {
        m_process = -1;
        fail(failed);
    }
}

Helper::Helper(Helper &&other) noexcept
    : m_process(std::exchange(other.m_process, -1)), m_channel(std::move(other.m_channel)) {}

Helper &Helper::operator=(Helper &&other) noexcept {
    std::swap(m_process, other.m_process);
    std::swap(m_channel, other.m_channel);
    return *this;
}

Helper::~Helper() {
    if (m_process <= 0)
        return;
    ::kill(m_process, SIGKILL);
    while (::waitpid(m_process, nullptr, 0) < 0 && errno == EINTR) {
    }
}

std::optional<Ending> Helper::ending() {
    if (m_process <= 0) // it would be any child
        return Ending();
    return endingWithin(endPatience);
}

void Helper::endWithin(std::chrono::milliseconds patience) {
    m_channel = Channel();
    if (m_process > 0)
        endingWithin(patience);
    *this = Helper();
}

std::optional<Ending> Helper::endingWithin(std::chrono::milliseconds patience) {
    int status = 0;
    const auto end = Clock::now() + patience;
    for (pid_t ended = 0; ended != m_process;) {
        ended = ::waitpid(m_process, &status, WNOHANG);
        if (ended < 0 && errno != EINTR)
            break;
        if (ended == 0 && Clock::now() > end)
            return std::nullopt;
        if (ended == 0)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    m_process = -1;
    return WIFSIGNALED(status) ? Ending{howOf(WTERMSIG(status)), WTERMSIG(status)} : Ending();
}

std::optional<HelpersEnds> takeHelpersEnds(Given given) {
    const bool hasFile = given == Given::channelAndFile;
    if (::fcntl(channelNumber, F_GETFD) < 0 || (hasFile && ::fcntl(fileNumber, F_GETFD) < 0))
        return std::nullopt;
    ::close_range(hasFile ? fileNumber + 1 : channelNumber + 1, ~0U, 0);
    return HelpersEnds{Channel(Handle(channelNumber)),
                       hasFile ? Handle(fileNumber, Opened::memory) : Handle()};
}

} // namespace pellucid::platform
