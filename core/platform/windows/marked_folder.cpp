// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/marked_folder.h"

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "core/platform/file.h"
#include "core/platform/windows/error.h"

namespace pellucid::platform {

namespace {

namespace fs = std::filesystem;

constexpr std::wstring_view prefix = L".pellucid-";
constexpr int letters = 6;
constexpr const wchar_t *lockName = L".lock", *contentsName = L"files";

// What the lock contains. Locks may hold on one machine only, so it names the machine.
const std::string &mark() {
    static const std::string text = [] {
        std::array<char, 256> host{};
        DWORD size = DWORD(host.size());
        ::GetComputerNameA(host.data(), &size);
        return std::string("Pellucid session folder on ") + host.data() + "\n";
    }();
    return text;
}

// Nobody can rename or remove a folder that is open like this.
Handle holdFolder(const fs::path &folder) {
    return handleOf(::CreateFileW(
        longPath(folder).c_str(), FILE_LIST_DIRECTORY, FILE_SHARE_READ | FILE_SHARE_WRITE, nullptr,
        OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS | FILE_FLAG_OPEN_REPARSE_POINT, nullptr));
}

// Nobody else can open it as long as it is open; a link is not followed.
Handle openLock(const fs::path &folder, DWORD how) {
    PrivateSecurity mine;
    return handleOf(::CreateFileW(longPath(folder / lockName).c_str(), GENERIC_READ | GENERIC_WRITE,
                                  0, mine.get(), how,
                                  FILE_ATTRIBUTE_NORMAL | FILE_FLAG_OPEN_REPARSE_POINT, nullptr));
}

bool isLink(const fs::path &path) {
    const DWORD attributes = ::GetFileAttributesW(longPath(path).c_str());
    return attributes != INVALID_FILE_ATTRIBUTES &&
           (attributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0;
}

// Removes the contents, then the lock, so that a program that is killed meanwhile leaves a folder
// with a mark.
void remove(const fs::path &folder, Handle lock) {
    std::error_code failed, kept;
    for (fs::directory_iterator entry(folder, failed), end; !failed && !kept && entry != end;
         entry.increment(failed))
        if (entry->path().filename() != lockName)
            fs::remove_all(entry->path(), kept);
    lock = Handle();
    if (!failed && !kept && ::DeleteFileW(longPath(folder / lockName).c_str()) != FALSE)
        ::RemoveDirectoryW(longPath(folder).c_str());
}

// Removes a folder if a program has made it on this machine and has ended.
void removeIfAbandoned(const fs::path &folder,
                       const std::function<void(const fs::path &)> &before) {
    if (isLink(folder) || isLink(folder / lockName))
        return;
    Handle lock = openLock(folder, OPEN_EXISTING);
    if (!lock) {
        if (::GetLastError() == ERROR_FILE_NOT_FOUND)
            ::RemoveDirectoryW(longPath(folder).c_str()); // if it is empty
        return;
    }
    std::string text(mark().size() + 1, '\0');
    text.resize(readAt(lock, 0, std::as_writable_bytes(std::span(text))));
    if (text == mark()) {
        if (before)
            before(folder / contentsName);
        remove(folder, std::move(lock));
    } else if (text.empty()) { // killed when it had just begun
        lock = Handle();
        ::DeleteFileW(longPath(folder / lockName).c_str());
        ::RemoveDirectoryW(longPath(folder).c_str());
    }
}

} // namespace

// By its name either way: others cannot rename a folder that is open.
MarkedFolder::MarkedFolder(const fs::path &parent, Path) {
    const std::wstring name = std::wstring(prefix) + randomName(letters);
    const fs::path folder = parent / name;
    PrivateSecurity mine;
    if (::CreateDirectoryW(longPath(folder).c_str(), mine.get()) == FALSE)
        fail();
    m_lock = openLock(folder, CREATE_NEW);
    if (!m_lock) {
        const std::error_code error =
            ::GetLastError() == ERROR_PATH_NOT_FOUND
                ? std::make_error_code(std::errc::resource_unavailable_try_again)
                : errorOf(::GetLastError());
        ::RemoveDirectoryW(longPath(folder).c_str());
        throw std::system_error(error);
    }
    try {
        writeAll(m_lock, std::as_bytes(std::span(mark())));
        m_path = folder / contentsName;
        if (::CreateDirectoryW(longPath(m_path).c_str(), nullptr) == FALSE)
            fail();
        m_contents = holdFolder(m_path);
        if (!m_contents)
            fail();
    } catch (...) {
        remove(folder, std::move(m_lock));
        throw;
    }
}

MarkedFolder::~MarkedFolder() {
    if (!m_contents || m_isAbandoned)
        return;
    m_contents = Handle();
    remove(m_path.parent_path(), std::move(m_lock)); // else the next program tries again
}

MarkedFolder &MarkedFolder::operator=(MarkedFolder &&other) noexcept {
    std::swap(m_parent, other.m_parent);
    std::swap(m_folder, other.m_folder);
    std::swap(m_lock, other.m_lock);
    std::swap(m_contents, other.m_contents);
    std::swap(m_name, other.m_name);
    std::swap(m_path, other.m_path);
    std::swap(m_isAbandoned, other.m_isAbandoned);
    return *this;
}

void removeAbandonedFolders(const fs::path &parent,
                            const std::function<void(const fs::path &)> &before) {
    std::error_code failed;
    std::vector<fs::path> found;
    for (fs::directory_iterator entry(parent, failed), end; !failed && entry != end;
         entry.increment(failed))
        if (const std::wstring name = entry->path().filename().wstring();
            name.size() == prefix.size() + letters && name.starts_with(prefix))
            found.push_back(entry->path());
    for (const fs::path &folder : found)
        removeIfAbandoned(folder, before);
}

} // namespace pellucid::platform
