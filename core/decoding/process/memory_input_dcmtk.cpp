// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/process/memory_input.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcistrma.h>
#include <dcmtk/dcmdata/dctk.h>

#include "core/decoding/process/reasons.h"
#include "core/platform/process.h"
#include "core/task/error.h"

namespace pellucid::decoding::process {

namespace {

// An element takes about five reads, and 250 bytes in DCMTK. The limit is four million elements, or
// 10 000 frames of 400 each, and a gigabyte.
constexpr std::size_t maxReads = 20'000'000;

std::uintptr_t stackPosition() {
    return reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
}

class MemoryProducer : public DcmProducer {
public:
    MemoryProducer(std::span<const std::byte> file, std::size_t at)
        : m_file(file), m_at(std::min(at, file.size())) {}

    OFBool good() const override { return OFTrue; }
    OFCondition status() const override { return EC_Normal; }
    OFBool eos() override { return m_at == m_file.size(); }
    offile_off_t avail() override { return offile_off_t(m_file.size() - m_at); }
    offile_off_t read(void *to, offile_off_t bytes) override {
        const std::size_t count = here(bytes);
        if (count > 0)
            std::memcpy(to, m_file.data() + m_at, count);
        m_at += count;
        return offile_off_t(count);
    }
    offile_off_t skip(offile_off_t bytes) override {
        const std::size_t count = here(bytes);
        m_at += count;
        return offile_off_t(count);
    }
    void putback(offile_off_t bytes) override {
        m_at -= std::min(m_at, std::size_t(std::max<offile_off_t>(0, bytes)));
    }

private:
    std::size_t here(offile_off_t bytes) const {
        return std::min(m_file.size() - m_at, std::size_t(std::max<offile_off_t>(0, bytes)));
    }

    std::span<const std::byte> m_file;
    std::size_t m_at;
};

class MemoryInput : public DcmInputStream {
public:
    explicit MemoryInput(std::span<const std::byte> file, std::size_t at = 0)
        : DcmInputStream(&m_producer), m_file(file), m_producer(file, at) {}
    DcmInputStreamFactory *newFactory() const override;
    // Counts reads after decompression, because elements are read there.
    offile_off_t read(void *to, offile_off_t bytes) override {
        checkStack();
        // A gigabyte of zeros, a hundred million elements, deflates to almost nothing.
        if (++m_reads > maxReads)
            throw task::Error(task::ErrorCode::unusable, task::because::hasTooManyElements);
        return DcmInputStream::read(to, bytes);
    }

private:
    void checkStack() const {
        const std::uintptr_t here = stackPosition();
        const std::uintptr_t used = here < m_base ? m_base - here : here - m_base;
        if (used > m_maxUsed && used < 4 * m_maxUsed) // farther away it is another thread's stack
            throw task::Error(task::ErrorCode::unusable, task::because::isNestedTooDeeply);
    }

    std::span<const std::byte> m_file;
    std::size_t m_reads = 0;
    std::size_t m_maxUsed = platform::stackToUse();
    std::uintptr_t m_base = stackPosition(); ///< where reading started
    MemoryProducer m_producer;
};

class MemoryFactory : public DcmInputStreamFactory {
public:
    MemoryFactory(std::span<const std::byte> file, std::size_t at) : m_file(file), m_at(at) {}
    DcmInputStream *create() const override { return new MemoryInput(m_file, m_at); }
    DcmInputStreamFactory *clone() const override { return new MemoryFactory(*this); }
    // DCMTK only asks whether it is a temporary file, which it would delete.
    DcmInputStreamFactoryType ident() const override { return DFT_DcmInputFileStreamFactory; }

private:
    std::span<const std::byte> m_file;
    std::size_t m_at;
};

DcmInputStreamFactory *MemoryInput::newFactory() const {
    // A position in a deflated stream is not one in the file.
    return currentProducer() == &m_producer ? new MemoryFactory(m_file, std::size_t(tell()))
                                            : nullptr;
}

} // namespace

std::unique_ptr<DcmInputStream> memoryInput(std::span<const std::byte> file) {
    return std::make_unique<MemoryInput>(file);
}

} // namespace pellucid::decoding::process
