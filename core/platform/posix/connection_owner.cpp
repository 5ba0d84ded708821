// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/connection_owner.h"

#include <arpa/inet.h>
#include <array>
#include <cstdio>
#include <fstream>
#include <netinet/in.h>
#include <sstream>
#include <string>
#include <sys/socket.h>
#include <unistd.h>

namespace pellucid::platform {

namespace {

// As the tables have it: the bytes of the address as a number of this processor.
std::string textOf(in_addr address, int port) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%08X:%04X", address.s_addr, unsigned(port));
    return text.data();
}

} // namespace

// A program that uses IPv6 for everything is in the second table.
struct ConnectionOwner::Tables {
    std::array<std::ifstream, 2> files{std::ifstream("/proc/self/net/tcp"),
                                       std::ifstream("/proc/self/net/tcp6")};
    std::string port;
    uid_t user = ::geteuid();
};

ConnectionOwner::ConnectionOwner(HandleView listening) : m_tables(std::make_unique<Tables>()) {
    sockaddr_in own{};
    socklen_t size = sizeof own;
    ::getsockname(listening.get(), reinterpret_cast<sockaddr *>(&own), &size);
    m_tables->port = textOf(own.sin_addr, ntohs(own.sin_port));
}

ConnectionOwner::~ConnectionOwner() = default;

bool ConnectionOwner::isThisUser(const Connected &from) {
    if (!m_tables->files[0].is_open())
        return true;
    in_addr address{};
    ::inet_pton(AF_INET, from.address.c_str(), &address);
    const std::string established = "01", mapped = "0000000000000000FFFF0000",
                      place = textOf(address, from.port), &port = m_tables->port;
    for (std::ifstream &table : m_tables->files) {
        table.clear();
        table.seekg(0);
        for (std::string row; std::getline(table, row);) {
            std::istringstream columns(row);
            std::string number, local, remote, state, queues, timer, timeouts;
            uid_t user = 0;
            columns >> number >> local >> remote >> state >> queues >> timer >> timeouts >> user;
            // A connection that its program has closed is nobody's.
            if (columns && (local == place || local == mapped + place) &&
                (remote == port || remote == mapped + port) && state == established)
                return user == m_tables->user;
        }
    }
    return false;
}

} // namespace pellucid::platform
