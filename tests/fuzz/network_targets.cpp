// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/network_targets.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <map>
#include <optional>
#include <string>
#include <sys/socket.h>
#include <unistd.h>
#include <vector>

#include "core/exchange/message.h"
#include "core/exchange/reasons.h"
#include "core/files/descriptor.h"
#include "core/helper/packet.h"
#include "core/helper/packing.h"
#include "core/network/control.h"
#include "core/network/dicom_json.h"
#include "core/network/file_start.h"
#include "core/network/multipart.h"
#include "core/task/error.h"

namespace pellucid::fuzz {

namespace {

using Bytes = std::span<const std::byte>;

void check(bool holds) {
    if (!holds)
        std::abort();
}

std::string textOf(Bytes bytes) {
    return {reinterpret_cast<const char *>(bytes.data()), bytes.size()};
}

template <class F> void refusing(F &&f) {
    try {
        f();
    } catch (const task::Error &error) {
        check(!error.reason().english().empty());
    }
}

bool isOneLine(const std::string &text) {
    return std::none_of(text.begin(), text.end(), [](char c) { return (unsigned char)(c) < 0x20; });
}

// Two ends of a channel as between the program and its helper.
std::array<files::Descriptor, 2> channel() {
    std::array<int, 2> ends{-1, -1};
    check(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) == 0);
    return {files::Descriptor(ends[0]), files::Descriptor(ends[1])};
}

int anyFile() {
    static const int file = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    return file;
}

// The next descriptor that the system would give: the same as before if none was leaked.
int nextDescriptor() {
    const int next = ::fcntl(anyFile(), F_DUPFD_CLOEXEC, 0);
    ::close(next);
    return next;
}

// What is taken can be packed and is then the same.
template <class Unpack> void unpackTwice(const std::string &body, Unpack &&unpack) {
    refusing([&] {
        const std::string packed = exchange::pack(unpack(body));
        check(exchange::pack(unpack(packed)) == packed);
    });
}

struct Parts {
    std::vector<std::string> complete;
    bool isWhole = false;
    bool operator==(const Parts &) const = default;
};

Parts partsOf(const std::string &type, Bytes body, std::size_t piece) {
    Parts parts;
    std::string current;
    bool isOpen = false;
    network::MultipartReader reader(type, {[&] {
                                               check(!isOpen);
                                               isOpen = true;
                                               current.clear();
                                           },
                                           [&](Bytes bytes) {
                                               check(isOpen);
                                               current += textOf(bytes);
                                           },
                                           [&] {
                                               check(isOpen);
                                               isOpen = false;
                                               parts.complete.push_back(current);
                                           }});
    for (; !body.empty(); body = body.subspan(std::min(piece, body.size())))
        reader.add(body.first(std::min(piece, body.size())));
    parts.isWhole = reader.finish();
    check(!parts.isWhole || !isOpen);
    return parts;
}

} // namespace

void packing(Bytes bytes) {
    using Values = std::map<std::string, std::vector<std::optional<double>>>;
    const task::Reason refusal = task::because::implausibleReply;
    refusing([&] {
        const std::string packed = helper::packed(helper::unpacked<Values>(bytes, refusal));
        const auto again = helper::unpacked<Values>(std::as_bytes(std::span(packed)), refusal);
        check(helper::packed(again) == packed);
    });
    refusing([&] { check(isOneLine(helper::unpackedReason(bytes, refusal).encoded())); });
}

void exchangeMessage(Bytes bytes) {
    const std::string body = textOf(bytes);
    unpackTwice(body, exchange::unpack<exchange::Connection>);
    unpackTwice(body, exchange::unpack<exchange::Acceptance>);
    unpackTwice(body, exchange::unpack<exchange::Query>);
    unpackTwice(body, exchange::unpack<exchange::Retrieval>);
    unpackTwice(body, exchange::unpack<exchange::QueryEnd>);
    unpackTwice(body, exchange::unpack<exchange::RetrievalEnd>);
    unpackTwice(body, exchange::unpack<exchange::Arrival>);
    unpackTwice(body, exchange::unpack<exchange::Attributes>);
    unpackTwice(body, exchange::unpack<std::vector<std::string>>);
    // What becomes a file name, or is shown, is plain.
    refusing([&] {
        const exchange::Arrival arrival = exchange::unpack<exchange::Arrival>(body);
        check(exchange::isUid(arrival.sopClassUid) && exchange::isUid(arrival.sopInstanceUid) &&
              exchange::isUid(arrival.transferSyntax) && isOneLine(arrival.callingAe));
    });
    refusing([&] {
        for (const auto &[tag, value] : exchange::unpack<exchange::Attributes>(body))
            check(isOneLine(value));
    });
    refusing([&] {
        for (const std::string &warning : exchange::unpack<exchange::QueryEnd>(body).warnings)
            check(isOneLine(warning));
    });
    refusing([&] {
        const exchange::RetrievalEnd end = exchange::unpack<exchange::RetrievalEnd>(body);
        for (const std::string &uid : end.failedInstances)
            check(exchange::isUid(uid));
        check(isOneLine(end.reason));
    });
    refusing([&] { check(isOneLine(exchange::unpackReason(body).english())); });
}

