// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <system_error>

#include "core/platform/socket.h"

namespace pellucid::platform {

namespace {

TEST(Socket, AddressesAreOfOneKindOrNone) {
    EXPECT_EQ(addressKind("192.0.2.7"), AddressKind::ipv4);
    EXPECT_EQ(addressKind("2001:db8::7"), AddressKind::ipv6);
    for (const char *const none : {"", "pacs", "192.0.2", "2001:db8:::7", "192.0.2.7 "})
        EXPECT_FALSE(addressKind(none)) << none;
    for (const char *const own : {"127.0.0.1", "127.8.9.1", "::1"})
        EXPECT_TRUE(isLoopback(own)) << own;
    for (const char *const other : {"192.0.2.7", "::2", "localhost", ""})
        EXPECT_FALSE(isLoopback(other)) << other;
    const auto own = addressesOf("127.0.0.1");
    EXPECT_NE(std::find(own.begin(), own.end(), "127.0.0.1"), own.end());
}

// On every address, a client of IPv4 is named by its address of IPv4.
TEST(Socket, AcceptsConnections) {
    for (const char *const address : {"", "127.0.0.1"}) {
        const ListeningSocket listening = listenOn(address, 0, 4);
        EXPECT_GT(listening.port, 0);
        EXPECT_FALSE(awaitInput(listening.socket, 0));
        const Handle client = connectTo("127.0.0.1", listening.port, 5.0);
        ASSERT_TRUE(awaitInput(listening.socket, 5000));
        const auto accepted = acceptFrom(listening.socket);
        ASSERT_TRUE(accepted);
        EXPECT_EQ(accepted->address, "127.0.0.1");
    }
    EXPECT_FALSE(acceptFrom(listenOn("127.0.0.1", 0, 4, Accepting::neverWaits).socket));
}

TEST(Socket, SaysWhyAPortCannotBeUsed) {
    const ListeningSocket listening = listenOn("127.0.0.1", 0, 4);
    const auto reason = [](const std::string &address, int port) {
        try {
            listenOn(address, port, 4);
        } catch (const std::system_error &error) {
            return error.code();
        }
        return std::error_code();
    };
    EXPECT_EQ(reason("127.0.0.1", listening.port), std::errc::address_in_use);
    EXPECT_EQ(reason("192.0.2.7", 0), std::errc::address_not_available);
    EXPECT_EQ(reason("255.255.255.255", 0), std::errc::invalid_argument);
    EXPECT_EQ(reason("pacs", 0), std::errc::invalid_argument);
}

} // namespace
} // namespace pellucid::platform
