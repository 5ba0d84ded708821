// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/client/decoder.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include <glm/gtx/component_wise.hpp>

#include "core/confined/helper.h"
#include "core/decoding/client/child.h"
#include "core/decoding/client/reasons.h"
#include "core/files/open_regular.h"
#include "core/files/reasons.h"
#include "core/task/naming.h"
#include "core/task/reasons.h"

namespace pellucid::decoding {

namespace {

namespace fs = std::filesystem;
namespace because = task::because;
using files::RegularFile;
using task::Error;
using task::ErrorCode;
using task::naming;

void requireUnchanged(const RegularFile &file) {
    if (!file.isUnchanged())
        throw Error(ErrorCode::unusable, because::changedWhileRead);
}

RegularFile open(const fs::path &path) {
    RegularFile file = files::openRegular(path);
    if (file.facts.bytes == 0)
        throw Error(ErrorCode::unusable, because::isEmpty, path);
    return file;
}

// Most files in a folder may not be images; recognising these needs no decoder.
void checkStart(const RegularFile &file, const fs::path &path) {
    std::array<std::byte, 132> start{};
    std::size_t got = 0;
    try {
        got = platform::readAt(file.handle, 0, start);
    } catch (const std::system_error &error) {
        throw Error(ErrorCode::unusable, task::systemReason(error.code()), path);
    }
    if (!looksLikeDicom(std::span(start).first(got)))
        throw Error(ErrorCode::unusable, because::isNotDicom, path);
}

std::uint64_t sampleCount(const InstanceHeader &h) {
    std::uint64_t samples = 0;
    if (h.rows < 0 || h.columns < 0 ||
        __builtin_mul_overflow(std::uint64_t(h.rows) * std::uint64_t(h.columns),
                               std::uint64_t(h.frames.size()), &samples) ||
        samples > (std::uint64_t(1) << 62))
        throw Error(ErrorCode::unusable, because::implausibleAnswer);
    return samples;
}

} // namespace

bool looksLikeDicom(std::span<const std::byte> start) {
    if (start.size() >= 132 && std::memcmp(start.data() + 128, "DICM", 4) == 0)
        return true;
    // Files without a preamble start with an element of group 2 or 8 in either byte order.
    if (start.size() < 8)
        return false;
    const auto byte = [&](std::size_t n) { return std::to_integer<int>(start[n]); };
    const bool little = (byte(0) == 8 || byte(0) == 2) && byte(1) == 0;
    const bool big = byte(0) == 0 && (byte(1) == 8 || byte(1) == 2);
    return (little && byte(3) == 0) || (big && byte(2) == 0);
}

HeldDecoder::HeldDecoder(std::unique_ptr<Child> child, Decoder &decoder)
    : m_child(std::move(child)), m_decoder(&decoder) {}

HeldDecoder::HeldDecoder(HeldDecoder &&other) noexcept = default;

HeldDecoder::~HeldDecoder() {
    if (m_child)
        m_decoder->release(std::move(m_child));
}

Decoder::Decoder(fs::path program) : m_program(std::move(program)) {}

Decoder::~Decoder() = default;

Decoder &Decoder::shared() {
    static Decoder decoder(confined::findProgram("pellucid-decode", "PELLUCID_DECODER"));
    return decoder;
}

void Decoder::beginOpening() {
    std::vector<std::unique_ptr<Child>> former; // destroyed without the lock
    const std::lock_guard lock(m_mutex);
    ++m_opening;
    former.swap(m_idle);
}

void Decoder::startAhead(int count, const task::Progress &progress) {
    std::vector<std::unique_ptr<Child>> children;
    try {
        for (int n = 0; n < count; ++n)
            children.push_back(acquire(progress));
    } catch (const Error &) { // the first file reports it
    }
    for (auto &child : children)
        release(std::move(child));
}

std::unique_ptr<Child> Decoder::acquire(const task::Progress &progress) {
    std::uint64_t opening = 0;
    {
        const std::lock_guard lock(m_mutex);
        if (!m_idle.empty()) {
            auto child = std::move(m_idle.back());
            m_idle.pop_back();
            return child;
        }
        opening = m_opening;
    }
    auto child = startChild(progress);
    child->opening = opening;
    return child;
}

// Tries twice: one process that ends at once may have been killed for its memory.
std::unique_ptr<Child> Decoder::startChild(const task::Progress &progress) const {
    try {
        return std::make_unique<Child>(m_program, progress);
    } catch (const Error &) {
        return std::make_unique<Child>(m_program, progress);
    }
}

void Decoder::release(std::unique_ptr<Child> child) {
    if (!child->isUsable() || child->isLarge())
        return; // a new one will be started
    const std::lock_guard lock(m_mutex);
    if (child->opening == m_opening &&
        m_idle.size() < std::max(1U, std::thread::hardware_concurrency()))
        m_idle.push_back(std::move(child));
}

// Sends a request to a decoder. One that ended while it was idle (perhaps killed for its memory) is
// replaced.
std::unique_ptr<Child> Decoder::ask(const Message &request, HandleView file,
                                    const task::Progress &progress) {
    auto child = acquire(progress);
    try {
        child->ask(request, file);
    } catch (const Error &) {
        const std::uint64_t opening = child->opening;
        child = startChild(progress);
        child->opening = opening;
        child->ask(request, file);
    }
    return child;
}

template <class F>
auto Decoder::answerOf(std::unique_ptr<Child> &child, const task::Progress &progress, F &&unpack) {
    const auto taken = [&] {
        try {
            return child->answer(progress);
        } catch (...) {
            release(std::move(child)); // a reason leaves it usable
            throw;
        }
    }();
    // A child that sent nonsense is destroyed with it.
    return unpack(taken);
}

InstanceHeader Decoder::header(const fs::path &path, const task::Progress &progress) {
    const RegularFile file = open(path);
    checkStart(file, path);
    return naming(path, [&] {
        auto child = ask({Message::Kind::header, 0, file.facts.bytes, 0}, file.handle, progress);
        InstanceHeader header = answerOf(child, progress, [](const Child::Answer &answer) {
            return unpack<InstanceHeader>(answer.body);
        });
        release(std::move(child));
        requireUnchanged(file);
        return header;
    });
}

DecodedFile Decoder::image(const fs::path &path, const task::Progress &progress) {
    const RegularFile file = open(path);
    return naming(path, [&] {
        auto child = ask({Message::Kind::image, 0, file.facts.bytes, 0}, file.handle, progress);
        std::span<const std::uint16_t> samples;
        InstanceHeader header = answerOf(child, progress, [&](const Child::Answer &answer) {
            InstanceHeader h = unpack<InstanceHeader>(answer.body);
            const std::uint64_t count = sampleCount(h);
            if (whyUnusable(h) || answer.data.size() != 2 * count)
                throw Error(ErrorCode::unusable, because::implausibleAnswer);
            requireUnchanged(file);
            samples = {reinterpret_cast<const std::uint16_t *>(answer.data.data()), count};
            return h;
        });
        return DecodedFile{std::move(header), samples, HeldDecoder(std::move(child), *this)};
    });
}

DecodedSegmentation Decoder::segmentation(const fs::path &path, const task::Progress &progress) {
    const RegularFile file = open(path);
    checkStart(file, path);
    return naming(path, [&] {
        auto child =
            ask({Message::Kind::segmentation, 0, file.facts.bytes, 0}, file.handle, progress);
        std::span<const std::byte> pixels;
        SegmentationHeader header = answerOf(child, progress, [&](const Child::Answer &answer) {
            SegmentationHeader h = unpack<SegmentationHeader>(answer.body);
            const std::uint64_t count = sampleCount(h.instance);
            const std::uint64_t bytes =
                h.kind == SegmentationKind::binary ? (count + 7) / 8 : 2 * count;
            if (h.instance.rows > 65535 || h.instance.columns > 65535 || count == 0 ||
                answer.data.size() != bytes)
                throw Error(ErrorCode::unusable, because::implausibleAnswer);
            requireUnchanged(file);
            pixels = answer.data;
            return h;
        });
        return DecodedSegmentation{std::move(header), pixels, {std::move(child), *this}};
    });
}

UncompressedFile Decoder::uncompressed(const fs::path &path, bool isExplicit,
                                       const task::Progress &progress) {
    const RegularFile file = open(path);
    checkStart(file, path);
    return naming(path, [&] {
        auto child = ask({Message::Kind::uncompressed, isExplicit ? 1 : 0, file.facts.bytes, 0},
                         file.handle, progress);
        const std::span<const std::byte> bytes =
            answerOf(child, progress, [&](const Child::Answer &answer) {
                if (!looksLikeDicom(answer.data))
                    throw Error(ErrorCode::unusable, because::implausibleAnswer);
                requireUnchanged(file);
                return answer.data;
            });
        return UncompressedFile{bytes, {std::move(child), *this}};
    });
}

DecodedStructureSet Decoder::structureSet(const fs::path &path, const task::Progress &progress) {
    const RegularFile file = open(path);
    checkStart(file, path);
    return naming(path, [&] {
        auto child =
            ask({Message::Kind::structureSet, 0, file.facts.bytes, 0}, file.handle, progress);
        DecodedStructureSet set = answerOf(child, progress, [&](const Child::Answer &answer) {
            DecodedStructureSet read{unpack<StructureSetHeader>(answer.body), {}};
            const std::uint64_t points = pointCount(read.header);
            if (answer.data.size() != points * sizeof(glm::dvec3))
                throw Error(ErrorCode::unusable, because::implausibleAnswer);
            read.points.resize(points);
            std::memcpy(read.points.data(), answer.data.data(), answer.data.size());
            for (const glm::dvec3 &point : read.points)
                if (!(glm::compMax(glm::abs(point)) <= farthestMm))
                    throw Error(ErrorCode::unusable, because::implausibleAnswer);
            requireUnchanged(file);
            return read;
        });
        release(std::move(child));
        return set;
    });
}

AttributeList Decoder::attributes(const fs::path &path, const task::Progress &progress) {
    const RegularFile file = open(path);
    checkStart(file, path);
    return naming(path, [&] {
        auto child =
            ask({Message::Kind::attributes, 0, file.facts.bytes, 0}, file.handle, progress);
        AttributeList list = answerOf(child, progress, [](const Child::Answer &answer) {
            return unpack<AttributeList>(answer.body);
        });
        release(std::move(child));
        requireUnchanged(file);
        return list;
    });
}

DirectoryFile Decoder::directory(const fs::path &path, const task::Progress &progress) {
    const RegularFile file = open(path);
    return naming(path, [&] {
        auto child = ask({Message::Kind::directory, 0, file.facts.bytes, 0}, file.handle, progress);
        DirectoryFile directory = answerOf(child, progress, [](const Child::Answer &answer) {
            return unpack<DirectoryFile>(answer.body);
        });
        release(std::move(child));
        return directory;
    });
}

void Decoder::archive(const fs::path &path,
                      const std::function<void(const ArchiveFile &)> &announce,
                      const std::function<void(const ArchivePart &)> &take,
                      const task::Progress &progress) {
    const RegularFile file = open(path);
    naming(path, [&] {
        auto child = ask({Message::Kind::archive, 0, file.facts.bytes, 0}, file.handle, progress);
        // Every part but the last is full and files follow each other, so the answer cannot be
        // endless.
        bool isAnnouncing = true, isInFile = false;
        for (bool isDone = false; !isDone;) {
            answerOf(child, progress, [&](const Child::Answer &answer) {
                isDone = answer.message.kind == Message::Kind::done;
                if (isDone)
                    return;
                const auto files = unpack<std::vector<ArchiveFile>>(answer.body);
                const int flags = answer.message.code;
                const bool isFirst = (flags & firstPart) != 0, isLast = (flags & lastPart) != 0;
                const bool isDamaged = (flags & damagedPart) != 0;
                if ((flags & announcement) != 0) {
                    if (!isAnnouncing)
                        throw Error(ErrorCode::unusable, because::implausibleAnswer);
                    isAnnouncing = files.size() == filesAnnouncedAtOnce;
                    for (const ArchiveFile &f : files)
                        announce(f);
                } else {
                    if (files.size() != 1 || isFirst == isInFile ||
                        (!isLast && (isDamaged || answer.data.size() != archivePartBytes)))
                        throw Error(ErrorCode::unusable, because::implausibleAnswer);
                    isAnnouncing = false;
                    isInFile = !isLast;
                    take({files[0], answer.data, isFirst, isLast, isDamaged});
                }
                child->requestNext();
            });
        }
        release(std::move(child));
    });
}

VolumeLayout Decoder::layout(const fs::path &path, const task::Progress &progress) {
    const RegularFile file = open(path);
    return naming(path, [&] {
        auto child = ask({Message::Kind::layout, 0, file.facts.bytes, 0}, file.handle, progress);
        VolumeLayout layout = answerOf(child, progress, [](const Child::Answer &answer) {
            return unpack<VolumeLayout>(answer.body);
        });
        release(std::move(child));
        return layout;
    });
}

bool Decoder::samples(const fs::path &path, const SampleRange &samples,
                      const std::function<void(std::span<const std::byte>)> &take,
                      const task::Progress &progress) {
    const RegularFile file = open(path);
    bool hasMore = false;
    naming(path, [&] {
        const int code = samples.bytesEach | (samples.isDeflated ? deflated : 0) |
                         (samples.isSwapped ? swapped : 0);
        auto child = ask({Message::Kind::samples, code, file.facts.bytes, samples.bytes, samples.at,
                          samples.skip},
                         file.handle, progress);
        std::uint64_t left = samples.bytes;
        for (bool isDone = false; !isDone;) {
            answerOf(child, progress, [&](const Child::Answer &answer) {
                isDone = answer.message.kind == Message::Kind::done;
                const std::uint64_t bytes = answer.data.size();
                // Each part must bring some of the bytes, never too many, and the last one
                // completes them.
                if (isDone ? left != 0
                           : bytes == 0 || bytes > left ||
                                 bytes % std::uint64_t(samples.bytesEach) != 0)
                    throw Error(ErrorCode::unusable, because::implausibleAnswer);
                if (isDone)
                    return;
                left -= bytes;
                hasMore = (answer.message.code & moreFollows) != 0;
                take(answer.data);
                child->requestNext();
            });
        }
        release(std::move(child));
    });
    return hasMore;
}

int Decoder::confinement() {
    auto child = acquire({});
    const int confinement = child->confinement();
    release(std::move(child));
    return confinement;
}

} // namespace pellucid::decoding
