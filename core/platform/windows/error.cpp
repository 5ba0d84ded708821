// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/windows/error.h"

#include <array>
#include <cerrno>
#include <cstddef>
#include <span>
#include <vector>

#include <sddl.h>

#include "core/platform/process.h"

namespace pellucid::platform {

std::error_code errorOf(DWORD error) {
    const auto is = [](std::errc code) { return std::make_error_code(code); };
    switch (error) {
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_DRIVE:
    case ERROR_BAD_NETPATH:
    case ERROR_BAD_NET_NAME:
    case ERROR_INVALID_NAME:
    case ERROR_BAD_PATHNAME:
        return is(std::errc::no_such_file_or_directory);
    case ERROR_ACCESS_DENIED:
    case ERROR_NETWORK_ACCESS_DENIED:
    case WSAEACCES:
        return is(std::errc::permission_denied);
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS:
        return is(std::errc::file_exists);
    case ERROR_DISK_FULL:
    case ERROR_HANDLE_DISK_FULL:
        return is(std::errc::no_space_on_device);
    case ERROR_WRITE_PROTECT:
        return is(std::errc::read_only_file_system);
    case ERROR_SHARING_VIOLATION:
    case ERROR_LOCK_VIOLATION:
    case ERROR_USER_MAPPED_FILE:
        return is(std::errc::text_file_busy);
    case ERROR_DIRECTORY:
        return is(std::errc::not_a_directory);
    case ERROR_DIR_NOT_EMPTY:
        return is(std::errc::directory_not_empty);
    case ERROR_NOT_ENOUGH_MEMORY:
    case ERROR_OUTOFMEMORY:
    case ERROR_COMMITMENT_LIMIT:
    case ERROR_NO_SYSTEM_RESOURCES:
        return is(std::errc::not_enough_memory);
    case ERROR_TOO_MANY_OPEN_FILES:
    case WSAEMFILE:
        return is(std::errc::too_many_files_open);
    case ERROR_NOT_SAME_DEVICE:
        return is(std::errc::cross_device_link);
    case ERROR_BUFFER_OVERFLOW:
    case ERROR_FILENAME_EXCED_RANGE:
        return is(std::errc::filename_too_long);
    case ERROR_BAD_EXE_FORMAT:
        return is(std::errc::executable_format_error);
    case ERROR_BROKEN_PIPE:
    case ERROR_NO_DATA:
    case ERROR_PIPE_NOT_CONNECTED:
        return is(std::errc::broken_pipe);
    case ERROR_CRC:
    case ERROR_SEEK:
    case ERROR_SECTOR_NOT_FOUND:
    case ERROR_READ_FAULT:
    case ERROR_WRITE_FAULT:
    case ERROR_GEN_FAILURE:
    case ERROR_IO_DEVICE:
        return is(std::errc::io_error);
    case ERROR_INVALID_PARAMETER:
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
        return {int(error), std::system_category()};
    }
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

std::wstring userOf(HANDLE process) {
    HANDLE token = nullptr;
    if (::OpenProcessToken(process, TOKEN_QUERY, &token) == FALSE)
        fail();
    const Handle owned = handleOf(token);
    DWORD size = 0;
    ::GetTokenInformation(token, TokenUser, nullptr, 0, &size);
    std::vector<std::byte> bytes(size);
    wchar_t *text = nullptr;
    if (::GetTokenInformation(token, TokenUser, bytes.data(), size, &size) == FALSE ||
        ::ConvertSidToStringSidW(reinterpret_cast<TOKEN_USER *>(bytes.data())->User.Sid, &text) ==
            FALSE)
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
    ::LocalFree(m_attributes.lpSecurityDescriptor);
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
