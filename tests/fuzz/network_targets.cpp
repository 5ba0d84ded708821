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

#include "core/confined/packing.h"
#include "core/network/client/message.h"
#include "core/network/client/reasons.h"
#include "core/network/process/control.h"
#include "core/network/process/dicom_json.h"
#include "core/network/process/file_start.h"
#include "core/network/process/multipart.h"
#include "core/platform/channel.h"
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

using platform::Channel, platform::HandleView, platform::Takes, platform::WhenBusy;

HandleView anyFile() {
    static const int file = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    return HandleView(file);
}

// The next descriptor that the system would give: the same as before if none was leaked.
int nextDescriptor() {
    const int next = ::fcntl(anyFile().get(), F_DUPFD_CLOEXEC, 0);
    ::close(next);
    return next;
}

// What is taken can be packed and is then the same.
template <class Unpack> void unpackTwice(const std::string &body, Unpack &&unpack) {
    refusing([&] {
        const std::string packed = network::pack(unpack(body));
        check(network::pack(unpack(packed)) == packed);
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
    network::process::MultipartReader reader(type, {[&] {
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
        const std::string packed = confined::packed(confined::unpacked<Values>(bytes, refusal));
        const auto again = confined::unpacked<Values>(std::as_bytes(std::span(packed)), refusal);
        check(confined::packed(again) == packed);
    });
    refusing([&] { check(isOneLine(confined::unpackedReason(bytes, refusal).encoded())); });
}

void networkMessage(Bytes bytes) {
    const std::string body = textOf(bytes);
    unpackTwice(body, network::unpack<network::Connection>);
    unpackTwice(body, network::unpack<network::Acceptance>);
    unpackTwice(body, network::unpack<network::Query>);
    unpackTwice(body, network::unpack<network::Retrieval>);
    unpackTwice(body, network::unpack<network::QueryEnd>);
    unpackTwice(body, network::unpack<network::RetrievalEnd>);
    unpackTwice(body, network::unpack<network::Arrival>);
    unpackTwice(body, network::unpack<network::Attributes>);
    unpackTwice(body, network::unpack<std::vector<std::string>>);
    // What becomes a file name, or is shown, is plain.
    refusing([&] {
        const network::Arrival arrival = network::unpack<network::Arrival>(body);
        check(network::isUid(arrival.sopClassUid) && network::isUid(arrival.sopInstanceUid) &&
              network::isUid(arrival.transferSyntax) && isOneLine(arrival.callingAe));
    });
    refusing([&] {
        for (const auto &[tag, value] : network::unpack<network::Attributes>(body))
            check(isOneLine(value));
    });
    refusing([&] {
        for (const std::string &warning : network::unpack<network::QueryEnd>(body).warnings)
            check(isOneLine(warning));
    });
    refusing([&] {
        const network::RetrievalEnd end = network::unpack<network::RetrievalEnd>(body);
        for (const std::string &uid : end.failedInstances)
            check(network::isUid(uid));
        check(isOneLine(end.reason));
    });
    refusing([&] { check(isOneLine(network::unpackReason(body).english())); });
}

// A packet of any length is taken whole or not at all, and no descriptor is left open.
void packet(Bytes bytes) {
    const auto [one, other] = platform::makeChannel();
    const int next = nextDescriptor();
    std::array<std::byte, 16> head{};
    std::array<std::byte, 256> body{};
    const bool hasDescriptor = !bytes.empty() && (std::to_integer<int>(bytes[0]) & 1) != 0;
    const bool hasSpace = !bytes.empty() && (std::to_integer<int>(bytes[0]) & 2) != 0;
    if (!one.send(bytes, {}, hasDescriptor ? anyFile() : HandleView(), WhenBusy::fail))
        return; // longer than the system takes
    {
        const auto received =
            other.receive(head, body, hasSpace ? Takes::handle : Takes::noHandles);
        const bool fits = bytes.size() >= head.size() &&
                          bytes.size() <= head.size() + body.size() && (hasSpace || !hasDescriptor);
        check(received.has_value() == fits);
        if (received) {
            check(received->bytes == bytes.size());
            check(std::equal(head.begin(), head.end(), bytes.begin()));
            check(
                std::equal(bytes.begin() + std::ptrdiff_t(head.size()), bytes.end(), body.begin()));
            check(bool(received->handle) == hasDescriptor);
        }
    }
    check(nextDescriptor() == next);
    // The same bytes as a message.
    if (one.send(bytes, {}, {}, WhenBusy::fail)) {
        const auto received = network::receive(other);
        check(received.has_value() == (bytes.size() >= head.size()));
        check(!received || received->message.body == textOf(bytes.subspan(head.size())));
    }
}

// The helper's end: the answers to an object that arrives, each the kind and the code of a message,
// in two bytes.
void control(Bytes bytes) {
    const int next = nextDescriptor();
    {
        auto [one, other] = platform::makeChannel();
        // More would not fit between the ends while nobody reads.
        for (std::size_t at = 0; at + 2 <= bytes.size() && at < 16; at += 2) {
            network::Message message;
            message.kind = network::Message::Kind(std::to_integer<std::uint32_t>(bytes[at]) % 128);
            message.code = std::to_integer<std::int32_t>(bytes[at + 1]);
            const bool hasFile = (message.code & 1) != 0;
            check(network::send(one, message, hasFile ? anyFile() : HandleView()));
        }
        // A message that is none.
        if (bytes.size() % 2 != 0)
            check(one.send(bytes.last(1), {}, {}, WhenBusy::fail));
        ::shutdown(one.end().get(), SHUT_WR);
        network::process::Control own(other);
        try {
            (void)own.isCancelled();
            network::process::Storage storage(own, {"1.2", "1.2.3", "1.2.840.10008.1.2", "SENDER"});
            if (storage.isWanted()) {
                storage.write(bytes);
                (void)storage.finish();
                check(bytes.size() >= 6); // three messages: the first was no answer
            }
        } catch (const network::process::Disconnected &) {
        } catch (const network::process::CancelledByProgram &) {
        }
    }
    check(nextDescriptor() == next);
}

void multipart(Bytes bytes) {
    const auto line = std::find(bytes.begin(), bytes.end(), std::byte('\n'));
    const auto length = std::size_t(line - bytes.begin());
    const std::string type = textOf(bytes.first(length));
    const Bytes body = bytes.subspan(std::min(length + 1, bytes.size()));
    (void)network::process::parameterOf(type, "type");
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
        for (const network::Attributes &attributes : network::process::readDicomJson(text))
            for (const auto &[tag, value] : attributes)
                check(tag != 0 && !value.empty() && isOneLine(value));
    });
    refusing([&] { (void)network::process::readStoreAnswer(text); });
}

void fileStart(Bytes bytes) {
    refusing([&] {
        const auto whole = network::process::readFileStart(bytes);
        if (!whole)
            return;
        check(network::isUid(whole->arrival.sopClassUid) &&
              network::isUid(whole->arrival.sopInstanceUid) &&
              network::isUid(whole->arrival.transferSyntax));
        check(whole->dataSet <= bytes.size());
        // The start of such a file is not yet enough, or enough for the same answer.
        for (std::size_t length = 0; length < std::min<std::size_t>(bytes.size(), 1024); ++length) {
            const auto part = network::process::readFileStart(bytes.first(length));
            check(!part || part->arrival.sopInstanceUid == whole->arrival.sopInstanceUid);
        }
    });
}

} // namespace pellucid::fuzz
