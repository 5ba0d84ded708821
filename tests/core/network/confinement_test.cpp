// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <functional>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/helper/confinement.h"
#include "core/network/confine.h"

namespace pellucid::network {

namespace {

// Runs `attempt` in a process that has confined itself. *Shape*: its exit status, or minus the
// signal that ended it.
int confined(const std::function<bool()> &attempt, int (*confine)() = network::confine) {
    const pid_t child = ::fork();
    if (child == 0) {
        const int bits = confine();
        const int needed = helper::limitsHold | helper::callsAreFiltered;
        if ((bits & needed) != needed)
            ::_exit(99);
        ::_exit(attempt() ? 1 : 0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

} // namespace

// What a compromised helper would try. 0: it was refused; SIGSYS: it was ended.
TEST(NetworkConfinement, NothingElseIsReached) {
    EXPECT_EQ(confined([] { return ::open("/etc/passwd", O_RDONLY) >= 0; }), 0);
    EXPECT_EQ(
        confined([] { return ::open("/tmp/pellucid-escape", O_CREAT | O_WRONLY, 0600) >= 0; }), 0);
    EXPECT_EQ(confined([] { return ::mkdir("/tmp/pellucid-escape", 0700) == 0; }), 0);
    EXPECT_EQ(confined([] { return ::unlink("/etc/passwd") == 0; }), 0);
    EXPECT_EQ(confined([] { return ::kill(::getppid(), SIGTERM) == 0; }), 0);
    EXPECT_EQ(confined([] { return ::socket(AF_INET, SOCK_STREAM, 0) >= 0; }), -SIGSYS);
    EXPECT_EQ(confined([] { return ::fork() >= 0; }), -SIGSYS);
    EXPECT_EQ(confined([] { return ::execl("/bin/true", "true", nullptr) == 0; }), -SIGSYS);
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    EXPECT_EQ(confined([&] {
                  sockaddr_in at{};
                  at.sin_family = AF_INET;
                  return ::connect(socket, reinterpret_cast<sockaddr *>(&at), sizeof at) == 0;
              }),
              -SIGSYS);
    EXPECT_EQ(confined([&] { return ::listen(socket, 1) == 0; }), -SIGSYS);
    EXPECT_EQ(confined([&] { return ::fcntl(socket, F_SETOWN, ::getppid()) == 0; }), 0);
    ::close(socket);
    // What it needs remains: open sockets and files.
    std::array<int, 2> ends{};
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
    EXPECT_EQ(confined([&] { return ::send(ends[0], "x", 1, 0) == 1; }), 1);
    ::close(ends[0]);
    ::close(ends[1]);
}

// The process that awaits a browser accepts connections on the socket that it has, and no more.
TEST(NetworkConfinement, OnlyOnePortIsAccepted) {
    const auto accepting = [](const std::function<bool()> &attempt) {
        return confined(attempt, confineToAccepting);
    };
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0),
              client = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof at;
    auto *const address = reinterpret_cast<sockaddr *>(&at);
    ASSERT_EQ(::bind(socket, address, size), 0);
    ASSERT_EQ(::listen(socket, 4), 0);
    ASSERT_EQ(::getsockname(socket, address, &size), 0);
    ASSERT_EQ(::connect(client, address, size), 0);
    EXPECT_EQ(accepting([&] { return ::accept4(socket, nullptr, nullptr, SOCK_CLOEXEC) >= 0; }), 1);
    EXPECT_EQ(accepting([] { return ::socket(AF_INET, SOCK_STREAM, 0) >= 0; }), -SIGSYS);
    EXPECT_EQ(accepting([&] { return ::connect(client, address, size) == 0; }), -SIGSYS);
    EXPECT_EQ(accepting([&] { return ::listen(client, 1) == 0; }), -SIGSYS);
    EXPECT_EQ(accepting([] { return ::open("/etc/passwd", O_RDONLY) >= 0; }), 0);
    EXPECT_EQ(accepting([] { return ::fork() >= 0; }), -SIGSYS);
    EXPECT_EQ(confined([&] { return ::accept4(socket, nullptr, nullptr, SOCK_CLOEXEC) >= 0; }),
              -SIGSYS);
    ::close(socket);
    ::close(client);
}

} // namespace pellucid::network
