// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/confinement.h"

#include <array>

#include "core/platform/memory.h"
#include "core/platform/windows/accepting.h"
#include "core/platform/windows/start.h"

namespace pellucid::platform {

namespace {

// Puts this process into a job of its own, within that of the program, which ends it. *Returns*
// whether a job limits it.
bool limit(std::uint64_t memoryBytes) {
    if (const Handle job = handleOf(::CreateJobObjectW(nullptr, nullptr))) {
        limitToOneProcess(nativeOf(job), std::size_t(memoryBytes));
        ::AssignProcessToJobObject(nativeOf(job), ::GetCurrentProcess());
    }
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    constexpr DWORD needed = JOB_OBJECT_LIMIT_ACTIVE_PROCESS | JOB_OBJECT_LIMIT_PROCESS_MEMORY;
    return ::QueryInformationJobObject(nullptr, JobObjectExtendedLimitInformation, &limits,
                                       sizeof limits, nullptr) != FALSE &&
           (limits.BasicLimitInformation.LimitFlags & needed) == needed;
}

template <class Policy> bool setPolicy(PROCESS_MITIGATION_POLICY which, DWORD flags) {
    Policy policy{};
    policy.Flags = flags;
    return ::SetProcessMitigationPolicy(which, &policy, sizeof policy) != FALSE;
}

// No code that was not loaded, no library from elsewhere, no other program's hooks.
bool forbidNewCode() {
    constexpr DWORD prohibitDynamicCode = 1, disableExtensionPoints = 1, noRemoteNoLowImages = 3;
    const bool isFixed = setPolicy<PROCESS_MITIGATION_DYNAMIC_CODE_POLICY>(ProcessDynamicCodePolicy,
                                                                           prohibitDynamicCode);
    setPolicy<PROCESS_MITIGATION_EXTENSION_POINT_DISABLE_POLICY>(ProcessExtensionPointDisablePolicy,
                                                                 disableExtensionPoints);
    setPolicy<PROCESS_MITIGATION_IMAGE_LOAD_POLICY>(ProcessImageLoadPolicy, noRemoteNoLowImages);
    return isFixed;
}

// Asks, rather than believing that the token holds: whether this program's own file opens.
bool canOpenAFile() {
    std::array<wchar_t, 32768> own{};
    ::GetModuleFileNameW(nullptr, own.data(), DWORD(own.size()));
    return bool(
        handleOf(::CreateFileW(own.data(), GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_DELETE,
                               nullptr, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr)));
}

bool canOpenASocket() {
    WSADATA about{};
    return ::WSAStartup(MAKEWORD(2, 2), &about) == 0 &&
           bool(Handle(Native(::WSASocketW(AF_INET, SOCK_STREAM, IPPROTO_TCP, nullptr, 0, 0)),
                       Opened::socket));
}

} // namespace

// The program has started this process with a token that opens nothing; until now, the main thread
// impersonates another one.
int confine(const Needs &needs) {
    constexpr int mostConnections = 64; // that one login may use
    hideMemory();
    if (needs.talks == Talks::toThoseWhoConnect)
        makeSpareSockets(mostConnections);
    const bool isLimited = limit(needs.memoryBytes);
    const bool isCodeFixed = forbidNewCode();
    const bool isReverted = ::RevertToSelf() != FALSE;
    const bool hasNoFiles = isReverted && !canOpenAFile();
    return (isLimited ? limitsHold : 0) | (isCodeFixed && isReverted ? callsAreFiltered : 0) |
           (hasNoFiles ? filesAreFiltered : 0) | (!canOpenASocket() ? networkIsEmpty : 0);
}

} // namespace pellucid::platform
