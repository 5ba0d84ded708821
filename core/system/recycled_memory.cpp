// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/system/recycled_memory.h"

#include <cstdlib>
#include <mutex>
#include <vector>

namespace pellucid::system {

namespace {

// Small arrays cost the allocator next to nothing.
constexpr std::size_t smallest = std::size_t(256) << 10;
// A picture on the screen, the next one, its pixels, and those of a study beside.
constexpr std::size_t maxKept = 6, maxBytes = std::size_t(256) << 20;

// A sanitizer must see the end of a block.
#ifdef PELLUCID_SANITIZED
constexpr bool isRecycled = false;
#else
constexpr bool isRecycled = true;
#endif

class Kept {
public:
    void *take(std::size_t bytes) {
        const std::lock_guard lock(m_mutex);
        for (auto block = m_blocks.begin(); block != m_blocks.end(); ++block)
            if (block->bytes == bytes) {
                void *const memory = block->memory;
                m_bytes -= bytes;
                m_blocks.erase(block);
                return memory;
            }
        return nullptr;
    }

    void drop() {
        const std::lock_guard lock(m_mutex);
        for (const Block &block : m_blocks)
            std::free(block.memory);
        m_blocks.clear();
        m_bytes = 0;
    }

    // The oldest is dropped when there are too many.
    void keep(void *memory, std::size_t bytes) {
        const std::lock_guard lock(m_mutex);
        m_blocks.push_back({memory, bytes});
        m_bytes += bytes;
        while (m_blocks.size() > maxKept || m_bytes > maxBytes) {
            m_bytes -= m_blocks.front().bytes;
            std::free(m_blocks.front().memory);
            m_blocks.erase(m_blocks.begin());
        }
    }

private:
    struct Block {
        void *memory;
        std::size_t bytes;
    };
    std::mutex m_mutex;
    std::vector<Block> m_blocks = reserved();
    std::size_t m_bytes = 0;

    static std::vector<Block> reserved() {
        std::vector<Block> blocks;
        blocks.reserve(maxKept + 1); // so that keeping one never throws
        return blocks;
    }
};

Kept &kept() {
    static auto *const blocks = new Kept; // outlives every picture
    return *blocks;
}

} // namespace

void *takeRecycled(std::size_t bytes) {
    void *memory = bytes >= smallest ? kept().take(bytes) : nullptr;
    if (memory == nullptr)
        memory = std::malloc(bytes);
    if (memory == nullptr) {
        kept().drop();
        memory = std::malloc(bytes);
    }
    if (memory == nullptr)
        throw std::bad_alloc();
    return memory;
}

void giveBack(void *memory, std::size_t bytes) noexcept {
    if (isRecycled && bytes >= smallest && bytes <= maxBytes)
        kept().keep(memory, bytes);
    else
        std::free(memory);
}

} // namespace pellucid::system
