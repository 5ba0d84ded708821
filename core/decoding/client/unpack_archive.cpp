// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/client/unpack_archive.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "core/decoding/client/channel.h"
#include "core/decoding/client/decoder.h"
#include "core/decoding/client/message.h"
#include "core/decoding/client/reasons.h"
#include "core/files/open_regular.h"
#include "core/platform/file.h"
#include "core/task/error.h"

namespace pellucid::decoding {

namespace {

namespace fs = std::filesystem;
namespace because = task::because;
using task::Error;
using task::ErrorCode;

constexpr std::size_t longestName = 255; // in common file systems

std::string sizeText(std::uintmax_t bytes) {
    return fmt::format("{:.1f} GB", double(bytes) / 1e9);
}

// The path below the folder, whatever the archive says: no root, no parent directories, no
// component too long to write.
fs::path inside(const fs::path &folder, const std::string &name, std::size_t number) {
    fs::path below;
    for (const fs::path &part : fs::path(name).relative_path()) {
        const std::string text = part.string();
        if (text.empty() || text == "." || text == ".." || text.find('\0') != std::string::npos)
            continue;
        below /= text.size() <= longestName ? text : text.substr(text.size() - longestName);
    }
    return folder / (below.empty() ? fs::path(std::to_string(number)) : below);
}

// A free path: two names may become equal, or equal to the folder's name. A path that is too deep
// or too long is replaced by a folder named after its number.
fs::path freePath(const fs::path &folder, const std::string &name, std::size_t number) {
    constexpr std::ptrdiff_t deepest = 32;
    fs::path to = inside(folder, name, number);
    std::error_code failed;
    const auto depth =
        std::distance(to.begin(), to.end()) - std::distance(folder.begin(), folder.end());
    if (to.native().size() <= platform::longestStreamPath() && depth <= deepest) {
        fs::create_directories(to.parent_path(), failed);
        if (!failed && !fs::exists(to, failed))
            return to;
    }
    to = folder / ("_" + std::to_string(number)) / to.filename();
    fs::create_directories(to.parent_path(), failed);
    if (failed)
        throw Error(ErrorCode::output, task::systemReason(failed), to);
    return to;
}

[[noreturn]] void failWriting(const fs::path &to) {
    throw Error(ErrorCode::output, errno != 0 ? task::systemReason(errno) : because::isNotWritable,
                to);
}

} // namespace

bool isArchive(const fs::path &path) {
    try {
        std::array<std::byte, 4> start{};
        return platform::readAt(files::openRegular(path).handle, 0, start) == start.size() &&
               std::memcmp(start.data(), "PK\3\4", start.size()) == 0;
    } catch (const std::system_error &) {
        return false;
    } catch (const Error &) {
        return false; // reading it will report why
    }
}

std::vector<LeftOutFile> unpackArchive(Decoder &decoder, const fs::path &path,
                                       const fs::path &folder, const task::Progress &progress,
                                       const UnpackLimits &limits) {
    std::error_code unknown;
    const fs::space_info space = fs::space(folder, unknown);
    const std::uintmax_t most =
        unknown ? limits.bytes : std::min(limits.bytes, space.available / 2);
    std::uintmax_t announced = 0, written = 0;
    std::size_t files = 0, number = 0;
    std::vector<LeftOutFile> leftOut;
    fs::path to;
    std::ofstream out;
    decoder.archive(
        path,
        [&](const ArchiveFile &file) {
            if (file.isEncrypted)
                throw Error(ErrorCode::unusable, because::isEncrypted, path);
            // Sizes are up to 2^63, and no sum may overflow before it is checked.
            if (file.bytes > most || announced + file.bytes > most)
                throw Error(ErrorCode::unusable,
                            because::unpacksToMoreThanThereIsRoom(sizeText(most)), path);
            announced += file.bytes;
            if (++files > limits.files)
                throw Error(ErrorCode::unusable, because::holdsTooManyFiles(limits.files), path);
            if (file.isLink)
                leftOut.push_back({file.name, because::isALinkInAnArchive});
        },
        [&](const ArchivePart &part) {
            errno = 0;
            if (part.isFirst) {
                if (++number > files)
                    throw Error(ErrorCode::unusable, because::holdsMoreFilesThanAnnounced, path);
                to = freePath(folder, part.file.name, number);
                out.close();
                out.clear();
                out.open(to, std::ios::binary);
                if (!out)
                    failWriting(to);
            }
            if (part.isDamaged) {
                std::error_code ignored;
                out.close();
                fs::remove(to, ignored);
                leftOut.push_back({part.file.name, unpackReason(part.data)});
                return;
            }
            written += part.data.size();
            if (written > most)
                throw Error(ErrorCode::unusable, because::unpacksToMoreThanAnnounced, path);
            out.write(reinterpret_cast<const char *>(part.data.data()),
                      std::streamsize(part.data.size()));
            if (part.isLast)
                out.close();
            if (!out)
                failWriting(to);
            progress.report(announced > 0 ? std::min(1.0, double(written) / double(announced))
                                          : 1.0);
        },
        progress);
    return leftOut;
}

} // namespace pellucid::decoding