// A packet of any length is taken whole or not at all, and no descriptor is left open.
void packet(Bytes bytes) {
    const auto ends = channel();
    const int next = nextDescriptor();
    std::array<std::byte, 16> head{};
    std::array<std::byte, 256> body{};
    const bool hasDescriptor = !bytes.empty() && (std::to_integer<int>(bytes[0]) & 1) != 0;
    const bool hasSpace = !bytes.empty() && (std::to_integer<int>(bytes[0]) & 2) != 0;
    if (!helper::sendPacket(ends[0].get(), bytes, {}, hasDescriptor ? anyFile() : -1,
                            helper::WhenBusy::fail))
        return; // longer than the system takes
    {
        const auto received = helper::receivePacket(ends[1].get(), head, body,
                                                    hasSpace ? helper::Takes::descriptor
                                                             : helper::Takes::noDescriptors);
        const bool fits = bytes.size() >= head.size() &&
                          bytes.size() <= head.size() + body.size() && (hasSpace || !hasDescriptor);
        check(received.has_value() == fits);
        if (received) {
            check(received->bytes == bytes.size());
            check(std::equal(head.begin(), head.end(), bytes.begin()));
            check(
                std::equal(bytes.begin() + std::ptrdiff_t(head.size()), bytes.end(), body.begin()));
            check(bool(received->descriptor) == hasDescriptor);
        }
    }
    check(nextDescriptor() == next);
    // The same bytes as a message.
    if (helper::sendPacket(ends[0].get(), bytes, {}, -1, helper::WhenBusy::fail)) {
        const auto received = exchange::receive(ends[1].get());
        check(received.has_value() == (bytes.size() >= head.size()));
        check(!received || received->message.body == textOf(bytes.subspan(head.size())));
    }
}

// The helper's end: the answers to an object that arrives, each the kind and the code of a message,
// in two bytes.
void control(Bytes bytes) {
    const int next = nextDescriptor();
    {
        auto ends = channel();
        // More would not fit between the ends while nobody reads.
        for (std::size_t at = 0; at + 2 <= bytes.size() && at < 16; at += 2) {
            exchange::Message message;
            message.kind = exchange::Message::Kind(std::to_integer<std::uint32_t>(bytes[at]) % 128);
            message.code = std::to_integer<std::int32_t>(bytes[at + 1]);
            const bool hasFile = (message.code & 1) != 0;
            check(exchange::send(ends[0].get(), message, hasFile ? anyFile() : -1));
        }
        // A message that is none.
        if (bytes.size() % 2 != 0)
            check(helper::sendPacket(ends[0].get(), bytes.last(1), {}, -1, helper::WhenBusy::fail));
        ::shutdown(ends[0].get(), SHUT_WR);
        network::Control own(ends[1].get());
        try {
            (void)own.isCancelled();
            network::Storage storage(own, {"1.2", "1.2.3", "1.2.840.10008.1.2", "SENDER"});
            if (storage.isWanted()) {
                storage.write(bytes);
                (void)storage.finish();
                check(bytes.size() >= 6); // three messages: the first was no answer
            }
        } catch (const network::Disconnected &) {
        } catch (const network::CancelledByProgram &) {
        }
    }
    check(nextDescriptor() == next);
}

void multipart(Bytes bytes) {
    const auto line = std::find(bytes.begin(), bytes.end(), std::byte('\n'));
    const auto length = std::size_t(line - bytes.begin());
    const std::string type = textOf(bytes.first(length));
    const Bytes body = bytes.subspan(std::min(length + 1, bytes.size()));
    (void)network::parameterOf(type, "type");
    const Parts whole = partsOf(type, body, body.size() + 1);
    // Headers that are too long count as a part, which depends on when they are too long.
    constexpr std::size_t longestHeaders = 16384;
    if (body.size() > longestHeaders)
        return;
    for (const std::size_t piece : {1, 2, 7, 64})
        check(partsOf(type, body, piece) == whole);
}

void dicomJson(Bytes bytes) {
    const std::string text = textOf(bytes);
    refusing([&] {
        for (const exchange::Attributes &attributes : network::readDicomJson(text))
            for (const auto &[tag, value] : attributes)
                check(tag != 0 && !value.empty() && isOneLine(value));
    });
    refusing([&] { (void)network::readStoreAnswer(text); });
}

void fileStart(Bytes bytes) {
    refusing([&] {
        const auto whole = network::readFileStart(bytes);
        if (!whole)
            return;
        check(exchange::isUid(whole->arrival.sopClassUid) &&
              exchange::isUid(whole->arrival.sopInstanceUid) &&
              exchange::isUid(whole->arrival.transferSyntax));
        check(whole->dataSet <= bytes.size());
        // The start of such a file is not yet enough, or enough for the same answer.
        for (std::size_t length = 0; length < std::min<std::size_t>(bytes.size(), 1024); ++length) {
            const auto part = network::readFileStart(bytes.first(length));
            check(!part || part->arrival.sopInstanceUid == whole->arrival.sopInstanceUid);
        }
    });
}

} // namespace pellucid::fuzz
