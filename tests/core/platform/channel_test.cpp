// SPDX-License-Identifier: GPL-3.0-or-later
// Packets between a program and its helper.
#include "core/platform/channel.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <string_view>

#include "core/platform/file.h"
#include "core/platform/shared_memory.h"
#include "core/platform/socket.h"

namespace pellucid::platform {
namespace {

std::span<const std::byte> bytesOf(std::string_view text) {
    return std::as_bytes(std::span(text));
}

std::string received(const Channel &channel, std::size_t headBytes, std::size_t bodyBytes) {
    std::string head(headBytes, '\0'), body(bodyBytes, '\0');
    const auto packet = channel.receive(std::as_writable_bytes(std::span(head)),
                                        std::as_writable_bytes(std::span(body)), Takes::noHandles);
    return packet ? (head + body).substr(0, packet->bytes) : "nothing";
}

TEST(Channel, KeepsTheBoundariesOfPackets) {
    const auto [one, other] = makeChannel();
    ASSERT_TRUE(one.send(bytesOf("head"), bytesOf("first"), {}, WhenBusy::fail));
    ASSERT_TRUE(one.send(bytesOf("head"), bytesOf(""), {}, WhenBusy::wait));
    ASSERT_TRUE(one.send(bytesOf("a"), bytesOf(""), {}, WhenBusy::wait));
    ASSERT_TRUE(one.send(bytesOf("head"), bytesOf("longer than that"), {}, WhenBusy::wait));
    EXPECT_EQ(received(other, 4, 8), "headfirst");
    EXPECT_EQ(received(other, 4, 8), "head");
    EXPECT_EQ(received(other, 4, 8), "nothing"); // shorter than a head
    EXPECT_EQ(received(other, 4, 8), "nothing"); // longer than there is room for
    ASSERT_TRUE(other.send(bytesOf("back"), bytesOf(""), {}, WhenBusy::fail));
    EXPECT_EQ(received(one, 4, 0), "back");
}

TEST(Channel, TellsWhenTheOtherEndIsClosed) {
    auto [one, other] = makeChannel();
    EXPECT_FALSE(other.awaitPacket(0));
    ASSERT_TRUE(one.send(bytesOf("last"), bytesOf(""), {}, WhenBusy::fail));
    one = Channel();
    EXPECT_TRUE(other.awaitPacket(1000));
    EXPECT_EQ(received(other, 4, 0), "last");
    EXPECT_TRUE(other.awaitPacket(1000));
    EXPECT_EQ(received(other, 4, 0), "nothing");
    EXPECT_FALSE(other.send(bytesOf("more"), bytesOf(""), {}, WhenBusy::fail));
}

TEST(Channel, DoesNotWaitForWhoDoesNotRead) {
    const auto [one, other] = makeChannel();
    const std::string packet(1 << 14, 'x');
    int sent = 0;
    while (sent < 1000 && one.send(bytesOf(packet), bytesOf(""), {}, WhenBusy::fail))
        ++sent;
    EXPECT_GT(sent, 0);
    EXPECT_LT(sent, 1000);
}

TEST(Channel, IsAwaitedTogetherWithSockets) {
    const auto [one, other] = makeChannel();
    const ListeningSocket listening = listenOn("127.0.0.1", 0, 4);
    const std::array sockets{HandleView(listening.socket)};
    EXPECT_EQ(awaitAny(other, sockets, 0), (std::vector<bool>{false, false}));
    const Handle client = connectTo("127.0.0.1", listening.port, 5.0);
    EXPECT_EQ(awaitAny(other, sockets, 1000), (std::vector<bool>{false, true}));
    ASSERT_TRUE(one.send(bytesOf("head"), bytesOf(""), {}, WhenBusy::fail));
    EXPECT_EQ(awaitAny(other, sockets, 1000), (std::vector<bool>{true, true}));
}

TEST(SharedMemory, GrowsAndKeepsItsSize) {
    SharedMemory memory(1 << 16);
    auto written = map(memory.view(), 1 << 16, Access::write);
    written[5] = std::byte(7);
    const auto read = map(memory.view(), 1 << 16, Access::read);
    EXPECT_EQ(read[5], std::byte(7));
    unmap(written);
    unmap(read);
    const bool isAnother = memory.grow(1 << 18);
    EXPECT_EQ(memory.bytes(), 1U << 18);
    written = map(memory.view(), 1 << 18, Access::write);
    EXPECT_EQ(written[5], isAnother ? std::byte(0) : std::byte(7));
    written[(1 << 18) - 1] = std::byte(1);
    unmap(written);
}

} // namespace
} // namespace pellucid::platform
