// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/system/page_memory.h"

#include <new>

#include "core/platform/memory.h"
#include "core/system/reasons.h"
#include "core/task/error.h"

namespace pellucid::system {

namespace {

using platform::largePage;

constexpr std::size_t roundedUp(std::size_t bytes, std::size_t unit) {
    return (bytes + unit - 1) / unit * unit;
}

std::shared_ptr<std::byte[]> allocate(std::size_t bytes) {
    const std::size_t alignment = bytes >= largePage ? largePage : 64;
    const std::size_t size = roundedUp(bytes, alignment);
    if (size < bytes || size + largePage < size)
        return nullptr;
    if (alignment == largePage)
        if (std::byte *const pages = platform::mapLargePages(size))
            return {pages, [size](std::byte *p) { platform::unmapLargePages(p, size); }};
    const auto aligned = std::align_val_t(alignment);
    void *const memory = ::operator new(size, aligned, std::nothrow);
    return memory == nullptr ? nullptr
                             : std::shared_ptr<std::byte[]>(
                                   static_cast<std::byte *>(memory),
                                   [aligned](std::byte *p) { ::operator delete(p, aligned); });
}

} // namespace

std::shared_ptr<std::byte[]> allocatePages(std::size_t bytes, task::Because<0> what) {
    auto memory = allocate(bytes);
    if (!memory)
        throw task::Error(task::ErrorCode::outOfMemory,
                          task::because::noMemoryForPages(what, bytes >> 20));
    return memory;
}

void returnPages(std::byte *memory, std::size_t bytes, std::size_t kept) {
    // Smaller memory belongs to the allocator, and shares its pages with other memory.
    const std::size_t from = roundedUp(kept, largePage), end = roundedUp(bytes, largePage);
    if (bytes >= largePage && end > from)
        platform::discardLargePages(memory + from, end - from);
}

} // namespace pellucid::system
