// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/terminal.h"

#include <cstdio>
#include <mutex>

#include "core/platform/windows/error.h"

namespace pellucid::platform {

namespace {

// A console that does not show what is typed, and how it was before.
std::mutex hiding;
struct Hidden {
    HANDLE console = nullptr;
    DWORD before = 0;
};
std::optional<Hidden> hidden;

// Requires the lock.
void show() {
    if (hidden)
        ::SetConsoleMode(hidden->console, hidden->before);
    hidden.reset();
}

Handle openConsole(const wchar_t *name) {
    return handleOf(::CreateFileW(name, GENERIC_READ | GENERIC_WRITE,
                                  FILE_SHARE_READ | FILE_SHARE_WRITE, nullptr, OPEN_EXISTING, 0,
                                  nullptr));
}

void write(const Handle &console, const std::string &text) {
    DWORD written = 0;
    ::WriteConsoleA(nativeOf(console), text.data(), DWORD(text.size()), &written, nullptr);
}

// Whether a key was pressed, or the end came, before the program is to stop.
bool hasKey(const Handle &console, const std::stop_token &stop) {
    constexpr DWORD stopPollMs = 50;
    while (!stop.stop_requested())
        if (::WaitForSingleObject(nativeOf(console), stopPollMs) == WAIT_OBJECT_0)
            return true;
    return false;
}

} // namespace

HiddenAnswer askHidden(const std::string &question, const std::stop_token &stop) {
    const Handle in = openConsole(L"CONIN$"), out = openConsole(L"CONOUT$");
    DWORD shown = 0;
    if (!in || !out || ::GetConsoleMode(nativeOf(in), &shown) == FALSE)
        return {};
    {
        const std::lock_guard lock(hiding);
        hidden = {nativeOf(in), shown};
        ::SetConsoleMode(nativeOf(in), ENABLE_PROCESSED_INPUT); // key by key, and Ctrl-C ends it
    }
    write(out, question);
    HiddenAnswer answer{true, {}};
    std::wstring line;
    for (bool isComplete = false; !isComplete && hasKey(in, stop);) {
        wchar_t key = 0;
        DWORD got = 0;
        INPUT_RECORD next{};
        // Releases of keys, and the mouse, would make reading wait.
        if (::PeekConsoleInputW(nativeOf(in), &next, 1, &got) != FALSE && got == 1 &&
            (next.EventType != KEY_EVENT || next.Event.KeyEvent.bKeyDown == FALSE ||
             next.Event.KeyEvent.uChar.UnicodeChar == 0)) {
            ::ReadConsoleInputW(nativeOf(in), &next, 1, &got);
            continue;
        }
        isComplete = ::ReadConsoleW(nativeOf(in), &key, 1, &got, nullptr) == FALSE || got == 0 ||
                     key == L'\r' || key == L'\n';
        if (!isComplete && key == L'\b' && !line.empty())
            line.pop_back();
        else if (!isComplete && key != L'\b')
            line += key;
        if (isComplete) {
            std::string text(4 * line.size(), '\0');
            text.resize(std::size_t(::WideCharToMultiByte(CP_UTF8, 0, line.data(), int(line.size()),
                                                          text.data(), int(text.size()), nullptr,
                                                          nullptr)));
            answer.line = text;
        }
    }
    {
        const std::lock_guard lock(hiding);
        show();
    }
    write(out, "\r\n");
    return answer;
}

void joinTerminal() {
    // Redirected output stays redirected.
    const bool lacksOutput = ::GetStdHandle(STD_OUTPUT_HANDLE) == nullptr,
               lacksErrors = ::GetStdHandle(STD_ERROR_HANDLE) == nullptr;
    if ((!lacksOutput && !lacksErrors) || ::AttachConsole(ATTACH_PARENT_PROCESS) == FALSE)
        return;
    if (lacksOutput)
        std::freopen("CONOUT$", "wb", stdout);
    if (lacksErrors)
        std::freopen("CONOUT$", "wb", stderr);
    ::SetConsoleOutputCP(CP_UTF8);
}

void endAtOnce(int code) {
    const std::lock_guard lock(hiding); // nothing is hidden from now on
    show();
    ::TerminateProcess(::GetCurrentProcess(), UINT(code));
    std::_Exit(code);
}

} // namespace pellucid::platform
