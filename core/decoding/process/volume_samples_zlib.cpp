// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstring>
#include <new>
#include <optional>
#include <vector>

#include <zlib.h>

#include "core/decoding/client/reasons.h"
#include "core/decoding/process/parse.h"
#include "core/decoding/process/reasons.h"
#include "core/decoding/process/volume_formats.h"
#include "core/files/reasons.h"
#include "core/task/error.h"

namespace pellucid::decoding::process {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

constexpr std::size_t partBytes = 1 << 20;

void swapEach(std::span<std::byte> bytes, int bytesEach) {
    for (std::size_t at = 0; at < bytes.size(); at += std::size_t(bytesEach))
        std::reverse(bytes.begin() + std::ptrdiff_t(at),
                     bytes.begin() + std::ptrdiff_t(at) + bytesEach);
}

// Reads consecutive members of a gzip file, which tools append to each other.
class Inflated {
public:
    explicit Inflated(std::span<const std::byte> deflated) : m_rest(deflated) {
        constexpr int largestWindow = 15, ofGzipOrZlib = 32;
        if (inflateInit2(&m_stream, largestWindow + ofGzipOrZlib) != Z_OK)
            throw std::bad_alloc();
    }
    ~Inflated() { inflateEnd(&m_stream); }
    Inflated(const Inflated &) = delete;
    Inflated &operator=(const Inflated &) = delete;

    // Reads as much as there is.
    std::size_t readStart(std::span<std::byte> out) {
        m_stream.next_out = reinterpret_cast<Bytef *>(out.data());
        m_stream.avail_out = uInt(out.size());
        try {
            while (m_stream.avail_out > 0)
                inflateMore();
        } catch (const Error &) { // the data end here
        }
        return out.size() - m_stream.avail_out;
    }

    void skip(std::uint64_t bytes) {
        std::vector<std::byte> passed(partBytes);
        for (std::uint64_t left = bytes; left > 0;) {
            const auto part = std::size_t(std::min<std::uint64_t>(left, passed.size()));
            read(std::span(passed).first(part));
            left -= part;
        }
    }

    void read(std::span<std::byte> out) {
        m_stream.next_out = reinterpret_cast<Bytef *>(out.data());
        m_stream.avail_out = uInt(out.size());
        while (m_stream.avail_out > 0)
            inflateMore();
    }

    // After all wanted bytes: reads on to the checksum of the gzip member, which verifies them.
    // True if there are more bytes instead.
    bool hasMore() {
        std::byte beyond{};
        m_stream.next_out = reinterpret_cast<Bytef *>(&beyond);
        m_stream.avail_out = 1;
        while (!m_isAtEnd && m_stream.avail_out > 0)
            inflateMore();
        if (m_stream.avail_out == 0)
            return true;
        // Another member; otherwise it is padding.
        return m_stream.avail_in > 1 && m_stream.next_in[0] == 0x1F && m_stream.next_in[1] == 0x8B;
    }

private:
    static constexpr std::size_t largestInput = 1U << 30;

    void inflateMore() {
        if (m_isAtEnd)
            inflateReset(&m_stream);
        if (m_stream.avail_in == 0) {
            const auto next = m_rest.first(std::min(m_rest.size(), largestInput));
            m_stream.next_in = const_cast<Bytef *>(reinterpret_cast<const Bytef *>(next.data()));
            m_stream.avail_in = uInt(next.size());
            m_rest = m_rest.subspan(next.size());
        }
        const int status = inflate(&m_stream, Z_NO_FLUSH);
        if (status == Z_MEM_ERROR)
            throw std::bad_alloc();
        // Without input there is no progress, which is also an error.
        if (status != Z_OK && status != Z_STREAM_END)
            throw Error(ErrorCode::unusable, because::compressedDataDamaged);
        m_isAtEnd = status == Z_STREAM_END;
    }

    bool m_isAtEnd = false; ///< of a member
    std::span<const std::byte> m_rest;
    z_stream m_stream{};
};

} // namespace

std::vector<std::byte> inflatedStart(std::span<const std::byte> deflated, std::size_t maxBytes) {
    std::vector<std::byte> start(maxBytes);
    start.resize(Inflated(deflated).readStart(start));
    return start;
}

void readSamples(std::span<const std::byte> file, const SampleRange &samples,
                 const std::function<void(std::span<const std::byte>, bool hasMore)> &take) {
    if (samples.bytesEach < 1 || samples.bytesEach > 8 ||
        partBytes % std::size_t(samples.bytesEach) != 0 ||
        samples.bytes % std::uint64_t(samples.bytesEach) != 0)
        throw Error(ErrorCode::usage, because::unsupportedRequest);
    const std::uint64_t begin = samples.at + (samples.isDeflated ? 0 : samples.skip);
    if (begin > file.size() || (!samples.isDeflated && file.size() - begin < samples.bytes))
        throw Error(ErrorCode::unusable, because::isTruncated);
    const auto stored = file.subspan(begin);
    std::optional<Inflated> inflated;
    if (samples.isDeflated) {
        inflated.emplace(stored);
        inflated->skip(samples.skip);
    }
    std::vector<std::byte> buffer(partBytes);
    for (std::uint64_t done = 0; done < samples.bytes; done += buffer.size()) {
        buffer.resize(std::min<std::uint64_t>(partBytes, samples.bytes - done));
        if (inflated)
            inflated->read(buffer);
        else
            std::memcpy(buffer.data(), stored.data() + done, buffer.size());
        if (samples.isSwapped)
            swapEach(buffer, samples.bytesEach);
        const bool isLast = done + buffer.size() == samples.bytes;
        take(buffer, isLast && (inflated ? inflated->hasMore()
                                         : stored.size() >=
                                               samples.bytes + std::uint64_t(samples.bytesEach)));
    }
}

} // namespace pellucid::decoding::process
