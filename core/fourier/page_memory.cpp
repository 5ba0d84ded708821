// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/page_memory.h"

#include <cstdlib>

#ifdef __linux__
#include <sys/mman.h>
#endif
#include <fmt/format.h>

#include "core/task/error.h"

namespace pellucid::fourier {

std::shared_ptr<std::byte[]> allocatePages(std::size_t bytes, const char *what) {
    constexpr std::size_t largePage = std::size_t(2) << 20;
    const std::size_t alignment = bytes >= largePage ? largePage : 64;
    const std::size_t size = (bytes + alignment - 1) / alignment * alignment;
    void *const memory = size < bytes ? nullptr : std::aligned_alloc(alignment, size);
    if (memory == nullptr)
        throw task::Error(task::ErrorCode::outOfMemory,
                          fmt::format("not enough memory for {} of {} MB", what, bytes >> 20));
#ifdef __linux__
    if (alignment == largePage)
        madvise(memory, size, MADV_HUGEPAGE); // a wish: smaller pages only cost time
#endif
    return {static_cast<std::byte *>(memory), [](std::byte *p) { std::free(p); }};
}

} // namespace pellucid::fourier
