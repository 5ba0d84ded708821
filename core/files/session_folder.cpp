// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/session_folder.h"

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <system_error>
#include <unistd.h>

#include "core/files/user_folders.h"
#include "core/task/error.h"

namespace pellucid::files {

namespace {

namespace fs = std::filesystem;

std::optional<fs::path> sessionsFolder() {
    const auto cache = userCacheFolder();
    if (!cache)
        return std::nullopt;
    std::error_code failed;
    fs::create_directories(*cache / "sessions", failed);
    return failed ? std::nullopt : std::optional(*cache / "sessions");
}

// The process that a folder "1234-XXXXXX" belongs to; 0 if it is none of ours.
pid_t ownerOf(const std::string &name) {
    pid_t owner = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), owner);
    return error == std::errc() && *end == '-' ? owner : 0;
}

} // namespace

SessionFolder::SessionFolder() {
    const auto sessions = sessionsFolder();
    if (!sessions)
        throw task::Error(task::ErrorCode::output, "there is no folder for temporary files");
    std::string name = (*sessions / (std::to_string(getpid()) + "-XXXXXX")).string();
    // Made for the user alone.
    if (mkdtemp(name.data()) == nullptr)
        throw task::Error(task::ErrorCode::output, std::strerror(errno), *sessions);
    m_path = name;
}

SessionFolder::~SessionFolder() {
    std::error_code ignored;
    fs::remove_all(m_path, ignored);
}

bool isInSessionFolder(const fs::path &path) {
    const auto sessions = sessionsFolder();
    return sessions && path.string().starts_with(sessions->string() + "/");
}

void removeAbandonedSessionFolders() {
    const auto sessions = sessionsFolder();
    if (!sessions)
        return;
    std::error_code failed;
    for (fs::directory_iterator entry(*sessions, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        const pid_t owner = ownerOf(entry->path().filename().string());
        std::error_code ignored;
        if (owner > 0 && kill(owner, 0) != 0 && errno == ESRCH)
            fs::remove_all(entry->path(), ignored);
    }
}

} // namespace pellucid::files
