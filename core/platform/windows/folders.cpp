// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/folders.h"

#include <cstdlib>

#include "core/platform/windows/error.h"
// After windows.h.
#include <shlobj.h>

namespace pellucid::platform {

namespace {

// The place that a variable names, as on other systems, or one of this user on this machine.
std::optional<std::filesystem::path> userPath(const wchar_t *variable, const char *name) {
    if (const wchar_t *const value = ::_wgetenv(variable);
        value != nullptr && std::filesystem::path(value).is_absolute())
        return std::filesystem::path(value) / "pellucid";
    wchar_t *found = nullptr;
    std::optional<std::filesystem::path> path;
    if (::SHGetKnownFolderPath(FOLDERID_LocalAppData, 0, nullptr, &found) == S_OK)
        path = std::filesystem::path(found) / "Pellucid" / name;
    ::CoTaskMemFree(found);
    return path;
}

} // namespace

std::optional<std::filesystem::path> userCachePath() {
    return userPath(L"XDG_CACHE_HOME", "Cache");
}

std::optional<std::filesystem::path> userDataPath() {
    return userPath(L"XDG_DATA_HOME", "Data");
}

void makePrivateFolder(const std::filesystem::path &folder) {
    PrivateSecurity mine;
    if (::CreateDirectoryW(longPath(folder).c_str(), mine.get()) == FALSE)
        fail();
}

bool exchange(const std::filesystem::path &, const std::filesystem::path &) {
    return false;
}

} // namespace pellucid::platform
