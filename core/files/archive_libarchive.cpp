// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/archive.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include "core/task/error.h"

namespace pellucid::files {

namespace {

namespace fs = std::filesystem;
using task::Error;
using task::ErrorCode;

constexpr std::size_t blockBytes = 1 << 16;
constexpr std::size_t longestName = 255; // of what usual file systems take

struct CloseArchive {
    void operator()(struct archive *a) const { archive_read_free(a); }
};
using Reader = std::unique_ptr<struct archive, CloseArchive>;

[[noreturn]] void failReading(struct archive *reader, const fs::path &path) {
    const char *const text = archive_error_string(reader);
    throw Error(ErrorCode::unusable,
                text != nullptr && *text != '\0' ? std::string("is a damaged archive: ") + text
                                                 : std::string("is a damaged archive"),
                path);
}

Reader open(const fs::path &path) {
    Reader reader(archive_read_new());
    archive_read_support_format_zip_seekable(reader.get());
    errno = 0;
    if (archive_read_open_filename(reader.get(), path.c_str(), blockBytes) != ARCHIVE_OK)
        failReading(reader.get(), path);
    return reader;
}

void forEachFile(struct archive *reader, const fs::path &path,
                 const std::function<void(struct archive_entry *)> &f) {
    for (;;) {
        struct archive_entry *entry = nullptr;
        const int status = archive_read_next_header(reader, &entry);
        if (status == ARCHIVE_EOF)
            return;
        // A warning is about names in another character set.
        if (status != ARCHIVE_OK && status != ARCHIVE_WARN)
            failReading(reader, path);
        if (archive_entry_filetype(entry) == AE_IFREG)
            f(entry);
    }
}

std::string sizeText(std::uintmax_t bytes) {
    return fmt::format("{:.1f} GB", double(bytes) / 1e9);
}

// Below the folder whatever the archive says: no root, no way up, no name too long to write.
fs::path inside(const fs::path &folder, const char *name, std::size_t number) {
    fs::path below;
    for (const fs::path &part : fs::path(name != nullptr ? name : "").relative_path()) {
        const std::string text = part.string();
        if (text.empty() || text == "." || text == "..")
            continue;
        below /= text.size() <= longestName ? text : text.substr(text.size() - longestName);
    }
    return folder / (below.empty() ? fs::path(std::to_string(number)) : below);
}

std::uintmax_t writeFile(struct archive *reader, const fs::path &archive, const fs::path &to,
                         std::uintmax_t room, const task::Progress &progress) {
    std::error_code failed;
    fs::create_directories(to.parent_path(), failed);
    errno = 0;
    std::ofstream out(to, std::ios::binary);
    if (failed || !out)
        throw Error(ErrorCode::output,
                    failed       ? failed.message()
                    : errno != 0 ? std::strerror(errno)
                                 : "cannot be written",
                    to);
    std::vector<char> block(blockBytes);
    std::uintmax_t written = 0;
    for (;;) {
        progress.check();
        const la_ssize_t got = archive_read_data(reader, block.data(), block.size());
        if (got < 0)
            failReading(reader, archive);
        if (got == 0)
            break;
        written += std::uintmax_t(got);
        if (written > room)
            throw Error(ErrorCode::unusable, "unpacks to more than it announces", archive);
        out.write(block.data(), got);
    }
    out.close();
    if (!out)
        throw Error(ErrorCode::output, errno != 0 ? std::strerror(errno) : "cannot be written", to);
    return written;
}

} // namespace

bool isArchive(const fs::path &path) {
    std::array<char, 4> start{};
    std::ifstream in(path, std::ios::binary);
    in.read(start.data(), start.size());
    return in.gcount() == 4 && std::memcmp(start.data(), "PK\3\4", 4) == 0;
}

void unpackArchive(const fs::path &path, const fs::path &folder, const task::Progress &progress,
                   const UnpackLimits &limits) {
    std::error_code unknown;
    const fs::space_info space = fs::space(folder, unknown);
    const std::uintmax_t most =
        unknown ? limits.bytes : std::min(limits.bytes, space.available / 2);
    std::uintmax_t announced = 0;
    std::size_t files = 0;
    const Reader directory = open(path);
    forEachFile(directory.get(), path, [&](struct archive_entry *entry) {
        if (archive_entry_is_encrypted(entry) != 0)
            throw Error(ErrorCode::unusable, "is encrypted", path);
        const auto size = std::uintmax_t(std::max<la_int64_t>(0, archive_entry_size(entry)));
        // Sizes are up to 2^63: no sum may wrap before it is looked at.
        if (size > most || announced + size > most)
            throw Error(
                ErrorCode::unusable,
                fmt::format("unpacks to more than the {} there is room for", sizeText(most)), path);
        announced += size;
        if (++files > limits.files)
            throw Error(ErrorCode::unusable, fmt::format("holds more than {} files", limits.files),
                        path);
    });
    const Reader contents = open(path);
    std::uintmax_t written = 0;
    std::size_t number = 0;
    forEachFile(contents.get(), path, [&](struct archive_entry *entry) {
        const char *name = archive_entry_pathname_utf8(entry);
        if (name == nullptr)
            name = archive_entry_pathname(entry);
        fs::path to = inside(folder, name, ++number);
        // Two names may differ in what was taken from them.
        std::error_code failed;
        fs::create_directories(to.parent_path(), failed); // a file may have the folder's name
        for (std::size_t n = number; failed || fs::exists(to); ++n) {
            to = folder / ("_" + std::to_string(n)) / to.filename();
            failed.clear();
            fs::create_directories(to.parent_path(), failed);
        }
        written += writeFile(contents.get(), path, to, most - written, progress);
        progress.report(announced > 0 ? double(written) / double(announced) : 1.0);
    });
}

} // namespace pellucid::files
