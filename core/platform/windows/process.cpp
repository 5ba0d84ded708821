// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/process.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fcntl.h>
#include <io.h>
#include <mutex>
#include <thread>

#include "core/platform/windows/error.h"
// After windows.h.
#include <bcrypt.h>

namespace pellucid::platform {

namespace {

std::string utf8(const wchar_t *text) {
    return std::filesystem::path(text).string();
}

// Streams are binary, as on POSIX; while the program runs, its console shows UTF-8.
const bool isPrepared = [] {
    _fmode = _O_BINARY;
    for (std::FILE *const stream : {stdin, stdout, stderr})
        ::_setmode(::_fileno(stream), _O_BINARY);
    static const UINT usual = ::GetConsoleOutputCP();
    ::SetConsoleOutputCP(CP_UTF8);
    std::atexit([] { ::SetConsoleOutputCP(usual); });
    return true;
}();

struct Endings {
    std::mutex mutex;
    std::function<void()> first, second;
    int asked = 0;
};

Endings &endings() {
    static Endings all;
    return all;
}

// On a thread that the system makes; the program ends when it returns from the close of a console.
BOOL WINAPI isAsked(DWORD how) {
    std::function<void()> next;
    {
        const std::lock_guard lock(endings().mutex);
        ++endings().asked;
        next = endings().asked == 1 ? endings().first : endings().second;
    }
    next();
    if (how != CTRL_C_EVENT && how != CTRL_BREAK_EVENT)
        ::Sleep(INFINITE);
    return TRUE;
}

} // namespace

long ownProcess() {
    return long(::GetCurrentProcessId());
}

// Number and start.
std::string processIdentity(long process) {
    const Handle opened =
        handleOf(::OpenProcess(PROCESS_QUERY_LIMITED_INFORMATION, FALSE, DWORD(process)));
    FILETIME start{}, end{}, kernel{}, user{};
    DWORD status = 0;
    if (!opened || ::GetExitCodeProcess(nativeOf(opened), &status) == FALSE ||
        status != STILL_ACTIVE ||
        ::GetProcessTimes(nativeOf(opened), &start, &end, &kernel, &user) == FALSE)
        return {};
    return std::to_string(process) + " " +
           std::to_string(std::uint64_t(start.dwHighDateTime) << 32 | start.dwLowDateTime);
}

std::filesystem::path programFile() {
    std::array<wchar_t, 32768> name{};
    const DWORD length = ::GetModuleFileNameW(nullptr, name.data(), DWORD(name.size()));
    return std::wstring(name.data(), length);
}

void setMissingVariable(const char *name, const std::string &value) {
    if (std::getenv(name) == nullptr)
        ::_putenv_s(name, value.c_str());
}

void letLongFilesFail() {}
void letBrokenPipesFail() {}

void whenAskedToEnd(std::function<void()> first, std::function<void()> second) {
    const std::lock_guard lock(endings().mutex);
    endings().first = std::move(first);
    endings().second = std::move(second);
    ::SetConsoleCtrlHandler(isAsked, TRUE);
}

std::size_t stackToUse() {
    ULONG_PTR low = 0, high = 0;
    ::GetCurrentThreadStackLimits(&low, &high);
    return (high - low) / 2;
}

void fillRandomly(std::span<std::byte> bytes) {
    if (::BCryptGenRandom(nullptr, reinterpret_cast<UCHAR *>(bytes.data()), ULONG(bytes.size()),
                          BCRYPT_USE_SYSTEM_PREFERRED_RNG) < 0)
        failWith(ERROR_GEN_FAILURE);
}

bool isTerminal(std::FILE *stream) {
    DWORD mode = 0;
    return ::GetConsoleMode(reinterpret_cast<HANDLE>(::_get_osfhandle(::_fileno(stream))), &mode) !=
           FALSE;
}

Machine thisMachine() {
    Machine machine;
    MEMORYSTATUSEX memory{};
    memory.dwLength = sizeof memory;
    if (::GlobalMemoryStatusEx(&memory) != FALSE)
        machine.memoryBytes = memory.ullTotalPhys;
    const auto registered = [](const wchar_t *key, const wchar_t *name) {
        std::array<wchar_t, 256> value{};
        DWORD size = sizeof value;
        return ::RegGetValueW(HKEY_LOCAL_MACHINE, key, name, RRF_RT_REG_SZ, nullptr, value.data(),
                              &size) == ERROR_SUCCESS
                   ? utf8(value.data())
                   : std::string();
    };
    const std::string build =
        registered(L"SOFTWARE\\Microsoft\\Windows NT\\CurrentVersion", L"CurrentBuildNumber");
    machine.system = "Windows " + build + " x86_64";
    machine.processor =
        registered(L"HARDWARE\\DESCRIPTION\\System\\CentralProcessor\\0", L"ProcessorNameString");
    return machine;
}

} // namespace pellucid::platform
