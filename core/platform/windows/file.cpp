// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/file.h"

#include <algorithm>
#include <limits>

#include "core/platform/windows/error.h"

namespace pellucid::platform {

namespace {

OVERLAPPED placeAt(std::uint64_t from) {
    OVERLAPPED place{};
    place.Offset = DWORD(from);
    place.OffsetHigh = DWORD(from >> 32);
    return place;
}

DWORD atOnce(std::size_t bytes) {
    return DWORD(std::min<std::size_t>(bytes, 1U << 30));
}

std::size_t orEnd(BOOL isRead, DWORD got) {
    if (isRead == FALSE && ::GetLastError() != ERROR_HANDLE_EOF &&
        ::GetLastError() != ERROR_BROKEN_PIPE)
        fail();
    return isRead == FALSE ? 0 : got;
}

} // namespace

Handle::~Handle() {
    if (m_native == -1)
        return;
    if (m_what == Opened::socket)
        ::closesocket(SOCKET(m_native));
    else
        ::CloseHandle(reinterpret_cast<HANDLE>(m_native));
}

std::filesystem::path pathByName(const std::filesystem::path &path) {
    return path;
}

int quotaExceeded() {
    constexpr int diskQuotaExceeded = 1295; // which mingw's header lacks
    return diskQuotaExceeded;
}

bool isSameName(const std::filesystem::path &a, const std::filesystem::path &b) {
    const std::wstring &one = a.native(), &other = b.native();
    return ::CompareStringOrdinal(one.data(), int(one.size()), other.data(), int(other.size()),
                                  TRUE) == CSTR_EQUAL;
}

// The standard library's iterator knows neither long paths nor junctions.
std::error_code listFolder(const std::filesystem::path &folder,
                           const std::function<void(const Entry &)> &take) {
    WIN32_FIND_DATAW found{};
    const HANDLE search =
        ::FindFirstFileExW((longPath(folder) + L"\\*").c_str(), FindExInfoBasic, &found,
                           FindExSearchNameMatch, nullptr, FIND_FIRST_EX_LARGE_FETCH);
    if (search == INVALID_HANDLE_VALUE)
        return errorOf(::GetLastError());
    do {
        const std::wstring name = found.cFileName;
        if (name == L"." || name == L"..")
            continue;
        const auto has = [&](DWORD attribute) { return (found.dwFileAttributes & attribute) != 0; };
        // Names that are no Unicode cannot become texts.
        const bool isText =
            ::WideCharToMultiByte(CP_UTF8, WC_ERR_INVALID_CHARS, name.data(), int(name.size()),
                                  nullptr, 0, nullptr, nullptr) > 0;
        take({folder / (isText ? name : L"?"),
              !isText || has(FILE_ATTRIBUTE_DEVICE) ? Entry::Kind::other
              : has(FILE_ATTRIBUTE_DIRECTORY)       ? Entry::Kind::folder
                                                    : Entry::Kind::file,
              has(FILE_ATTRIBUTE_REPARSE_POINT) && IsReparseTagNameSurrogate(found.dwReserved0)});
    } while (::FindNextFileW(search, &found) != FALSE);
    const DWORD error = ::GetLastError();
    ::FindClose(search);
    return error == ERROR_NO_MORE_FILES ? std::error_code() : errorOf(error);
}

std::size_t longestStreamPath() {
    return 240; // of MAX_PATH, which leaves room for the names of unfinished files
}

std::optional<FileId> fileIdOf(const std::filesystem::path &path) {
    const Handle file = handleOf(::CreateFileW(
        longPath(path).c_str(), 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
        OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr));
    BY_HANDLE_FILE_INFORMATION about{};
    if (!file || ::GetFileInformationByHandle(nativeOf(file), &about) == FALSE)
        return std::nullopt;
    return FileId{about.dwVolumeSerialNumber,
                  std::uint64_t(about.nFileIndexHigh) << 32 | about.nFileIndexLow};
}

FileFacts factsOf(const Handle &file) {
    BY_HANDLE_FILE_INFORMATION about{};
    FILE_BASIC_INFO times{};
    if (::GetFileInformationByHandle(nativeOf(file), &about) == FALSE ||
        ::GetFileInformationByHandleEx(nativeOf(file), FileBasicInfo, &times, sizeof times) ==
            FALSE)
        fail();
    // Ticks since 1601. Some file systems know only when the content changed.
    constexpr std::int64_t nanosecondsPerTick = 100, ticksTo1970 = 116'444'736'000'000'000;
    const LARGE_INTEGER &changed =
        times.ChangeTime.QuadPart != 0 ? times.ChangeTime : times.LastWriteTime;
    const bool isRegular =
        ::GetFileType(nativeOf(file)) == FILE_TYPE_DISK &&
        (about.dwFileAttributes & (FILE_ATTRIBUTE_DIRECTORY | FILE_ATTRIBUTE_DEVICE)) == 0;
    return {isRegular, std::uint64_t(about.nFileSizeHigh) << 32 | about.nFileSizeLow,
            (changed.QuadPart - ticksTo1970) * nanosecondsPerTick};
}

Handle openForReading(const std::filesystem::path &path) {
    Handle file =
        handleOf(::CreateFileW(longPath(path).c_str(), GENERIC_READ,
                               FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                               OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr));
    if (!file)
        fail();
    return file;
}

std::size_t readSome(HandleView file, std::span<std::byte> to) {
    DWORD got = 0;
    const BOOL isRead = ::ReadFile(nativeOf(file), to.data(), atOnce(to.size()), &got, nullptr);
    return orEnd(isRead, got);
}

// ReadFile moves the position even with an offset.
std::size_t readAt(HandleView file, std::uint64_t from, std::span<std::byte> to) {
    LARGE_INTEGER before{};
    const bool isKnown =
        ::SetFilePointerEx(nativeOf(file), LARGE_INTEGER{}, &before, FILE_CURRENT) != FALSE;
    OVERLAPPED place = placeAt(from);
    DWORD got = 0;
    const BOOL isRead = ::ReadFile(nativeOf(file), to.data(), atOnce(to.size()), &got, &place);
    const std::size_t bytes = orEnd(isRead, got);
    if (isKnown)
        ::SetFilePointerEx(nativeOf(file), before, nullptr, FILE_BEGIN);
    return bytes;
}

void writeAll(HandleView file, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        DWORD written = 0;
        if (::WriteFile(nativeOf(file), bytes.data(), atOnce(bytes.size()), &written, nullptr) ==
                FALSE ||
            written == 0)
            fail();
        bytes = bytes.subspan(written);
    }
}

