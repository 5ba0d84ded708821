// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/helper.h"

#include <array>
#include <cstdlib>
#include <cwchar>
#include <memory>
#include <string>
#include <vector>

#include "core/platform/memory.h"
#include "core/platform/windows/start.h"
// After windows.h.
#include <sddl.h>
#include <shellapi.h>

namespace pellucid::platform {

namespace {

constexpr std::chrono::milliseconds endPatience(500);

std::wstring keptEnvironment() {
    std::wstring kept;
    for (const wchar_t *const name :
         {L"SystemRoot", L"SystemDrive", L"windir", L"PATH", L"DCMDICTPATH"})
        if (const wchar_t *const value = ::_wgetenv(name))
            kept += std::wstring(name) + L'=' + value + L'\0';
    return kept;
}

Handle ownToken() {
    HANDLE token = nullptr;
    if (::OpenProcessToken(::GetCurrentProcess(),
                           TOKEN_DUPLICATE | TOKEN_ASSIGN_PRIMARY | TOKEN_QUERY |
                               TOKEN_ADJUST_DEFAULT | TOKEN_IMPERSONATE,
                           &token) == FALSE)
        fail();
    return handleOf(token);
}

// The helper can write nothing that this user can: only what is marked as of low integrity.
void lowerIntegrity(HANDLE token) {
    PSID low = nullptr;
    if (::ConvertStringSidToSidW(L"S-1-16-4096", &low) == FALSE)
        fail();
    TOKEN_MANDATORY_LABEL label{{low, SE_GROUP_INTEGRITY}};
    const BOOL isSet = ::SetTokenInformation(token, TokenIntegrityLevel, &label,
                                             DWORD(sizeof label + ::GetLengthSid(low)));
    const DWORD error = ::GetLastError();
    ::LocalFree(low);
    if (isSet == FALSE)
        failWith(error);
}

// The user and the groups of a token, to which objects of the system grant access.
class Members {
public:
    explicit Members(HANDLE token)
        : m_user(tokenInformation(token, TokenUser)),
          m_groups(tokenInformation(token, TokenGroups)) {}

