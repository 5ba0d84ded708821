// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <vector>

#include <unistd.h>

#include "core/fourier/reasons.h"
#include "core/system/page_memory.h"
#include "core/task/error.h"

namespace pellucid {

namespace {

constexpr std::size_t megabyte = std::size_t(1) << 20;

std::size_t residentBytes() {
    std::ifstream statm("/proc/self/statm");
    std::size_t pages = 0, resident = 0;
    statm >> pages >> resident;
    return resident * std::size_t(::sysconf(_SC_PAGESIZE));
}

TEST(PageMemory, IsAlignedAndWritable) {
    for (const std::size_t bytes : {std::size_t(1), megabyte, 2 * megabyte, 5 * megabyte + 3}) {
        const auto memory = system::allocatePages(bytes, task::because::aSpectrum);
        EXPECT_EQ(std::uintptr_t(memory.get()) % (bytes >= 2 * megabyte ? 2 * megabyte : 64), 0U);
        std::memset(memory.get(), 1, bytes);
    }
}

TEST(PageMemory, AnImpossibleSizeIsAnError) {
    const auto most = std::numeric_limits<std::size_t>::max();
#ifdef PELLUCID_SANITIZED // sanitized allocators end the program when asked for that much
    const std::vector<std::size_t> sizes{most, most - 3 * megabyte};
#else
    const std::vector<std::size_t> sizes{most, most - 3 * megabyte, most / 2};
#endif
    for (const std::size_t bytes : sizes)
        try {
            system::allocatePages(bytes, task::because::aSpectrum);
            ADD_FAILURE() << bytes;
        } catch (const task::Error &error) {
            EXPECT_EQ(error.code(), task::ErrorCode::outOfMemory);
        }
}

#ifndef PELLUCID_SANITIZED // sanitized allocators keep freed memory
// Freed memory must not stay resident below blocks in use, as in the allocator's regions.
TEST(PageMemory, GoesBackToTheSystem) {
    // After a block of that size is freed, the C library keeps smaller ones for itself.
    void *volatile block = std::malloc(30 * megabyte);
    std::free(block);
    const std::size_t before = residentBytes();
    std::vector<void *> small;
    {
        std::vector<std::shared_ptr<std::byte[]>> large;
        for (int n = 0; n < 4; ++n) {
            large.push_back(system::allocatePages(12 * megabyte, task::because::aSpectrum));
            std::memset(large.back().get(), 1, 12 * megabyte);
            small.push_back(std::malloc(2000));
        }
        EXPECT_GT(residentBytes(), before + 40 * megabyte);
    }
    EXPECT_LT(residentBytes(), before + 4 * megabyte); // of 48
    for (void *const memory : small)
        std::free(memory);
}

// What is returned belongs to one block alone: blocks below a large page share pages with others.
TEST(PageMemory, ReturnsOnlyWhatLiesBehindTheKeptPart) {
    std::vector<std::shared_ptr<std::byte[]>> blocks;
    constexpr std::size_t less = 2 * megabyte - 64;
    for (int n = 0; n < 16; ++n) {
        blocks.push_back(system::allocatePages(less, task::because::aSpectrum));
        std::memset(blocks.back().get(), n + 1, less);
    }
    for (const auto &block : blocks)
        system::returnPages(block.get(), less, 64);
    for (int n = 0; n < 16; ++n)
        for (std::size_t at = 0; at < less; at += 8)
            ASSERT_EQ(blocks[std::size_t(n)][at], std::byte(n + 1));

    const std::size_t bytes = 32 * megabyte + 5, kept = 9 * megabyte;
    const auto large = system::allocatePages(bytes, task::because::aSpectrum);
    std::memset(large.get(), 1, bytes);
    const std::size_t before = residentBytes();
    system::returnPages(large.get(), bytes, kept);
    EXPECT_LT(residentBytes() + 20 * megabyte, before);
    for (std::size_t at = 0; at < kept; at += 8)
        ASSERT_EQ(large[at], std::byte(1));
}
#endif

} // namespace

} // namespace pellucid
