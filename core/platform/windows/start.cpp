// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/windows/start.h"

#include <cstddef>

namespace pellucid::platform {

namespace {

// As CommandLineToArgvW takes it apart.
std::wstring quoted(const std::wstring &word) {
    std::wstring text = L"\"";
    std::size_t backslashes = 0;
    for (const wchar_t c : word) {
        if (c == L'"')
            text.append(backslashes + 1, L'\\');
        backslashes = c == L'\\' ? backslashes + 1 : 0;
        text += c;
    }
    text.append(backslashes, L'\\');
    return text + L'"';
}

} // namespace

Handle newJob() {
    Handle job = handleOf(::CreateJobObjectW(nullptr, nullptr));
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
    if (!job || ::SetInformationJobObject(nativeOf(job), JobObjectExtendedLimitInformation, &limits,
                                          sizeof limits) == FALSE)
        fail();
    return job;
}

void limitToOneProcess(HANDLE job, std::size_t memoryBytes) {
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    if (::QueryInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof limits,
                                    nullptr) == FALSE)
        fail();
    limits.BasicLimitInformation.LimitFlags |= JOB_OBJECT_LIMIT_ACTIVE_PROCESS |
                                               JOB_OBJECT_LIMIT_PROCESS_MEMORY |
                                               JOB_OBJECT_LIMIT_DIE_ON_UNHANDLED_EXCEPTION;
    limits.BasicLimitInformation.ActiveProcessLimit = 1;
    limits.ProcessMemoryLimit = memoryBytes;
    JOBOBJECT_BASIC_UI_RESTRICTIONS window{
        JOB_OBJECT_UILIMIT_DESKTOP | JOB_OBJECT_UILIMIT_DISPLAYSETTINGS |
        JOB_OBJECT_UILIMIT_EXITWINDOWS | JOB_OBJECT_UILIMIT_GLOBALATOMS |
        JOB_OBJECT_UILIMIT_HANDLES | JOB_OBJECT_UILIMIT_READCLIPBOARD |
        JOB_OBJECT_UILIMIT_SYSTEMPARAMETERS | JOB_OBJECT_UILIMIT_WRITECLIPBOARD};
    if (::SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof limits) ==
        FALSE)
        fail();
    ::SetInformationJobObject(job, JobObjectBasicUIRestrictions, &window, sizeof window);
}

Handle inheritable(HandleView handle) {
    HANDLE copy = nullptr;
    if (::DuplicateHandle(::GetCurrentProcess(), nativeOf(handle), ::GetCurrentProcess(), &copy, 0,
                          TRUE, DUPLICATE_SAME_ACCESS) == FALSE)
        fail();
    return handleOf(copy, handle.what());
}

Handle start(const Start &start) {
    std::vector<HANDLE> inherited;
    for (const HandleView &each : start.inherited)
        inherited.push_back(nativeOf(each));
    SIZE_T size = 0;
    ::InitializeProcThreadAttributeList(nullptr, 1, 0, &size);
    std::vector<std::byte> bytes(size);
    auto *const attributes = reinterpret_cast<LPPROC_THREAD_ATTRIBUTE_LIST>(bytes.data());
    if (::InitializeProcThreadAttributeList(attributes, 1, 0, &size) == FALSE ||
        ::UpdateProcThreadAttribute(attributes, 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST,
                                    inherited.data(), inherited.size() * sizeof(HANDLE), nullptr,
                                    nullptr) == FALSE)
        fail();
    STARTUPINFOEXW info{};
    info.StartupInfo.cb = sizeof info;
    info.lpAttributeList = attributes;
    if (start.input != nullptr) {
        info.StartupInfo.dwFlags = STARTF_USESTDHANDLES;
        info.StartupInfo.hStdInput = start.input;
        info.StartupInfo.hStdOutput = start.errors;
        info.StartupInfo.hStdError = start.errors;
    }
    std::wstring line = quoted(start.program.wstring());
    for (const std::wstring &argument : start.arguments)
        line += L' ' + quoted(argument);
    std::wstring environment = start.environment + L'\0';
    // A hidden console would be run by a process of its own, for which a weak token is not enough.
    const DWORD console = start.token != nullptr ? DETACHED_PROCESS : CREATE_NO_WINDOW;
    const DWORD flags =
        CREATE_SUSPENDED | console | CREATE_UNICODE_ENVIRONMENT | EXTENDED_STARTUPINFO_PRESENT;
    const std::wstring program = longPath(start.program), folder = start.folder.wstring();
    void *const variables = start.environment.empty() ? nullptr : environment.data();
    const wchar_t *const in = folder.empty() ? nullptr : folder.c_str();
    PROCESS_INFORMATION started{};
    const BOOL isStarted =
        start.token != nullptr
            ? ::CreateProcessAsUserW(start.token, program.c_str(), line.data(), nullptr, nullptr,
                                     TRUE, flags, variables, in, &info.StartupInfo, &started)
            : ::CreateProcessW(program.c_str(), line.data(), nullptr, nullptr, TRUE, flags,
                               variables, in, &info.StartupInfo, &started);
    const DWORD error = ::GetLastError();
    ::DeleteProcThreadAttributeList(attributes);
    if (isStarted == FALSE)
        failWith(error);
    Handle process = handleOf(started.hProcess);
    const Handle thread = handleOf(started.hThread);
    HANDLE first = started.hThread;
    if (::AssignProcessToJobObject(start.job, started.hProcess) == FALSE ||
        (start.firstToken != nullptr && ::SetThreadToken(&first, start.firstToken) == FALSE) ||
        ::ResumeThread(started.hThread) == DWORD(-1)) {
        const DWORD reason = ::GetLastError();
        ::TerminateProcess(started.hProcess, 1);
        failWith(reason);
    }
    return process;
}

} // namespace pellucid::platform