    /// The user, and the groups without any of these attributes.
    std::vector<SID_AND_ATTRIBUTES> except(DWORD attributes) const {
        std::vector<SID_AND_ATTRIBUTES> all{
            {reinterpret_cast<const TOKEN_USER *>(m_user.data())->User.Sid, 0}};
        const auto &groups = *reinterpret_cast<const TOKEN_GROUPS *>(m_groups.data());
        for (DWORD n = 0; n < groups.GroupCount; ++n)
            if ((groups.Groups[n].Attributes & attributes) == 0)
                all.push_back({groups.Groups[n].Sid, 0});
        return all;
    }

private:
    std::vector<std::byte> m_user, m_groups;
};

// A primary token of low integrity, without privileges.
Handle restricted(const Handle &own, std::vector<SID_AND_ATTRIBUTES> denied,
                  std::vector<SID_AND_ATTRIBUTES> restricting) {
    HANDLE token = nullptr;
    if (::CreateRestrictedToken(nativeOf(own), DISABLE_MAX_PRIVILEGE, DWORD(denied.size()),
                                denied.data(), 0, nullptr, DWORD(restricting.size()),
                                restricting.data(), &token) == FALSE)
        fail();
    Handle made = handleOf(token);
    lowerIntegrity(token);
    return made;
}

// The token of a confined helper. No object of the system grants it anything, because it denies the
// user and all groups; the group of the logon session is needed for the session's objects.
Handle lastToken(const Handle &own, const Members &members) {
    PSID nobody = nullptr;
    if (::ConvertStringSidToSidW(L"S-1-0-0", &nobody) == FALSE)
        fail();
    const std::unique_ptr<void, decltype(&::LocalFree)> owned(nobody, &::LocalFree);
    return restricted(own, members.except(SE_GROUP_INTEGRITY | SE_GROUP_LOGON_ID), {{nobody, 0}});
}

// The token until then, while the helper loads its libraries, reads certificates and connects. It
// is restricted to all that the user has, because Windows lets a process with a restricted token
// impersonate only restricted tokens.
Handle firstToken(const Handle &own, const Members &members) {
    const Handle primary = restricted(own, {}, members.except(SE_GROUP_INTEGRITY));
    HANDLE token = nullptr;
    if (::DuplicateTokenEx(nativeOf(primary), TOKEN_IMPERSONATE | TOKEN_QUERY, nullptr,
                           SecurityImpersonation, TokenImpersonation, &token) == FALSE)
        fail();
    return handleOf(token);
}

std::wstring number(HandleView handle) {
    return std::to_wstring(handle.get());
}

} // namespace

Helper::Helper(const std::filesystem::path &program, HandleView file) {
    auto [own, other] = makeChannel();
    const Handle channel = inheritable(other.end());
    Handle given;
    Start how{.program = program,
              .arguments = {L"--channel=" + number(channel)},
              .inherited = {channel},
              .folder = program.parent_path(),
              .environment = keptEnvironment()};
    if (file) {
        given = inheritable(file);
        how.arguments.push_back(L"--file=" + number(given));
        how.inherited.emplace_back(given);
    }
    m_group = newJob();
    limitToOneProcess(nativeOf(m_group), freeMemoryBytes());
    const Handle user = ownToken();
    const Members members(nativeOf(user));
    const Handle last = lastToken(user, members), first = firstToken(user, members);
    how.job = nativeOf(m_group);
    how.token = nativeOf(last);
    how.firstToken = nativeOf(first);
    m_process = start(how).release();
    m_channel = std::move(own);
    m_channel.setReader(m_process);
}

Helper::Helper(Helper &&other) noexcept
    : m_process(std::exchange(other.m_process, -1)), m_group(std::move(other.m_group)),
      m_channel(std::move(other.m_channel)) {}

Helper &Helper::operator=(Helper &&other) noexcept {
    std::swap(m_process, other.m_process);
    std::swap(m_group, other.m_group);
    std::swap(m_channel, other.m_channel);
    return *this;
}

Helper::~Helper() {
    if (m_process == -1)
        return;
    const Handle process(m_process);
    ::TerminateProcess(nativeOf(process), 1);
    ::WaitForSingleObject(nativeOf(process), INFINITE); // it has files open until then
}

std::optional<Ending> Helper::ending() {
    return m_process == -1 ? Ending() : endingWithin(endPatience);
}

void Helper::endWithin(std::chrono::milliseconds patience) {
    m_channel = Channel();
    if (m_process != -1)
        endingWithin(patience);
    *this = Helper();
}

std::optional<Ending> Helper::endingWithin(std::chrono::milliseconds patience) {
    const HANDLE process = nativeOf(HandleView(m_process));
    DWORD status = 0;
    if (::WaitForSingleObject(process, DWORD(patience.count())) != WAIT_OBJECT_0 ||
        ::GetExitCodeProcess(process, &status) == FALSE)
        return std::nullopt;
    ::CloseHandle(process);
    m_process = -1;
    using How = Ending::How;
    const How how = status == endedByWatch                  ? How::tookTooLong
                    : status == DWORD(STATUS_IN_PAGE_ERROR) ? How::lostAFile
                    : status == DWORD(STATUS_NO_MEMORY)     ? How::wasKilled
                    : status >= 0xC0000000U                 ? How::crashed
                                                            : How::byItself;
    return Ending{how, long(status)};
}

std::optional<HelpersEnds> takeHelpersEnds(Given given) {
    int count = 0;
    wchar_t **const words = ::CommandLineToArgvW(::GetCommandLineW(), &count);
    Native channel = -1, file = -1;
    for (int n = 1; words != nullptr && n < count; ++n) {
        const std::wstring word = words[n];
        for (const auto &[name, number] :
             {std::pair(std::wstring(L"--channel="), &channel), {L"--file=", &file}})
            if (word.starts_with(name))
                *number = Native(std::wcstoll(word.c_str() + name.size(), nullptr, 10));
    }
    ::LocalFree(words);
    if (channel == -1 || (given == Given::channelAndFile) != (file != -1))
        return std::nullopt;
    leaveMemoryOutOfDumps();
    return HelpersEnds{Channel(Handle(channel)),
                       file == -1 ? Handle() : Handle(file, Opened::memory)};
}

} // namespace pellucid::platform
