// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/new_file.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fcntl.h>
#include <io.h>
#include <optional>
#include <vector>

#include "core/platform/file.h"
#include "core/platform/windows/error.h"

namespace pellucid::platform {

namespace {

// The leading dot hides an unfinished file from scans of folders.
std::filesystem::path hiddenNameFor(const std::filesystem::path &path) {
    return path.parent_path() / (L"." + path.filename().wstring() + L"." + randomName(8));
}

HANDLE ownOf(std::FILE *file) {
    return reinterpret_cast<HANDLE>(::_get_osfhandle(::_fileno(file)));
}

// A file that is to be deleted goes with its last handle, also if the program is killed; until then
// nobody can open it.
bool setDeleted(HANDLE file, bool isDeleted) {
    FILE_DISPOSITION_INFO disposition{BOOLEAN(isDeleted)};
    return ::SetFileInformationByHandle(file, FileDispositionInfo, &disposition,
                                        sizeof disposition) != FALSE;
}

// *Returns* the error; 0: it has the name now.
DWORD renameTo(HANDLE file, const std::filesystem::path &path) {
    const std::wstring name = longPath(path);
    std::vector<std::byte> bytes(sizeof(FILE_RENAME_INFO) + sizeof(wchar_t) * name.size());
    auto *const request = reinterpret_cast<FILE_RENAME_INFO *>(bytes.data());
    request->FileNameLength = DWORD(sizeof(wchar_t) * name.size());
    std::copy(name.begin(), name.end(), request->FileName);
    const auto isRenamed = [&](FILE_INFO_BY_HANDLE_CLASS how) {
        return ::SetFileInformationByHandle(file, how, request, DWORD(bytes.size())) != FALSE;
    };
    // As on POSIX: also in place of a file that others have open, if they share its deletion. Not
    // every file system can do that.
    constexpr auto renameInfoEx = FILE_INFO_BY_HANDLE_CLASS(22);
    constexpr DWORD replace = 1, posixSemantics = 2;
    const DWORD flags = replace | posixSemantics;
    std::memcpy(bytes.data(), &flags, sizeof flags);
    if (isRenamed(renameInfoEx))
        return 0;
    std::memset(bytes.data(), 0, sizeof flags);
    request->ReplaceIfExists = TRUE;
    return isRenamed(FileRenameInfo) ? 0 : ::GetLastError();
}

// Windows reports "access denied" for a file that another program has open: report that instead.
DWORD reasonFor(DWORD error, const std::filesystem::path &path) {
    if (error != ERROR_ACCESS_DENIED)
        return error;
    const Handle there = handleOf(::CreateFileW(
        longPath(path).c_str(), DELETE, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
        nullptr, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr));
    return !there && ::GetLastError() == ERROR_SHARING_VIOLATION ? ERROR_SHARING_VIOLATION : error;
}

} // namespace

NewFile::NewFile(const std::filesystem::path &path, Readers readers)
    : m_mode(readers == Readers::user ? 0600 : 0666), m_temporary(hiddenNameFor(path)) {
    std::optional<PrivateSecurity> mine;
    if (readers == Readers::user)
        mine.emplace();
    Handle file = handleOf(
        ::CreateFileW(longPath(m_temporary).c_str(), GENERIC_READ | GENERIC_WRITE | DELETE,
                      FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                      mine ? mine->get() : nullptr, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr));
    if (!file)
        fail();
    setDeleted(nativeOf(file), true);
    HANDLE shared = nullptr;
    if (::DuplicateHandle(::GetCurrentProcess(), nativeOf(file), ::GetCurrentProcess(), &shared,
                          FILE_GENERIC_READ | FILE_GENERIC_WRITE, FALSE, 0) == FALSE)
        fail();
    m_shared = handleOf(shared);
    const int descriptor = ::_open_osfhandle(file.get(), _O_BINARY);
    m_file = descriptor >= 0 ? ::_fdopen(descriptor, "wb") : nullptr;
    if (m_file == nullptr)
        throw std::system_error(errno, std::generic_category());
    file.release();
}

NewFile::~NewFile() {
    if (m_file == nullptr)
        return;
    setDeleted(ownOf(m_file), true);
    std::fclose(m_file);
}

HandleView NewFile::view() const {
    return m_shared;
}

std::filesystem::path NewFile::currentPath() const {
    setDeleted(ownOf(m_file), false);
    return m_temporary;
}

void NewFile::publish(const std::filesystem::path &path, bool mustLast) {
    if (std::fflush(m_file) != 0)
        throw std::system_error(errno, std::generic_category());
    const HANDLE file = ownOf(m_file);
    if ((mustLast && ::FlushFileBuffers(file) == FALSE) || !setDeleted(file, false))
        fail();
    if (const DWORD error = renameTo(file, path); error != 0)
        failWith(reasonFor(error, path));
    std::fclose(m_file);
    m_file = nullptr;
    m_shared = Handle();
}

std::uint64_t copyStart(HandleView from, HandleView to, std::uint64_t bytes) {
    std::vector<std::byte> buffer(std::size_t(1) << 20);
    std::uint64_t at = 0;
    while (at < bytes) {
        const auto wanted = std::size_t(std::min<std::uint64_t>(buffer.size(), bytes - at));
        const std::size_t got = readAt(from, at, std::span(buffer).first(wanted));
        if (got == 0)
            break;
        writeAll(to, std::span(buffer).first(got));
        at += got;
    }
    return at;
}

void renameFlushed(const std::filesystem::path &from, const std::filesystem::path &to) {
    const Handle file =
        handleOf(::CreateFileW(longPath(from).c_str(), GENERIC_READ | GENERIC_WRITE | DELETE,
                               FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                               OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr));
    if (!file || ::FlushFileBuffers(nativeOf(file)) == FALSE)
        fail();
    if (const DWORD error = renameTo(nativeOf(file), to); error != 0)
        failWith(reasonFor(error, to));
}

// Windows keeps its own folders consistent; only the administrator may flush a whole disk.
void flushFolder(const std::filesystem::path &folder) {
    std::error_code failed;
    for (std::filesystem::directory_iterator entry(folder, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        const Handle file =
            handleOf(::CreateFileW(longPath(entry->path()).c_str(), GENERIC_WRITE,
                                   FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                                   OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr));
        if (file && ::FlushFileBuffers(nativeOf(file)) == FALSE)
            fail();
    }
    if (failed)
        throw std::system_error(failed);
}

void requireWritable(const std::filesystem::path &folder) {
    const Handle probe = handleOf(::CreateFileW(
        longPath(folder / (L"." + randomName(12))).c_str(), GENERIC_WRITE | DELETE, 0, nullptr,
        CREATE_NEW, FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE, nullptr));
    if (!probe)
        fail();
}

// Windows has no folder where anybody may make links, as /tmp is.
bool isForeignLink(const std::filesystem::path &) {
    return false;
}

} // namespace pellucid::platform
