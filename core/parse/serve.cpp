// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/parse/serve.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <iconv.h>
#include <new>
#include <sys/mman.h>

#include "core/dcmtk/dictionary.h"
#include "core/decoder/channel.h"
#include "core/decoder/child.h"
#include "core/decoder/decoder.h"
#include "core/decoder/reasons.h"
#include "core/parse/damage.h"
#include "core/parse/parse.h"
#include "core/parse/reasons.h"
#include "core/parse/watch.h"
#include "core/task/error.h"

namespace pellucid::parse {

namespace {

namespace because = task::because;
using decoder::Descriptor;
using decoder::Mapping;
using decoder::Message;
using task::Error;
using task::ErrorCode;

// Thrown when the other side has closed the connection or refuses.
struct Disconnected {};

class Server {
public:
    Server(int socket, int arena) : m_socket(socket), m_arena(arena) {}

    // Returns false when the other side is gone.
    bool serveNext() {
        const auto request = decoder::receive(m_socket, decoder::Takes::descriptor);
        if (!request)
            return false;
        m_watch.allow(decoder::decodingSeconds(request->message));
        try {
            orDamaged([&] { answer(*request); });
        } catch (const Error &error) {
            finish(error.code() == ErrorCode::outOfMemory ? decoder::needsMemory
                                                          : decoder::isUnusable,
                   error.reason().encoded(), {});
        }
        m_watch.pause();
        return true;
    }

private:
    void answer(const decoder::Received &request) {
        const Mapping file(request.descriptor.get(), request.message.size, Mapping::Access::read);
        switch (request.message.kind) {
        case Message::Kind::header:
            // Only the header is needed, without read-ahead: discs and network shares are slow.
            ::madvise(file.data(), file.size(), MADV_RANDOM);
            finish(0, decoder::pack(parseHeader(file.bytes())), {});
            break;
        case Message::Kind::image: {
            const DecodedImage image = decodeImage(file.bytes());
            finish(0, decoder::pack(image.header), std::as_bytes(std::span(image.samples)));
            break;
        }
        case Message::Kind::segmentation: {
            const DecodedSegmentation decoded = decodeSegmentation(file.bytes());
            finish(0, decoder::pack(decoded.header), decoded.pixels);
            break;
        }
        case Message::Kind::structureSet: {
            const DecodedStructureSet decoded = decodeStructureSet(file.bytes());
            finish(0, decoder::pack(decoded.header), std::as_bytes(std::span(decoded.points)));
            break;
        }
        case Message::Kind::attributes:
            ::madvise(file.data(), file.size(), MADV_RANDOM);
            finish(0, decoder::pack(listAttributes(file.bytes())), {});
            break;
        case Message::Kind::uncompressed:
            finish(0, {},
                   uncompress(file.bytes(), request.message.code == 1
                                                ? decoder::explicitLittleEndian
                                                : decoder::implicitLittleEndian));
            break;
        case Message::Kind::directory:
            finish(0, decoder::pack(parseDirectory(file.bytes())), {});
            break;
        case Message::Kind::archive:
            answerArchive(file.bytes());
            break;
        case Message::Kind::layout:
            finish(0, decoder::pack(parseVolumeLayout(file.bytes())), {});
            break;
        case Message::Kind::samples:
            readSamples(file.bytes(), samplesOf(request.message),
                        [&](std::span<const std::byte> data, bool hasMore) {
                            part(hasMore ? decoder::moreFollows : 0, {}, data);
                        });
            finish(0, {}, {});
            break;
        default:
            throw Error(ErrorCode::usage, because::unsupportedRequest);
        }
    }

    static SampleRange samplesOf(const Message &request) {
        const auto has = [&](int flag) { return (request.code & flag) != 0; };
        return {request.dataBytes,     request.code & 15, has(decoder::deflated),
                has(decoder::swapped), request.at,        request.skip};
    }

