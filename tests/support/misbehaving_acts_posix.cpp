// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/misbehaving_acts.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace pellucid::test {

namespace {

std::error_code outcome(bool isDone) {
    return isDone ? std::error_code() : std::error_code(errno, std::generic_category());
}

bool canMap(int protection, int sharing) {
    return ::mmap(nullptr, 4096, protection, sharing | MAP_ANONYMOUS, -1, 0) != MAP_FAILED;
}

} // namespace

bool systemConfines() {
    return true;
}

std::vector<Forbidden> forbiddenActs() {
    std::vector<Forbidden> acts;
    for (const char *const word : {"open-file", "new-file", "unlink", "write-arena-size", "code",
                                   "uncounted", "descriptor", "kill-parent"})
        acts.push_back({word, "Operation not permitted"});
    // A system call that no decoder needs ends the process.
    for (const char *const word : {"socket", "process", "program"})
        acts.push_back({word, "a forbidden system call"});
    return acts;
}

std::optional<std::error_code> attempt(std::string_view word, const platform::HelpersEnds &ends) {
    if (word == "open-file")
        return outcome(::open("/etc/passwd", O_RDONLY) >= 0);
    if (word == "new-file")
        return outcome(::open("pwned", O_WRONLY | O_CREAT, 0600) >= 0);
    if (word == "unlink")
        return outcome(::unlink("kept") >= 0);
    if (word == "write-arena-size")
        return outcome(::ftruncate(ends.file.get(), 16) >= 0);
    if (word == "socket")
        return outcome(::socket(AF_INET, SOCK_STREAM, 0) >= 0);
    if (word == "process")
        return outcome(::fork() >= 0);
    if (word == "program")
        return outcome(::execl("/bin/true", "true", nullptr) >= 0);
    if (word == "code")
        return outcome(canMap(PROT_READ | PROT_EXEC, MAP_PRIVATE));
    if (word == "uncounted")
        return outcome(canMap(PROT_READ | PROT_WRITE, MAP_SHARED));
    if (word == "kill-parent")
        return outcome(::kill(::getppid(), SIGTERM) >= 0);
    return std::nullopt;
}

void crash() {
    ::raise(SIGSEGV);
    std::abort();
}

void beKilled() {
    ::raise(SIGKILL);
    std::abort();
}

void hang() {
    for (const itimerval never{};;)
        ::setitimer(ITIMER_PROF, &never, nullptr);
}

void work() {
    ::getppid();
}

void writeTooLittle(const platform::Channel &channel) {
    (void)!::write(channel.end().get(), "x", 1);
}

} // namespace pellucid::test
