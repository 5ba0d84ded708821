// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cerrno>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include <archive.h>
#include <archive_entry.h>

#include "core/decoding/client/message.h"
#include "core/decoding/process/parse.h"
#include "core/decoding/process/reasons.h"
#include "core/task/error.h"

namespace pellucid::decoding::process {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

struct CloseArchive {
    void operator()(struct archive *a) const { archive_read_free(a); }
};
using Reader = std::unique_ptr<struct archive, CloseArchive>;

[[noreturn]] void failReading(struct archive *reader) {
    const char *const text = archive_error_string(reader);
    throw Error(ErrorCode::unusable, text != nullptr && *text != '\0'
                                         ? because::isADamagedArchiveBy(text)
                                         : because::isADamagedArchive);
}

Reader open(std::span<const std::byte> archive) {
    Reader reader(archive_read_new());
    archive_read_support_format_zip_seekable(reader.get());
    if (archive_read_open_memory(reader.get(), archive.data(), archive.size()) != ARCHIVE_OK)
        failReading(reader.get());
    return reader;
}

ArchiveFile fileOf(struct archive_entry *entry) {
    const char *name = archive_entry_pathname_utf8(entry);
    if (name == nullptr)
        name = archive_entry_pathname(entry);
    return {name != nullptr ? name : "",
            std::uint64_t(std::max<la_int64_t>(0, archive_entry_size(entry))),
            archive_entry_is_encrypted(entry) != 0, archive_entry_filetype(entry) == AE_IFLNK};
}

// A damaged file may make the reader unusable, and each one costs a new reader.
constexpr int maxDamaged = 100;

// Returns false if `f` ended the iteration.
bool forEachFile(struct archive *reader, const std::function<bool(const ArchiveFile &)> &f) {
    for (;;) {
        struct archive_entry *entry = nullptr;
        const int status = archive_read_next_header(reader, &entry);
        if (status == ARCHIVE_EOF)
            return true;
        // Warnings are about names in other character sets.
        if (status != ARCHIVE_OK && status != ARCHIVE_WARN)
            failReading(reader);
        const auto type = archive_entry_filetype(entry);
        if ((type == AE_IFREG || type == AE_IFLNK) && !f(fileOf(entry)))
            return false;
    }
}

// Returns false if the reader is no longer usable.
bool readFile(struct archive *reader, const ArchiveFile &file, std::span<std::byte> part,
              const TakeData &take) {
    for (std::int32_t flags = firstPart; (flags & lastPart) == 0;) {
        std::size_t filled = 0;
        la_ssize_t got = 1;
        while (filled < part.size() && got > 0) {
            got = archive_read_data(reader, part.data() + filled, part.size() - filled);
            filled += got > 0 ? std::size_t(got) : 0;
        }
        if (got < 0) {
            if (archive_errno(reader) == ENOMEM)
                throw std::bad_alloc();
            const char *const text = archive_error_string(reader);
            const std::string why =
                because::isDamagedInTheArchive(text != nullptr ? text : "").encoded();
            take(file, std::as_bytes(std::span(why)), flags | lastPart | damagedPart);
            return got != ARCHIVE_FATAL;
        }
        flags |= got == 0 ? lastPart : 0;
        take(file, part.first(filled), flags);
        flags &= ~firstPart;
    }
    return true;
}

} // namespace

void listArchive(std::span<const std::byte> archive,
                 const std::function<void(const ArchiveFile &)> &announce) {
    forEachFile(open(archive).get(), [&](const ArchiveFile &file) {
        announce(file);
        return true;
    });
}

void readArchive(std::span<const std::byte> archive, const TakeData &take) {
    std::vector<std::byte> part(archivePartBytes);
    std::size_t done = 0;
    bool isDone = false;
    for (int damaged = 0; !isDone && damaged <= maxDamaged; ++damaged) {
        const Reader reader = open(archive);
        std::size_t n = 0;
        isDone = forEachFile(reader.get(), [&](const ArchiveFile &file) {
            if (n++ < done)
                return true;
            ++done;
            return file.isLink || readFile(reader.get(), file, part, take);
        });
    }
    if (!isDone)
        throw Error(ErrorCode::unusable, because::isADamagedArchive);
}

} // namespace pellucid::decoding::process
