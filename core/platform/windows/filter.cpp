// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/filter.h"

#include <algorithm>
#include <array>

#include "core/platform/windows/start.h"

namespace pellucid::platform {

// A pipe with two ends of its own: only a named one can be written without waiting.
Filter::Filter(const std::filesystem::path &program, const std::vector<std::string> &arguments,
               const MarkedFolder &folder, const std::string &messages) {
    constexpr DWORD pipeBytes = 1 << 20;
    const std::wstring name = L"\\\\.\\pipe\\pellucid-" + randomName(32);
    PrivateSecurity mine;
    m_input = handleOf(::CreateNamedPipeW(
        name.c_str(), PIPE_ACCESS_OUTBOUND | FILE_FLAG_OVERLAPPED | FILE_FLAG_FIRST_PIPE_INSTANCE,
        PIPE_TYPE_BYTE | PIPE_REJECT_REMOTE_CLIENTS, 1, pipeBytes, pipeBytes, 0, mine.get()));
    if (!m_input)
        fail();
    SECURITY_ATTRIBUTES inherited{sizeof inherited, nullptr, TRUE};
    const Handle input = handleOf(
        ::CreateFileW(name.c_str(), GENERIC_READ, 0, &inherited, OPEN_EXISTING, 0, nullptr));
    const Handle errors =
        handleOf(::CreateFileW(longPath(folder.path() / messages).c_str(), GENERIC_WRITE,
                               FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, &inherited,
                               CREATE_ALWAYS, FILE_ATTRIBUTE_NORMAL, nullptr));
    if (!input || !errors)
        fail();
    m_group = newJob();
    std::vector<std::wstring> words;
    for (const std::string &argument : arguments)
        words.push_back(std::filesystem::path(argument).wstring());
    m_process = start({.program = program,
                       .arguments = words,
                       .inherited = {input, errors},
                       .input = nativeOf(input),
                       .errors = nativeOf(errors),
                       .folder = folder.path(),
                       .environment = {},
                       .job = nativeOf(m_group)})
                    .release();
}

Filter::~Filter() {
    if (m_process == -1)
        return;
    const Handle process(m_process);
    ::TerminateJobObject(nativeOf(m_group), 1);         // with the processes that it has started
    ::WaitForSingleObject(nativeOf(process), INFINITE); // it has files open until then
}

std::size_t Filter::write(std::span<const std::byte> bytes, int milliseconds) {
    constexpr std::size_t most = 1 << 18; // less than the pipe holds: none is read in part
    const Handle event = handleOf(::CreateEventW(nullptr, TRUE, FALSE, nullptr));
    OVERLAPPED state{};
    state.hEvent = nativeOf(event);
    DWORD written = 0;
    if (::WriteFile(nativeOf(m_input), bytes.data(), DWORD(std::min(bytes.size(), most)), nullptr,
                    &state) == FALSE &&
        ::GetLastError() != ERROR_IO_PENDING)
        fail();
    if (::WaitForSingleObject(state.hEvent, DWORD(milliseconds)) != WAIT_OBJECT_0)
        ::CancelIoEx(nativeOf(m_input), &state);
    if (::GetOverlappedResult(nativeOf(m_input), &state, &written, TRUE) == FALSE &&
        ::GetLastError() != ERROR_OPERATION_ABORTED)
        fail();
    return written;
}

std::optional<bool> Filter::ended() {
    const HANDLE process = nativeOf(HandleView(m_process));
    DWORD status = 1;
    if (m_process != -1) {
        if (::WaitForSingleObject(process, 0) != WAIT_OBJECT_0)
            return std::nullopt;
        ::GetExitCodeProcess(process, &status);
        ::CloseHandle(process);
    }
    m_process = -1;
    return status == 0;
}

std::filesystem::path findOnSearchPath(const std::string &name) {
    std::array<wchar_t, 32768> found{};
    const DWORD length = ::SearchPathW(::_wgetenv(L"PATH"), std::filesystem::path(name).c_str(),
                                       L".exe", DWORD(found.size()), found.data(), nullptr);
    return std::wstring(found.data(), length < found.size() ? length : 0);
}

} // namespace pellucid::platform
