// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <new>
#include <utility>

namespace pellucid::system {

/// Memory for arrays that are made and dropped in every frame. The system would clear each page of
/// a new array, which takes longer than a frame; a few arrays that were dropped are kept instead.
/// Thread-safe. *Throws* std::bad_alloc.
void *takeRecycled(std::size_t bytes);
void giveBack(void *memory, std::size_t bytes) noexcept;

/// A standard allocator of recycled memory. It leaves new elements uninitialised.
template <class T> struct RecycledAllocator {
    using value_type = T;

    RecycledAllocator() = default;
    template <class U> RecycledAllocator(const RecycledAllocator<U> &) {} // NOLINT: a conversion

    T *allocate(std::size_t count) { return static_cast<T *>(takeRecycled(count * sizeof(T))); }
    void deallocate(T *memory, std::size_t count) noexcept { giveBack(memory, count * sizeof(T)); }
    template <class U> void construct(U *at) { ::new (static_cast<void *>(at)) U; }
    template <class U, class... Args> void construct(U *at, Args &&...args) {
        ::new (static_cast<void *>(at)) U(std::forward<Args>(args)...);
    }
    template <class U> bool operator==(const RecycledAllocator<U> &) const { return true; }
};

} // namespace pellucid::system
