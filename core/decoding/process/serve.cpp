// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/process/serve.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <new>

#include "core/dcmtk/codecs.h"
#include "core/decoding/client/channel.h"
#include "core/decoding/client/child.h"
#include "core/decoding/client/decoder.h"
#include "core/decoding/client/reasons.h"
#include "core/decoding/process/damage.h"
#include "core/decoding/process/parse.h"
#include "core/decoding/process/reasons.h"
#include "core/files/mapping.h"
#include "core/platform/characters.h"
#include "core/platform/watch.h"
#include "core/task/error.h"

namespace pellucid::decoding::process {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

// Thrown when the other side has closed the connection or refuses.
struct Disconnected {};

class Server {
public:
    explicit Server(platform::HelpersEnds ends)
        : m_channel(std::move(ends.channel)), m_arena(std::move(ends.file)) {}

    // Returns false when the other side is gone.
    bool serveNext() {
        auto request = receive(m_channel, Takes::handle);
        if (!request)
            return false;
        m_file = std::move(request->handle);
        m_watch.allow(decodingSeconds(request->message));
        try {
            orDamaged([&] { answer(request->message); });
        } catch (const Error &error) {
            finish(error.code() == ErrorCode::outOfMemory ? needsMemory : isUnusable,
                   error.reason().encoded(), {});
        }
        m_watch.pause();
        return true;
    }

private:
    void answer(const Message &request) {
        m_content = files::Mapping(m_file, request.size, files::Mapping::Access::read);
        const std::span<const std::byte> content = m_content.bytes();
        switch (request.kind) {
        case Message::Kind::header:
            platform::expectFewReads(content); // only the header is needed
            finish(0, pack(parseHeader(content)), {});
            break;
        case Message::Kind::image: {
            const DecodedImage image = decodeImage(content);
            finish(0, pack(image.header), std::as_bytes(std::span(image.samples)));
            break;
        }
        case Message::Kind::segmentation: {
            const DecodedSegmentation decoded = decodeSegmentation(content);
            finish(0, pack(decoded.header), decoded.pixels);
            break;
        }
        case Message::Kind::structureSet: {
            const DecodedStructureSet decoded = decodeStructureSet(content);
            finish(0, pack(decoded.header), std::as_bytes(std::span(decoded.points)));
            break;
        }
        case Message::Kind::attributes:
            platform::expectFewReads(content);
            finish(0, pack(listAttributes(content)), {});
            break;
        case Message::Kind::uncompressed:
            finish(0, {},
                   uncompress(content,
                              request.code == 1 ? explicitLittleEndian : implicitLittleEndian));
            break;
        case Message::Kind::directory:
            finish(0, pack(parseDirectory(content)), {});
            break;
        case Message::Kind::archive:
            answerArchive(content);
            break;
        case Message::Kind::layout:
            finish(0, pack(parseVolumeLayout(content)), {});
            break;
        case Message::Kind::samples:
            readSamples(content, samplesOf(request),
                        [&](std::span<const std::byte> data, bool hasMore) {
                            part(hasMore ? moreFollows : 0, {}, data);
                        });
            finish(0, {}, {});
            break;
        default:
            throw Error(ErrorCode::usage, because::unsupportedRequest);
        }
    }

    static SampleRange samplesOf(const Message &request) {
        const auto has = [&](int flag) { return (request.code & flag) != 0; };
        return {request.dataBytes, request.code & 15, has(deflated),
                has(swapped),      request.at,        request.skip};
    }

    void answerArchive(std::span<const std::byte> archive) {
        std::vector<ArchiveFile> announced;
        const auto announce = [&] {
            part(announcement, pack(announced), {});
            announced.clear();
        };
        listArchive(archive, [&](const ArchiveFile &file) {
            announced.push_back(file);
            if (announced.size() == filesAnnouncedAtOnce)
                announce();
        });
        announce();
        readArchive(archive, [&](const ArchiveFile &file, std::span<const std::byte> data,
                                 std::int32_t flags) {
            part(flags, pack(std::vector<ArchiveFile>{file}), data);
        });
        finish(0, {}, {});
    }

    // The time that the other side takes to answer does not count.
    Received ask(const Message &message) {
        m_watch.pause();
        if (!send(m_channel, message))
            throw Disconnected();
        auto reply = receive(m_channel, Takes::handle);
        if (!reply)
            throw Disconnected();
        m_watch.resume();
        return *std::move(reply);
    }

    void put(const std::string &body, std::span<const std::byte> data) {
        const std::uint64_t at = dataOffset(body.size()), needed = at + data.size();
        if (needed > m_arenaBytes) {
            Received reply = ask({Message::Kind::need, 0, needed, 0});
            if (reply.message.kind != Message::Kind::granted || reply.message.size < needed)
                throw Error(ErrorCode::outOfMemory, because::needsTooMuchMemory);
            m_arenaBytes = reply.message.size;
            if (reply.handle) {
                m_mapped = files::Mapping();
                m_arena = std::move(reply.handle);
            }
        }
        if (m_mapped.size() < m_arenaBytes)
            m_mapped = files::Mapping(m_arena, m_arenaBytes, files::Mapping::Access::write);
        std::memcpy(m_mapped.data(), body.data(), body.size());
        if (!data.empty())
            std::memcpy(m_mapped.data() + at, data.data(), data.size());
    }

    void part(int flags, const std::string &body, std::span<const std::byte> data) {
        put(body, data);
        if (ask({Message::Kind::part, flags, body.size(), data.size()}).message.kind !=
            Message::Kind::next)
            throw Disconnected();
    }

    // `data` is not in the file, which the other side may replace as soon as it has the answer.
    void finish(int code, const std::string &body, std::span<const std::byte> data) {
        put(body, data);
        m_content = files::Mapping();
        m_file = Handle();
        if (!send(m_channel, {Message::Kind::done, code, body.size(), data.size()}))
            throw Disconnected();
    }

    Channel m_channel;
    Handle m_file; ///< that of the request
    files::Mapping m_content;
    Handle m_arena;
    files::Mapping m_mapped;
    std::uint64_t m_arenaBytes = 1; // unknown before the first answer, which requests it
    platform::Watch m_watch;
};

} // namespace

void prepareToServe() {
    dcmtk::prepareDcmtk();
    platform::openCharacterTables();
}

int serve(platform::HelpersEnds ends, int confinement) {
    if (!send(ends.channel, {Message::Kind::ready, confinement, 0, 0}))
        return 1;
    try {
        for (Server server(std::move(ends)); server.serveNext();) {
        }
    } catch (const Disconnected &) {
    }
    return 0;
}

} // namespace pellucid::decoding::process
