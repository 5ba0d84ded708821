// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <functional>
#include <netinet/in.h>
#include <poll.h>
#include <sched.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/network/process/confine.h"
#include "core/platform/confinement.h"

namespace pellucid::network::process {

namespace {

// Runs `attempt` in a process that has confined itself. *Shape*: its exit status, or minus the
// signal that ended it.
int confined(const std::function<bool()> &attempt, int (*confine)() = network::process::confine) {
    const pid_t child = ::fork();
    if (child == 0) {
        const int bits = confine();
        const int needed = platform::limitsHold | platform::callsAreFiltered;
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

// None of these calls reveals which files exist, their size or their owner.
TEST(NetworkConfinement, FilesAreNotRevealed) {
    struct stat about {};
    EXPECT_EQ(confined([&] { return ::stat("/etc/passwd", &about) == 0; }), 0);
    EXPECT_EQ(confined([&] { return ::lstat("/etc/passwd", &about) == 0; }), 0);
    EXPECT_EQ(confined([&] { return ::fstatat(AT_FDCWD, "/proc/1", &about, 0) == 0; }), 0);
    EXPECT_EQ(confined([] { return ::access("/etc/passwd", F_OK) == 0; }), 0);
    EXPECT_EQ(confined([&] {
                  struct statx all {};
                  return ::statx(AT_FDCWD, "/etc/passwd", 0, STATX_SIZE, &all) == 0;
              }),
              0);
    std::array<char, 64> target{};
    EXPECT_EQ(
        confined([&] { return ::readlink("/proc/1/exe", target.data(), target.size()) >= 0; }), 0);
}

// A socket that is not connected connects when it sends with an address.
TEST(NetworkConfinement, SendingConnectsNothing) {
    const int service = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof at;
    auto *const address = reinterpret_cast<sockaddr *>(&at);
    ASSERT_EQ(::bind(service, address, size), 0);
    ASSERT_EQ(::listen(service, 4), 0);
    ASSERT_EQ(::getsockname(service, address, &size), 0);
    const auto sendsMessage = [&](int socket, int flags) {
        char byte = 'x';
        iovec part{&byte, 1};
        msghdr message{};
        message.msg_name = address;
        message.msg_namelen = size;
        message.msg_iov = &part;
        message.msg_iovlen = 1;
        return ::sendmsg(socket, &message, flags) == 1;
    };
    // Each attempt has a socket of its own, because some change it.
    const auto refused = [](int (*confine)(), bool listens,
                            const std::function<bool(int socket)> &attempt) {
        const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in own{};
        own.sin_family = AF_INET;
        own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        if (listens)
            EXPECT_TRUE(::bind(socket, reinterpret_cast<sockaddr *>(&own), sizeof own) == 0 &&
                        ::listen(socket, 4) == 0);
        const int result = confined([&] { return attempt(socket); }, confine);
        ::close(socket);
        return result == 0;
    };
    for (const auto confine : {network::process::confine, network::process::confineToAccepting})
        for (const bool listens : {false, true}) {
            // What frees a listening socket to connect.
            EXPECT_TRUE(refused(confine, listens, [&](int socket) {
                ::shutdown(socket, SHUT_RD);
                return ::sendto(socket, "x", 1, MSG_FASTOPEN, address, size) == 1;
            }));
            EXPECT_TRUE(refused(confine, listens, [&](int socket) {
                return ::sendto(socket, "x", 1, 0, address, size) == 1;
            }));
            for (const int flags : {0, int(MSG_FASTOPEN)})
                EXPECT_TRUE(refused(confine, listens,
                                    [&](int socket) { return sendsMessage(socket, flags); }));
        }
    pollfd reached{service, POLLIN, 0};
    EXPECT_EQ(::poll(&reached, 1, 100), 0);
    for (const int how : {SHUT_RD, SHUT_RDWR})
        EXPECT_TRUE(refused(network::process::confineToAccepting, true,
                            [&](int socket) { return ::shutdown(socket, how) == 0; }));
    ::close(service);
}

// Where the system has namespaces, the network around a helper has no interface.
TEST(NetworkConfinement, TheNetworkIsEmptyWhereThatIsPossible) {
    const auto inChild = [](const std::function<int()> &work) {
        const pid_t child = ::fork();
        if (child == 0)
            ::_exit(work());
        int status = 0;
        ::waitpid(child, &status, 0);
        return WEXITSTATUS(status);
    };
    const bool isPossible =
        inChild([] { return ::unshare(CLONE_NEWUSER | CLONE_NEWNET) == 0 ? 1 : 0; }) == 1;
    EXPECT_EQ(inChild([] { return confine(); }) & platform::networkIsEmpty,
              isPossible ? platform::networkIsEmpty : 0);
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

} // namespace pellucid::network::process
