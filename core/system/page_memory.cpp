// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/system/page_memory.h"

#include <cstdint>
#include <cstdlib>

// Sanitizers check the bounds of allocations, so they need the allocator.
#if defined(__linux__) && !defined(PELLUCID_SANITIZED)
#define PELLUCID_LARGE_PAGES
#include <sys/mman.h>
#endif
#include "core/system/reasons.h"
#include "core/task/error.h"

namespace pellucid::system {

namespace {

constexpr std::size_t largePage = std::size_t(2) << 20;

#ifdef PELLUCID_LARGE_PAGES
// Maps whole large pages and returns them whole. The allocator would keep much of the freed memory,
// and its regions would stay marked for large pages.
std::byte *mapLargePages(std::size_t size) {
    const std::size_t reserved = size + largePage;
    void *const start =
        ::mmap(nullptr, reserved, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (start == MAP_FAILED)
        return nullptr;
    auto *const first = static_cast<std::byte *>(start);
    const std::size_t before = (largePage - std::uintptr_t(start) % largePage) % largePage;
    if (before > 0)
        ::munmap(first, before);
    ::munmap(first + before + size, largePage - before);
    ::madvise(first + before, size, MADV_HUGEPAGE); // a hint: smaller pages only cost time
    return first + before;
}
#endif

std::shared_ptr<std::byte[]> allocate(std::size_t bytes) {
    const std::size_t alignment = bytes >= largePage ? largePage : 64;
    const std::size_t size = (bytes + alignment - 1) / alignment * alignment;
    if (size < bytes || size + largePage < size)
        return nullptr;
#ifdef PELLUCID_LARGE_PAGES
    if (alignment == largePage) {
        std::byte *const memory = mapLargePages(size);
        return memory == nullptr ? nullptr
                                 : std::shared_ptr<std::byte[]>(
                                       memory, [size](std::byte *p) { ::munmap(p, size); });
    }
#endif
    void *const memory = std::aligned_alloc(alignment, size);
    return memory == nullptr ? nullptr
                             : std::shared_ptr<std::byte[]>(static_cast<std::byte *>(memory),
                                                            [](std::byte *p) { std::free(p); });
}

} // namespace

std::shared_ptr<std::byte[]> allocatePages(std::size_t bytes, task::Because<0> what) {
    auto memory = allocate(bytes);
    if (!memory)
        throw task::Error(task::ErrorCode::outOfMemory,
                          task::because::noMemoryForPages(what, bytes >> 20));
    return memory;
}

void returnPages([[maybe_unused]] std::byte *memory, [[maybe_unused]] std::size_t bytes,
                 [[maybe_unused]] std::size_t kept) {
#ifdef PELLUCID_LARGE_PAGES
    // Smaller memory belongs to the allocator, and shares its pages with other memory.
    if (bytes < largePage)
        return;
    const auto whole = [](std::size_t size) {
        return (size + largePage - 1) / largePage * largePage;
    };
    if (whole(bytes) > whole(kept))
        ::madvise(memory + whole(kept), whole(bytes) - whole(kept), MADV_DONTNEED);
#endif
}

} // namespace pellucid::system
