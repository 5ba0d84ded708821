// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <archive.h>
#include <archive_entry.h>

#include "core/decoder/message.h"
#include "core/parse/parse.h"
#include "core/task/error.h"

namespace pellucid::parse {

namespace {

using task::Error;
using task::ErrorCode;

struct CloseArchive {
    void operator()(struct archive *a) const { archive_read_free(a); }
};
using Reader = std::unique_ptr<struct archive, CloseArchive>;

[[noreturn]] void failReading(struct archive *reader) {
    const char *const text = archive_error_string(reader);
    throw Error(ErrorCode::unusable, text != nullptr && *text != '\0'
                                         ? std::string("is a damaged archive: ") + text
                                         : std::string("is a damaged archive"));
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

void forEachFile(struct archive *reader, const std::function<void(const ArchiveFile &)> &f) {
    for (;;) {
        struct archive_entry *entry = nullptr;
        const int status = archive_read_next_header(reader, &entry);
        if (status == ARCHIVE_EOF)
            return;
        // A warning is about names in another character set.
        if (status != ARCHIVE_OK && status != ARCHIVE_WARN)
            failReading(reader);
        const auto type = archive_entry_filetype(entry);
        if (type == AE_IFREG || type == AE_IFLNK)
            f(fileOf(entry));
    }
}

} // namespace

void listArchive(std::span<const std::byte> archive,
                 const std::function<void(const ArchiveFile &)> &announce) {
    forEachFile(open(archive).get(), announce);
}

void readArchive(std::span<const std::byte> archive, const TakeData &take) {
    const Reader reader = open(archive);
    std::vector<std::byte> part(decoder::archivePartBytes);
    forEachFile(reader.get(), [&](const ArchiveFile &file) {
        if (file.isLink)
            return;
        for (bool isFirst = true, isLast = false; !isLast; isFirst = false) {
            std::size_t filled = 0;
            while (filled < part.size() && !isLast) {
                const la_ssize_t got =
                    archive_read_data(reader.get(), part.data() + filled, part.size() - filled);
                if (got < 0)
                    failReading(reader.get());
                filled += std::size_t(got);
                isLast = got == 0;
            }
            take(file, std::span(part).first(filled), isFirst, isLast);
        }
    });
}

} // namespace pellucid::parse
