// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <winsock2.h>
// After it.
#include <windows.h>

#include "core/platform/handle.h"

namespace pellucid::platform {

/// Converts an error of Windows or Winsock. Those with a POSIX equivalent become that.
std::error_code errorOf(DWORD error);
[[noreturn]] void failWith(DWORD error);
[[noreturn]] inline void fail() {
    failWith(::GetLastError());
}

inline HANDLE nativeOf(HandleView handle) {
    return reinterpret_cast<HANDLE>(handle.get());
}
inline SOCKET socketOf(HandleView handle) {
    return SOCKET(handle.get());
}
/// Owns a native handle; NULL and INVALID_HANDLE_VALUE become an empty one.
inline Handle handleOf(HANDLE native, Opened what = Opened::file) {
    return Handle(native == nullptr ? -1 : reinterpret_cast<Native>(native), what);
}

/// A path for Windows: it may have more than 260 characters, end in a dot, or be named as a device
/// is.
std::wstring longPath(const std::filesystem::path &path);

/// Who may use a new object: this user and the system alone.
class PrivateSecurity {
public:
    PrivateSecurity();
    ~PrivateSecurity();
    PrivateSecurity(const PrivateSecurity &) = delete;
    PrivateSecurity &operator=(const PrivateSecurity &) = delete;
    SECURITY_ATTRIBUTES *get() { return &m_attributes; }

private:
    SECURITY_ATTRIBUTES m_attributes{sizeof(SECURITY_ATTRIBUTES), nullptr, FALSE};
};

/// Reads a structure of Windows that describes a token. *Throws* std::system_error.
std::vector<std::byte> tokenInformation(HANDLE token, TOKEN_INFORMATION_CLASS what);
/// The user of a process's token, as text. *Throws* std::system_error.
std::wstring userOf(HANDLE process);

/// Starts Winsock, once.
void useSockets();

/// Random lower-case letters, at most 64, for a unique name. *Throws* std::system_error.
std::wstring randomName(int letters);

} // namespace pellucid::platform
