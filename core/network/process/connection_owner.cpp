// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/connection_owner.h"

#include <algorithm>
#include <sstream>
#include <sys/socket.h>
#include <unistd.h>

#include <fmt/format.h>

namespace pellucid::network::process {

namespace {

// As the tables have it: the bytes of the address as a number of this processor.
std::string textOf(const sockaddr_in &place) {
    return fmt::format("{:08X}:{:04X}", place.sin_addr.s_addr, ntohs(place.sin_port));
}

} // namespace

// A program that uses IPv6 for everything is in the second table.
ConnectionOwner::ConnectionOwner(int listening)
    : m_tables{std::ifstream("/proc/self/net/tcp"), std::ifstream("/proc/self/net/tcp6")},
      m_user(::geteuid()) {
    sockaddr_in own{};
    socklen_t size = sizeof own;
    ::getsockname(listening, reinterpret_cast<sockaddr *>(&own), &size);
    m_port = textOf(own);
}

bool ConnectionOwner::isThisUser(const sockaddr_in &from) {
    if (!m_tables[0].is_open())
        return true;
    const std::string established = "01", mapped = "0000000000000000FFFF0000", place = textOf(from);
    for (std::ifstream &table : m_tables) {
        table.clear();
        table.seekg(0);
        for (std::string row; std::getline(table, row);) {
            std::istringstream columns(row);
            std::string number, local, remote, state, queues, timer, timeouts;
            uid_t user = 0;
            columns >> number >> local >> remote >> state >> queues >> timer >> timeouts >> user;
            // A connection that its program has closed is nobody's.
            if (columns && (local == place || local == mapped + place) &&
                (remote == m_port || remote == mapped + m_port) && state == established)
                return user == m_user;
        }
    }
    return false;
}

} // namespace pellucid::network::process
