// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/memory.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <limits>
#include <malloc.h>
#include <string>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace pellucid::platform {

namespace {

namespace fs = std::filesystem;

// The names of the same values in the two versions.
struct GroupFiles {
    const char *limit, *used, *droppable;
};
constexpr GroupFiles ofVersion1{"memory.limit_in_bytes", "memory.usage_in_bytes",
                                "total_inactive_file"};
constexpr GroupFiles ofVersion2{"memory.max", "memory.current", "inactive_file"};

// The maximum if there is no limit, which reads "max" or is missing.
std::size_t freeBytesOf(const fs::path &group, const GroupFiles &files) {
    std::size_t limit = 0, used = 0, droppable = 0;
    if (!(std::ifstream(group / files.limit) >> limit) ||
        !(std::ifstream(group / files.used) >> used))
        return std::numeric_limits<std::size_t>::max();
    std::ifstream facts(group / "memory.stat");
    std::string name;
    for (std::size_t bytes = 0; facts >> name >> bytes;)
        if (name == files.droppable)
            droppable = bytes;
    used -= std::min(used, droppable);
    return limit > used ? limit - used : 0;
}

} // namespace

std::size_t groupFreeBytes(const fs::path &root) {
    std::size_t free = std::numeric_limits<std::size_t>::max();
    std::ifstream groups(root / "proc/self/cgroup");
    // Fields: number, controllers, path.
    for (std::string line; std::getline(groups, line);) {
        const auto first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos)
            continue;
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
        const bool isVersion2 = controllers == ",,";
        if (!isVersion2 && controllers.find(",memory,") == std::string::npos)
            continue;
        const fs::path top = root / (isVersion2 ? "sys/fs/cgroup" : "sys/fs/cgroup/memory");
        // A container may see its own group as the root, but the path of the host.
        fs::path group = fs::path(line.substr(second + 1)).relative_path();
        for (;; group = group.parent_path()) {
            free = std::min(free, freeBytesOf(top / group, isVersion2 ? ofVersion2 : ofVersion1));
            if (group.empty())
                break;
        }
    }
    return free;
}

std::size_t mappableBytes() {
    rlimit limit{};
    std::size_t pages = 0;
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
        !(std::ifstream("/proc/self/statm") >> pages))
        return std::numeric_limits<std::size_t>::max();
    const std::size_t mapped = pages * std::size_t(::sysconf(_SC_PAGESIZE));
    return limit.rlim_cur > mapped ? limit.rlim_cur - mapped : 0;
}

std::size_t freeMemoryBytes() {
    const std::size_t ownLimit = std::min(mappableBytes(), groupFreeBytes());
    std::ifstream info("/proc/meminfo");
    std::string name, unit;
    std::size_t kilobytes = 0;
    while (info >> name >> kilobytes >> unit)
        if (name == "MemAvailable:")
            return std::min(kilobytes * 1024, ownLimit);
    return ownLimit;
}

// Maps whole large pages and returns them whole. The allocator would keep much of the freed memory,
// and its regions would stay marked for large pages.
std::byte *mapLargePages([[maybe_unused]] std::size_t bytes) {
#ifdef PELLUCID_SANITIZED
    return nullptr;
#else
    void *const start = ::mmap(nullptr, bytes + largePage, PROT_READ | PROT_WRITE,
                               MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (start == MAP_FAILED)
        return nullptr;
    auto *const first = static_cast<std::byte *>(start);
    const std::size_t before = (largePage - std::uintptr_t(start) % largePage) % largePage;
    if (before > 0)
        ::munmap(first, before);
    ::munmap(first + before + bytes, largePage - before);
    ::madvise(first + before, bytes, MADV_HUGEPAGE); // a hint: smaller pages only cost time
    return first + before;
#endif
}

void unmapLargePages(std::byte *memory, std::size_t bytes) {
    ::munmap(memory, bytes);
}

void discardLargePages(std::byte *memory, std::size_t bytes) {
    ::madvise(memory, bytes, MADV_DONTNEED);
}

void keepFreedMemory() {
    ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
    ::mallopt(M_TRIM_THRESHOLD, 64 << 20);
}

void returnFreedMemory() {
    ::malloc_trim(0);
}

// A limit of 0 on core dumps would not stop those that go to a program (core(5)), as systemd's do.
void leaveMemoryOutOfDumps() {
    std::ofstream("/proc/self/coredump_filter") << "0\n";
}

void hideMemory() {
#ifndef PELLUCID_SANITIZED // the search for leaks debugs the process
    ::prctl(PR_SET_DUMPABLE, 0);
#endif
}

} // namespace pellucid::platform
