// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/memory.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/platform/windows/error.h"

namespace pellucid::platform {

namespace {

constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

} // namespace

std::size_t mappableBytes() {
    return unlimited;
}

// Of the job that this process is in, as containers and schedulers make them.
std::size_t groupFreeBytes(const std::filesystem::path &) {
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    if (::QueryInformationJobObject(nullptr, JobObjectExtendedLimitInformation, &limits,
                                    sizeof limits, nullptr) == FALSE)
        return unlimited;
    const auto has = [&](DWORD flag) {
        return (limits.BasicLimitInformation.LimitFlags & flag) != 0;
    };
    std::size_t free = unlimited;
    if (has(JOB_OBJECT_LIMIT_PROCESS_MEMORY))
        free = limits.ProcessMemoryLimit -
               std::min(limits.ProcessMemoryLimit, limits.PeakProcessMemoryUsed);
    if (has(JOB_OBJECT_LIMIT_JOB_MEMORY))
        free =
            std::min<std::size_t>(free, limits.JobMemoryLimit - std::min(limits.JobMemoryLimit,
                                                                         limits.PeakJobMemoryUsed));
    return free;
}

std::size_t freeMemoryBytes() {
    MEMORYSTATUSEX now{};
    now.dwLength = sizeof now;
    if (::GlobalMemoryStatusEx(&now) == FALSE)
        return groupFreeBytes();
    return std::min<std::size_t>({now.ullAvailPhys, now.ullAvailPageFile, groupFreeBytes()});
}

// Aligned, which the system does only for an address that it is told; between the two calls another
// thread may take it.
std::byte *mapLargePages(std::size_t bytes) {
    constexpr int tries = 16;
    for (int n = 0; n < tries; ++n) {
        void *const start = ::VirtualAlloc(nullptr, bytes + largePage, MEM_RESERVE, PAGE_NOACCESS);
        if (start == nullptr)
            return nullptr;
        ::VirtualFree(start, 0, MEM_RELEASE);
        auto *const aligned = reinterpret_cast<void *>((std::uintptr_t(start) + largePage - 1) /
                                                       largePage * largePage);
        if (void *const memory =
                ::VirtualAlloc(aligned, bytes, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE))
            return static_cast<std::byte *>(memory);
    }
    return nullptr;
}

void unmapLargePages(std::byte *memory, std::size_t) {
    ::VirtualFree(memory, 0, MEM_RELEASE);
}

void discardLargePages(std::byte *memory, std::size_t bytes) {
    ::VirtualFree(memory, bytes, MEM_DECOMMIT);
    ::VirtualAlloc(memory, bytes, MEM_COMMIT, PAGE_READWRITE);
}

// The heap of Windows keeps what it thinks fit.
void keepFreedMemory() {}
void returnFreedMemory() {}

void leaveMemoryOutOfDumps() {
    ::SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX);
}

void hideMemory() {
    leaveMemoryOutOfDumps();
}

} // namespace pellucid::platform
