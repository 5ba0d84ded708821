// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

#include "core/platform/handle.h"
#include "core/task/progress.h"

namespace pellucid::confined {

/// The descriptors that a helper starts with: its end of the socket, and perhaps a file.
inline constexpr int socketDescriptor = 3, fileDescriptor = 4;

struct Program {
    std::filesystem::path path;
    int file = -1; ///< becomes `fileDescriptor`; -1: none
    /// Names of the environment variables that it gets, in addition to those that are needed to
    /// find libraries.
    std::vector<std::string> environment;
};

/// A program that runs beside this one, connected by a socket that keeps packets' boundaries, with
/// no other open file, no terminal and almost no environment. It is killed with its owner.
class Process {
public:
    Process() = default;
    /// *Throws* std::system_error with the system's code if the program cannot be started.
    explicit Process(const Program &program);
    ~Process();
    Process(Process &&other) noexcept;
    Process &operator=(Process &&other) noexcept;

    int socket() const { return m_socket.get(); }
    /// Waits briefly for the process to end, after its socket has closed. *Returns* the signal that
    /// killed it, or 0 if it exited by itself; empty while it runs.
    std::optional<int> endSignal();
    /// Closes the socket, so that the process ends by itself; kills it if it takes longer.
    void endWithin(std::chrono::milliseconds patience);

private:
    std::optional<int> statusWithin(std::chrono::milliseconds patience);

    pid_t m_pid = -1;
    platform::Handle m_socket;
};

/// Waits until a packet, or the end, can be read. False after the deadline. *Throws* Cancelled.
bool waitForPacket(int socket, double seconds, const task::Progress &progress);

/// The path of a program that is installed with this one: beside it or where packages install it,
/// or the value of an environment variable.
std::filesystem::path findProgram(const char *name, const char *variable);

} // namespace pellucid::confined
