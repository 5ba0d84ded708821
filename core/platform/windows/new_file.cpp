// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/new_file.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <fcntl.h>
#include <io.h>
#include <optional>
#include <vector>

#include "core/platform/windows/error.h"

namespace pellucid::platform {

namespace {

// The leading dot hides an unfinished file from scans of folders.
std::filesystem::path hiddenNameFor(const std::filesystem::path &path) {
    return path.parent_path() / (L"." + path.filename().wstring() + L"." + randomName(8));
}

// A file that is to be deleted goes with its last handle, also if the program is killed; until then
// nobody can open it.
bool setDeleted(HANDLE file, bool isDeleted) {
    FILE_DISPOSITION_INFO disposition{BOOLEAN(isDeleted)};
    return ::SetFileInformationByHandle(file, FileDispositionInfo, &disposition,
                                        sizeof disposition) != FALSE;
}

// *Shape*: the error; 0: it has the name now.
DWORD renameTo(HANDLE file, const std::filesystem::path &path) {
    const std::wstring name = longPath(path);
    std::vector<std::byte> bytes(sizeof(FILE_RENAME_INFO) + sizeof(wchar_t) * name.size());
    auto *const request = reinterpret_cast<FILE_RENAME_INFO *>(bytes.data());
    request->ReplaceIfExists = TRUE;
    request->FileNameLength = DWORD(sizeof(wchar_t) * name.size());
    std::copy(name.begin(), name.end(), request->FileName);
    return ::SetFileInformationByHandle(file, FileRenameInfo, request, DWORD(bytes.size())) != FALSE
               ? 0
               : ::GetLastError();
}

// Windows denies access to a file that another program has open; the user is told which it is.
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
    const int descriptor = ::_open_osfhandle(file.get(), _O_BINARY);
    m_file = descriptor >= 0 ? ::_fdopen(descriptor, "wb") : nullptr;
    if (m_file == nullptr)
        throw std::system_error(errno, std::generic_category());
    file.release();
}

NewFile::~NewFile() {
    if (m_file == nullptr)
        return;
    setDeleted(nativeOf(view()), true);
    std::fclose(m_file);
}

HandleView NewFile::view() const {
    return HandleView(::_get_osfhandle(::_fileno(m_file)));
}

std::filesystem::path NewFile::currentPath() const {
    setDeleted(nativeOf(view()), false);
    return m_temporary;
}

void NewFile::publish(const std::filesystem::path &path, bool mustLast) {
    if (std::fflush(m_file) != 0)
        throw std::system_error(errno, std::generic_category());
    const HANDLE file = nativeOf(view());
    if ((mustLast && ::FlushFileBuffers(file) == FALSE) || !setDeleted(file, false))
        fail();
    if (const DWORD error = renameTo(file, path); error != 0)
        failWith(reasonFor(error, path));
    std::fclose(m_file);
    m_file = nullptr;
}

std::uint64_t copyStart(HandleView from, HandleView to, std::uint64_t bytes) {
    std::vector<std::byte> buffer(std::size_t(1) << 20);
    std::uint64_t at = 0;
    while (at < bytes) {
        OVERLAPPED place{};
        place.Offset = DWORD(at);
        place.OffsetHigh = DWORD(at >> 32);
        DWORD got = 0, written = 0;
        const auto wanted = DWORD(std::min<std::uint64_t>(buffer.size(), bytes - at));
        if (::ReadFile(nativeOf(from), buffer.data(), wanted, &got, &place) == FALSE) {
            if (::GetLastError() != ERROR_HANDLE_EOF)
                fail();
            break;
        }
        if (got == 0)
            break;
        if (::WriteFile(nativeOf(to), buffer.data(), got, &written, nullptr) == FALSE ||
            written != got)
            fail();
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

// Only administrators make links.
bool isForeignLink(const std::filesystem::path &) {
    return false;
}

} // namespace pellucid::platform
