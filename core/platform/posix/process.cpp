// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/process.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <pthread.h>
#include <sstream>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>

namespace pellucid::platform {

long ownProcess() {
    return ::getpid();
}

// Number, start and boot.
std::string processIdentity(long process) {
    const std::string number = std::to_string(process);
    std::ifstream file("/proc/" + number + "/stat"), bootFile("/proc/sys/kernel/random/boot_id");
    std::string status, boot;
    std::getline(file, status);
    std::getline(bootFile, boot);
    // The name, in parentheses, may contain spaces; the start is the 20th value after it.
    const auto name = status.rfind(')');
    if (name == std::string::npos)
        return {};
    std::istringstream values(status.substr(name + 1));
    std::string start;
    for (int n = 0; n < 20; ++n)
        values >> start;
    return number + " " + start + " " + boot;
}

std::filesystem::path programFile() {
    std::error_code unknown;
    return std::filesystem::read_symlink("/proc/self/exe", unknown);
}

void setMissingVariable(const char *name, const std::string &value) {
    ::setenv(name, value.c_str(), 0);
}

void letLongFilesFail() {
    std::signal(SIGXFSZ, SIG_IGN);
}

void letBrokenPipesFail() {
    std::signal(SIGPIPE, SIG_IGN);
}

void whenAskedToEnd(std::function<void()> first, std::function<void()> second) {
    sigset_t signals;
    ::sigemptyset(&signals);
    ::sigaddset(&signals, SIGINT);
    ::sigaddset(&signals, SIGTERM);
    struct sigaction hangUp {};
    if (::sigaction(SIGHUP, nullptr, &hangUp) == 0 && hangUp.sa_handler != SIG_IGN) // by nohup
        ::sigaddset(&signals, SIGHUP);
    ::pthread_sigmask(SIG_BLOCK, &signals, nullptr); // of the threads to come, too
    static const sigset_t ours = signals;
    // But not of other programs, such as a browser, which Qt starts by a fork.
    ::pthread_atfork(nullptr, nullptr, [] { ::pthread_sigmask(SIG_UNBLOCK, &ours, nullptr); });
    std::thread([signals, first = std::move(first), second = std::move(second)] {
        int received = 0;
        ::sigwait(&signals, &received);
        first();
        ::sigwait(&signals, &received);
        second();
    }).detach();
}

std::size_t stackToUse() {
    constexpr std::size_t typical = std::size_t(8) << 20;
    rlimit limit{};
    const bool isKnown = ::getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    return std::min<std::size_t>(typical, isKnown ? limit.rlim_cur : typical) / 2;
}

void fillRandomly(std::span<std::byte> bytes) {
    if (::getentropy(bytes.data(), bytes.size()) != 0)
        throw std::system_error(errno, std::generic_category());
}

bool isTerminal(std::FILE *stream) {
    return ::isatty(::fileno(stream)) == 1;
}

Machine thisMachine() {
    Machine machine;
    machine.memoryBytes =
        std::size_t(::sysconf(_SC_PHYS_PAGES)) * std::size_t(::sysconf(_SC_PAGE_SIZE));
    utsname name{};
    if (::uname(&name) == 0)
        machine.system = std::string(name.sysname) + " " + name.machine;
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name")) {
            machine.processor = line.substr(line.find(':') + 2);
            break;
        }
    return machine;
}

} // namespace pellucid::platform
