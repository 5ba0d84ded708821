// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/windows/error.h"

#include <array>
#include <cerrno>
#include <cstddef>
#include <span>
#include <vector>

#include <sddl.h>

#include "core/platform/file.h"
#include "core/platform/process.h"

namespace pellucid::platform {

std::error_code errorOf(DWORD error) {
    const auto is = [](std::errc code) { return std::make_error_code(code); };
    switch (error) { // what the standard library does not know, or knows as something else
    case ERROR_INVALID_DRIVE:
        return is(std::errc::no_such_file_or_directory);
    case ERROR_NETWORK_ACCESS_DENIED:
    case WSAEACCES:
        return is(std::errc::permission_denied);
    case ERROR_SHARING_VIOLATION:
    case ERROR_LOCK_VIOLATION:
    case ERROR_USER_MAPPED_FILE:
        return is(std::errc::text_file_busy);
    case ERROR_COMMITMENT_LIMIT:
    case ERROR_NO_SYSTEM_RESOURCES:
        return is(std::errc::not_enough_memory);
    case WSAEMFILE:
        return is(std::errc::too_many_files_open);
    case ERROR_BUFFER_OVERFLOW:
        return is(std::errc::filename_too_long);
    case ERROR_PIPE_NOT_CONNECTED:
        return is(std::errc::broken_pipe);
    case ERROR_SEEK:
    case ERROR_SECTOR_NOT_FOUND:
    case ERROR_READ_FAULT:
    case ERROR_WRITE_FAULT:
    case ERROR_GEN_FAILURE:
        return is(std::errc::io_error);
    case WSAEINVAL:
        return is(std::errc::invalid_argument);
    case WSAEADDRINUSE:
        return is(std::errc::address_in_use);
    case WSAEADDRNOTAVAIL:
        return is(std::errc::address_not_available);
    case WSAECONNREFUSED:
        return is(std::errc::connection_refused);
    case WSAECONNRESET:
        return is(std::errc::connection_reset);
    case WSAETIMEDOUT:
    case ERROR_SEM_TIMEOUT:
        return is(std::errc::timed_out);
    case WSAENETUNREACH:
        return is(std::errc::network_unreachable);
    case WSAEHOSTUNREACH:
        return is(std::errc::host_unreachable);
    default:
        break;
    }
    if (int(error) == quotaExceeded()) // it has no common name
        return {int(error), std::generic_category()};
    const std::error_code code(int(error), std::system_category());
    const std::error_condition common = code.default_error_condition();
    return common.category() == std::generic_category()
               ? std::error_code(common.value(), common.category())
               : code;
}

void failWith(DWORD error) {
    throw std::system_error(errorOf(error));
}

std::wstring longPath(const std::filesystem::path &path) {
    const std::wstring plain = path.wstring();
    if (plain.empty() || plain.starts_with(L"\\\\?\\") || plain.starts_with(L"\\\\.\\"))
        return plain;
    std::error_code unknown;
    // Without the prefix, Windows would drop dots and spaces at the end of names.
    std::wstring full =
        std::filesystem::absolute(path, unknown).lexically_normal().make_preferred().wstring();
    if (unknown)
        return plain;
    return full.starts_with(L"\\\\") ? L"\\\\?\\UNC" + full.substr(1) : L"\\\\?\\" + full;
}

std::vector<std::byte> tokenInformation(HANDLE token, TOKEN_INFORMATION_CLASS what) {
    DWORD size = 0;
    ::GetTokenInformation(token, what, nullptr, 0, &size);
    std::vector<std::byte> bytes(size);
    if (::GetTokenInformation(token, what, bytes.data(), size, &size) == FALSE)
        fail();
    return bytes;
}

std::wstring userOf(HANDLE process) {
    HANDLE token = nullptr;
    if (::OpenProcessToken(process, TOKEN_QUERY, &token) == FALSE)
        fail();
    const Handle owned = handleOf(token);
    const std::vector<std::byte> bytes = tokenInformation(token, TokenUser);
    wchar_t *text = nullptr;
    if (::ConvertSidToStringSidW(reinterpret_cast<const TOKEN_USER *>(bytes.data())->User.Sid,
                                 &text) == FALSE)
        fail();
    std::wstring user = text;
    ::LocalFree(text);
    return user;
}

PrivateSecurity::PrivateSecurity() {
    const std::wstring allowed =
        L"D:P(A;OICI;FA;;;" + userOf(::GetCurrentProcess()) + L")(A;OICI;FA;;;SY)";
    if (::ConvertStringSecurityDescriptorToSecurityDescriptorW(
            allowed.c_str(), SDDL_REVISION_1, &m_attributes.lpSecurityDescriptor, nullptr) == FALSE)
        fail();
}

PrivateSecurity::~PrivateSecurity() {
    const DWORD error = ::GetLastError(); // of what it was used for
    ::LocalFree(m_attributes.lpSecurityDescriptor);
    ::SetLastError(error);
}

void useSockets() {
    static const int started = [] {
        WSADATA about{};
        return ::WSAStartup(MAKEWORD(2, 2), &about);
    }();
    if (started != 0)
        failWith(DWORD(started));
}

std::wstring randomName(int letters) {
    std::wstring name;
    std::array<std::byte, 64> bytes{};
    fillRandomly(bytes);
    for (int n = 0; n < letters; ++n)
        name += wchar_t(L'a' + unsigned(bytes[std::size_t(n)]) % 26U);
    return name;
}

} // namespace pellucid::platform
