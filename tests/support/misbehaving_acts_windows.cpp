// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/misbehaving_acts.h"

#include <array>
#include <cstdint>
#include <cstdlib>

#include "core/platform/windows/error.h"
// After windows.h.
#include <tlhelp32.h>

namespace pellucid::test {

namespace {

using platform::nativeOf;

std::error_code outcome(bool isDone) {
    return isDone ? std::error_code() : platform::errorOf(::GetLastError());
}

bool canOpen(const wchar_t *path, DWORD access, DWORD how) {
    return bool(platform::handleOf(::CreateFileW(path, access, FILE_SHARE_READ, nullptr, how,
                                                 FILE_ATTRIBUTE_NORMAL, nullptr)));
}

bool canStart() {
    std::array<wchar_t, MAX_PATH> line{L"C:\\Windows\\System32\\cmd.exe /c exit"};
    STARTUPINFOW info{};
    info.cb = sizeof info;
    PROCESS_INFORMATION started{};
    return ::CreateProcessW(nullptr, line.data(), nullptr, nullptr, FALSE, 0, nullptr, nullptr,
                            &info, &started) != FALSE;
}

bool canConnect() {
    platform::useSockets();
    const bool isMade =
        ::WSASocketW(AF_INET, SOCK_STREAM, IPPROTO_TCP, nullptr, 0, 0) != INVALID_SOCKET;
    ::SetLastError(DWORD(::WSAGetLastError()));
    return isMade;
}

// Any process that this one may end is one too many.
bool canEndAnother() {
    const platform::Handle all =
        platform::handleOf(::CreateToolhelp32Snapshot(TH32CS_SNAPPROCESS, 0));
    PROCESSENTRY32W entry{};
    entry.dwSize = sizeof entry;
    for (BOOL has = ::Process32FirstW(nativeOf(all), &entry); has != FALSE;
         has = ::Process32NextW(nativeOf(all), &entry))
        if (entry.th32ProcessID != ::GetCurrentProcessId() &&
            platform::handleOf(::OpenProcess(PROCESS_TERMINATE, FALSE, entry.th32ProcessID)))
            return true;
    ::SetLastError(ERROR_ACCESS_DENIED);
    return false;
}

} // namespace

bool systemConfines() {
    return ::GetProcAddress(::GetModuleHandleW(L"ntdll.dll"), "wine_get_version") == nullptr;
}

// The answers of a real machine are not known yet: anything but success will do.
std::vector<Forbidden> forbiddenActs() {
    return {{"open-file", ""},   {"new-file", ""}, {"unlink", ""}, {"code", ""},
            {"kill-parent", ""}, {"socket", ""},   {"program", ""}};
}

std::optional<std::error_code> attempt(std::string_view word, const platform::HelpersEnds &) {
    if (word == "open-file")
        return outcome(
            canOpen(L"C:\\Windows\\System32\\drivers\\etc\\hosts", GENERIC_READ, OPEN_EXISTING));
    if (word == "new-file")
        return outcome(canOpen(L"pwned", GENERIC_WRITE, CREATE_ALWAYS));
    if (word == "unlink")
        return outcome(::DeleteFileW(L"kept") != FALSE);
    if (word == "socket")
        return outcome(canConnect());
    if (word == "program")
        return outcome(canStart());
    if (word == "code")
        return outcome(::VirtualAlloc(nullptr, 4096, MEM_COMMIT | MEM_RESERVE,
                                      PAGE_EXECUTE_READWRITE) != nullptr);
    if (word == "kill-parent")
        return outcome(canEndAnother());
    return std::nullopt;
}

void crash() {
    ::RaiseException(DWORD(EXCEPTION_ACCESS_VIOLATION), EXCEPTION_NONCONTINUABLE, 0, nullptr);
    std::abort();
}

void beKilled() {
    ::TerminateProcess(::GetCurrentProcess(), UINT(STATUS_NO_MEMORY));
    std::abort();
}

void hang() {
    for (;;)
        work();
}

void work() {
    ::GetCurrentProcessId();
}

void writeTooLittle(const platform::Channel &channel) {
    DWORD written = 0;
    ::WriteFile(nativeOf(channel.end()), "x", 1, &written, nullptr);
}

} // namespace pellucid::test
