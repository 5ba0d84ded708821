// SPDX-License-Identifier: GPL-3.0-or-later
// A decoder that a file has taken over. It is confined like the real one, and does what the word
// after the file's preamble says.
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "core/decoding/client/channel.h"
#include "core/decoding/client/child.h"
#include "core/decoding/process/serve.h"
#include "core/platform/helper.h"
#include "core/platform/watch.h"
#include "core/task/reason.h"
#include "core/task/reasons.h"
#include "tests/support/misbehaving_acts.h"

namespace {

using namespace pellucid;
namespace because = task::because;
using decoding::Message;
using files::Mapping;

constexpr std::size_t mib = std::size_t(1) << 20;

platform::HelpersEnds ends;

void send(const Message &message) {
    decoding::send(ends.channel, message);
}

void finishWith(const std::string &body, std::int32_t code = decoding::isUnusable) {
    const Mapping arena(ends.file, mib, Mapping::Access::write);
    std::memcpy(arena.data(), body.data(), body.size());
    send({Message::Kind::done, code, body.size(), 0});
}

void finish(const task::Reason &reason, std::int32_t code = decoding::isUnusable) {
    finishWith(reason.encoded(), code);
}

task::Reason byHand() {
    return because::inWords("decoded by hand");
}

// Does what confinement forbids. Returns whether the word was one of these.
bool tryForbidden(std::string_view word) {
    if (const auto error = test::attempt(word, ends))
        finish(*error ? task::systemReason(*error) : because::inWords("went through"));
    else if (word == "descriptor") {
        const bool isSent =
            decoding::send(ends.channel, {Message::Kind::need, 0, mib, 0}, ends.channel.end());
        finish(isSent ? because::inWords("went through") : task::systemReason(errno));
    } else if (word == "memory") {
        std::vector<char *> taken;
        for (;;) {
            auto *const more = static_cast<char *>(std::malloc(256 * mib));
            if (more == nullptr)
                break;
            taken.push_back(more);
        }
        finish(because::inWords("had " + std::to_string(taken.size() / 4) + " GB"));
    } else
        return false;
    return true;
}

void act(std::string_view word) {
    if (word == "crash")
        test::crash();
    else if (word == "killed")
        test::beKilled();
    else if (word == "hang")
        test::hang();
    else if (word == "dawdle") { // until its own clock ends it
        platform::Watch watch;
        watch.allow(decoding::decodingSeconds({Message::Kind::header, 0, 0, 0}));
        for (;;)
            test::work();
    } else if (word == "silence")
        std::_Exit(0);
    else if (tryForbidden(word))
        return;
    else if (word == "ask-for-all")
        send({Message::Kind::need, 0, std::uint64_t(1) << 50, 0});
    else if (word == "ask-beyond-the-end")
        send({Message::Kind::need, 0, (std::uint64_t(1) << 63) + 3 * mib, 0});
    else if (word == "ask-to-the-end")
        send({Message::Kind::need, 0, (std::uint64_t(1) << 63) - 1, 0});
    else if (word == "flood") // without ever listening
        for (;;)
            send({Message::Kind::need, 0, mib, 0});
    else if (word == "large-body")
        send({Message::Kind::done, 0, std::uint64_t(1) << 60, 8});
    else if (word == "large-data")
        send({Message::Kind::done, 0, 8, ~std::uint64_t(0) - 8});
    else if (word == "other-kind")
        send({Message::Kind(7777), 0, 0, 0});
    else if (word == "short-message")
        test::writeTooLittle(ends.channel);
    else if (word == "empty-header")
        send({Message::Kind::done, 0, 0, 0});
    else if (word == "no-reason")
        finishWith("");
    else if (word == "plain-reason")
        finishWith("is damaged");
    else if (word == "cut-reason")
        finishWith("isDamagedBy t100:no end");
    else if (word == "other-reason")
        finishWith("isOfNoTable;");
    else if (word == "long-reason")
        finish(because::inWords(std::string(100000, 'x')));
    else if (word == "deep-reason") {
        std::string body;
        for (int n = 0; n < 100; ++n)
            body += "inWords r1:";
        finishWith(body + "isEmpty;" + std::string(100, ';'));
    } else if (word == "lack")
        finish(byHand(), decoding::needsMemory);
    else if (word == "other-code")
        finish(byHand(), 77);
    else if (word == "samples-twice" || word == "half-the-samples") {
        const bool isTwice = word == "samples-twice";
        send({Message::Kind::part, 0, 0, isTwice ? 4096U : 2048U});
        decoding::receive(ends.channel, decoding::Takes::handle); // go on
        send({isTwice ? Message::Kind::part : Message::Kind::done, 0, 0, isTwice ? 4096U : 0U});
    } else if (word == "more-samples")
        send({Message::Kind::part, 0, 0, 1 << 16});
    else if (word == "half-a-sample")
        send({Message::Kind::part, 0, 0, 3});
    else if (word == "no-samples") // and so on for ever
        send({Message::Kind::part, 0, 0, 0});
    else if (word == "fewer-samples")
        send({Message::Kind::done, 0, 0, 0});
    else
        finish(byHand());
}

} // namespace

int main() {
    ends = *platform::takeHelpersEnds(platform::Given::channelAndFile);
    const int confinement = decoding::process::confine();
    send({Message::Kind::ready, confinement, 0, 0});
    while (const auto request = decoding::receive(ends.channel, decoding::Takes::handle)) {
        if (!request->handle) { // an answer to what it asked
            finish(because::inWords(request->message.kind == Message::Kind::refused ? "refused"
                                                                                    : "granted"));
            continue;
        }
        const Mapping file(request->handle, request->message.size, Mapping::Access::read);
        const std::string_view text(reinterpret_cast<const char *>(file.data()), file.size());
        act(text.substr(std::min<std::size_t>(132, text.size())));
    }
    return 0;
}