    void answerArchive(std::span<const std::byte> archive) {
        std::vector<ArchiveFile> announced;
        const auto announce = [&] {
            part(decoder::announcement, decoder::pack(announced), {});
            announced.clear();
        };
        listArchive(archive, [&](const ArchiveFile &file) {
            announced.push_back(file);
            if (announced.size() == decoder::filesAnnouncedAtOnce)
                announce();
        });
        announce();
        readArchive(archive, [&](const ArchiveFile &file, std::span<const std::byte> data,
                                 std::int32_t flags) {
            part(flags, decoder::pack(std::vector<ArchiveFile>{file}), data);
        });
        finish(0, {}, {});
    }

    // The time that the other side takes to answer does not count.
    Message ask(const Message &message) {
        m_watch.pause();
        if (!decoder::send(m_socket, message))
            throw Disconnected();
        const auto reply = decoder::receive(m_socket, decoder::Takes::descriptor);
        if (!reply)
            throw Disconnected();
        m_watch.resume();
        return reply->message;
    }

    void put(const std::string &body, std::span<const std::byte> data) {
        const std::uint64_t at = decoder::dataOffset(body.size()), needed = at + data.size();
        if (needed > m_arenaBytes) {
            const Message reply = ask({Message::Kind::need, 0, needed, 0});
            if (reply.kind != Message::Kind::granted || reply.size < needed)
                throw Error(ErrorCode::outOfMemory, because::needsTooMuchMemory);
            m_arenaBytes = reply.size;
        }
        if (m_mapped.size() < m_arenaBytes)
            m_mapped = Mapping(m_arena, m_arenaBytes, Mapping::Access::write);
        std::memcpy(m_mapped.data(), body.data(), body.size());
        if (!data.empty())
            std::memcpy(m_mapped.data() + at, data.data(), data.size());
    }

    void part(int flags, const std::string &body, std::span<const std::byte> data) {
        put(body, data);
        if (ask({Message::Kind::part, flags, body.size(), data.size()}).kind != Message::Kind::next)
            throw Disconnected();
    }

    void finish(int code, const std::string &body, std::span<const std::byte> data) {
        put(body, data);
        if (!decoder::send(m_socket, {Message::Kind::done, code, body.size(), data.size()}))
            throw Disconnected();
    }

    int m_socket, m_arena;
    Mapping m_mapped;
    std::uint64_t m_arenaBytes = 1; // unknown before the first answer, which requests it
    Watch m_watch;
};

// DICOM's character sets (PS3.3, C.12.1.1.2) under glibc's names. Their tables are libraries, which
// stay loaded as long as a converter is open.
constexpr std::array characterSets{
    "ISO-IR-6",      "ISO-8859-1",  "ISO-8859-2",  "ISO-8859-3", "ISO-8859-4",    "ISO-8859-5",
    "ISO-8859-6",    "ISO-8859-7",  "ISO-8859-8",  "ISO-8859-9", "ISO-8859-15",   "TIS-620",
    "JIS_X0201",     "ISO-IR-87",   "ISO-IR-159",  "ISO-IR-149", "ISO-2022-JP",   "ISO-2022-JP-1",
    "ISO-2022-JP-2", "ISO-2022-KR", "ISO-2022-CN", "EUC-KR",     "EUC-JP",        "GB18030",
    "GBK",           "GB2312",      "UTF-8",       "ASCII",      "ANSI_X3.4-1968"};

} // namespace

void prepareToServe() {
    dcmtk::prepareDcmtk();
    for (const char *const set : characterSets)
        (void)::iconv_open("UTF-8", set); // left open on purpose; unknown sets are not used
}

int serve(int socket, int arena, int confinement) {
    if (!decoder::send(socket, {Message::Kind::ready, confinement, 0, 0}))
        return 1;
    try {
        for (Server server(socket, arena); server.serveNext();) {
        }
    } catch (const Disconnected &) {
    }
    return 0;
}

} // namespace pellucid::parse
