// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/connection_owner.h"

#include <arpa/inet.h>
#include <array>
#include <cstdio>
#include <fstream>
#include <netinet/in.h>
#include <sstream>
#include <unistd.h>

namespace pellucid::platform {

namespace {

// As the tables have it: the bytes of the address as a number of this processor.
std::string textOf(const char *address, int port) {
    in_addr bytes{};
    ::inet_pton(AF_INET, address, &bytes);
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%08X:%04X", bytes.s_addr, unsigned(port));
    return text.data();
}

} // namespace

bool isOfThisUser(const std::string &address, int port, int to) {
    const std::string established = "01", mapped = "0000000000000000FFFF0000",
                      place = textOf(address.c_str(), port), own = textOf("127.0.0.1", to);
    bool isReported = false;
    // A program that uses IPv6 for everything is in the second table.
    for (const char *const name : {"/proc/self/net/tcp", "/proc/self/net/tcp6"}) {
        std::ifstream table(name);
        isReported = isReported || table.is_open();
        for (std::string row; std::getline(table, row);) {
            std::istringstream columns(row);
            std::string number, local, remote, state, queues, timer, timeouts;
            uid_t user = 0;
            columns >> number >> local >> remote >> state >> queues >> timer >> timeouts >> user;
            // A connection that its program has closed is nobody's.
            if (columns && (local == place || local == mapped + place) &&
                (remote == own || remote == mapped + own) && state == established)
                return user == ::geteuid();
        }
    }
    return !isReported;
}

} // namespace pellucid::platform
