// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/connection_owner.h"

#include <optional>
#include <vector>

#include "core/platform/windows/error.h"
// After winsock2.h.
#include <iphlpapi.h>
#include <ws2tcpip.h>

namespace pellucid::platform {

namespace {

// The process that has the connection; none if the system does not report it, 0 if nobody has it.
std::optional<DWORD> processOf(const std::string &address, int port, int to) {
    DWORD size = 0;
    std::vector<std::byte> bytes;
    DWORD error = ERROR_INSUFFICIENT_BUFFER;
    while (error == ERROR_INSUFFICIENT_BUFFER) { // it may have grown
        bytes.resize(size);
        error = ::GetExtendedTcpTable(bytes.data(), &size, FALSE, AF_INET,
                                      TCP_TABLE_OWNER_PID_CONNECTIONS, 0);
    }
    if (error != NO_ERROR || bytes.size() < sizeof(DWORD))
        return std::nullopt;
    in_addr from{};
    ::inet_pton(AF_INET, address.c_str(), &from);
    const auto &table = *reinterpret_cast<const MIB_TCPTABLE_OWNER_PID *>(bytes.data());
    for (DWORD n = 0; n < table.dwNumEntries; ++n) {
        const MIB_TCPROW_OWNER_PID &row = table.table[n];
        if (row.dwState == MIB_TCP_STATE_ESTAB && row.dwLocalAddr == from.s_addr &&
            row.dwRemoteAddr == htonl(INADDR_LOOPBACK) && ntohs(u_short(row.dwLocalPort)) == port &&
            ntohs(u_short(row.dwRemotePort)) == to)
            return row.dwOwningPid;
    }
    return 0;
}

} // namespace

bool isOfThisUser(const std::string &address, int port, int to) {
    const auto process = processOf(address, port, to);
    if (!process)
        return true;
    // A process of another user cannot be asked.
    const Handle opened =
        handleOf(::OpenProcess(PROCESS_QUERY_LIMITED_INFORMATION, FALSE, *process));
    try {
        return opened && userOf(nativeOf(opened)) == userOf(::GetCurrentProcess());
    } catch (const std::system_error &) {
        return false;
    }
}

} // namespace pellucid::platform