Handle openOrCreate(const std::filesystem::path &path) {
    PrivateSecurity mine;
    return handleOf(::CreateFileW(longPath(path).c_str(), GENERIC_READ | GENERIC_WRITE,
                                  FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                                  mine.get(), OPEN_ALWAYS, FILE_ATTRIBUTE_NORMAL, nullptr));
}

// A byte far beyond the end, so that the contents can be read all the same.
bool lock(const Handle &file, Lock how) {
    OVERLAPPED place = placeAt(std::numeric_limits<std::int64_t>::max() - 1);
    const DWORD flags =
        LOCKFILE_EXCLUSIVE_LOCK | (how == Lock::attempt ? LOCKFILE_FAIL_IMMEDIATELY : 0);
    if (::LockFileEx(nativeOf(file), flags, 0, 1, 0, &place) != FALSE)
        return true;
    if (::GetLastError() == ERROR_LOCK_VIOLATION || ::GetLastError() == ERROR_IO_PENDING)
        return false;
    fail();
}

std::span<std::byte> map(HandleView file, std::size_t bytes, Access access) {
    Handle section;
    HANDLE mapped = nativeOf(file);
    if (file.what() != Opened::memory) {
        section = handleOf(::CreateFileMappingW(
            mapped, nullptr, access == Access::write ? PAGE_READWRITE : PAGE_READONLY, 0, 0,
            nullptr));
        if (!section)
            fail();
        mapped = nativeOf(section);
    }
    void *const data = ::MapViewOfFile(
        mapped, access == Access::write ? FILE_MAP_READ | FILE_MAP_WRITE : FILE_MAP_READ, 0, 0,
        bytes);
    if (data == nullptr)
        fail();
    return {static_cast<std::byte *>(data), bytes};
}

// Windows reads ahead only if a file is read in order.
void expectFewReads(std::span<const std::byte>) {}

void unmap(std::span<std::byte> mapped) {
    ::UnmapViewOfFile(mapped.data());
}

} // namespace pellucid::platform
