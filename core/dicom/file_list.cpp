// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/file_list.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "core/decoding/client/decoder.h"
#include "core/decoding/client/reasons.h"
#include "core/decoding/client/unpack_archive.h"
#include "core/dicom/missing_objects.h"
#include "core/dicom/reasons.h"
#include "core/files/reasons.h"
#include "core/platform/file.h"
#include "core/system/text.h"
#include "core/task/error.h"
#include "core/task/reasons.h"
#include "core/volume/volume_file.h"

namespace pellucid::dicom {

namespace {

namespace fs = std::filesystem;
namespace because = task::because;
using task::Error;
using task::ErrorCode;

// Entries match in any case, because CDs are written in capitals and mounted in lower case. Each
// folder is read once.
class CaselessFolders {
public:
    fs::path childOf(const fs::path &folder, const std::string &name) {
        std::error_code ignored;
        if (fs::exists(folder / name, ignored))
            return folder / name;
        const auto [names, isNew] = m_names.try_emplace(folder);
        if (isNew)
            platform::listFolder(folder, [&](const platform::Entry &entry) {
                names->second.try_emplace(system::lowered(entry.path.filename().string()),
                                          entry.path);
            });
        const auto it = names->second.find(system::lowered(name));
        return it == names->second.end() ? folder / name : it->second;
    }

private:
    std::map<fs::path, std::map<std::string, fs::path>> m_names;
};

} // namespace

fs::path resolved(const fs::path &path) {
    std::error_code unknown;
    const fs::path canonical = fs::weakly_canonical(path, unknown);
    return unknown ? path : canonical;
}

FileList::FileList(const task::Progress &progress) : m_progress(progress) {}

void FileList::add(const fs::path &path) {
    if (path.empty())
        throw Error(ErrorCode::unusable, because::emptyPath);
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status))
        throw Error(ErrorCode::unusable,
                    error && status.type() != fs::file_type::not_found ? task::systemReason(error)
                                                                       : because::doesNotExist,
                    path);
    if (fs::is_directory(status))
        addFolder(path);
    else if (!fs::is_regular_file(status))
        throw Error(ErrorCode::unusable, because::isNeitherFileNorFolder, path);
    else if (decoding::isArchive(path))
        addArchive(path);
    else if (const auto directory = directoryAt(path); directory.isDirectory)
        addDirectory(path, directory);
    else
        addFile(path);
}

void FileList::addFile(const fs::path &path) {
    if (m_seen.insert(resolved(path)).second)
        found.push_back(path);
}

void FileList::addArchive(const fs::path &path) {
    auto folder = std::make_shared<files::SessionFolder>();
    for (const auto &file :
         decoding::unpackArchive(decoding::Decoder::shared(), path, folder->path(), m_progress))
        skipped.push_back({path / fs::path(file.name).relative_path(), file.reason});
    addFolder(folder->path());
    unpacked.push_back({std::move(folder), path});
}

// A file that is not DICOM at all is reported when it is read.
decoding::DirectoryFile FileList::directoryAt(const fs::path &path) const {
    return volume::isVolumeFile(path) ? decoding::DirectoryFile()
                                      : decoding::Decoder::shared().directory(path, m_progress);
}

void FileList::addDirectory(const fs::path &path, const decoding::DirectoryFile &directory) {
    std::error_code unknown;
    const fs::path folder = fs::weakly_canonical(fs::absolute(path).parent_path(), unknown);
    CaselessFolders folders;
    for (const auto &parts : directory.files) {
        m_progress.check();
        fs::path listed = path.parent_path();
        for (const std::string &part : parts) {
            // A component must be a plain name: an index must not lead out of its own folder.
            if (part == ".." || part.find_first_of(std::string_view("/\0", 2)) != part.npos)
                throw Error(ErrorCode::unusable, because::listsAFileOutside, path);
            listed = folders.childOf(listed, part);
        }
        std::error_code ignored;
        if (!fs::is_regular_file(listed, ignored)) {
            skipped.push_back({listed, because::isListedButMissing});
            continue;
        }
        // A link may lead elsewhere.
        const fs::path meant =
            fs::weakly_canonical(fs::absolute(listed), ignored).lexically_relative(folder);
        if (meant.empty() || *meant.begin() == "..")
            skipped.push_back({listed, because::listsAFileOutside});
        else
            addFile(listed);
    }
}

void FileList::addFolder(const fs::path &folder) {
    using Kind = platform::Entry::Kind;
    std::vector<fs::path> pending{folder}, below;
    while (!pending.empty()) {
        m_progress.check();
        const fs::path current = pending.back();
        pending.pop_back();
        bool isRead = false;
        const std::error_code error = platform::listFolder(current, [&](const auto &entry) {
            isRead = true;
            if (entry.kind == Kind::folder) {
                if (entry.isLink)
                    skipped.push_back({entry.path, because::linksToAFolder});
                else
                    pending.push_back(entry.path);
            } else if (entry.kind == Kind::file) {
                if (entry.path.filename() != missingObjectsName)
                    below.push_back(entry.path);
            } else {
                skipped.push_back({entry.path, entry.isLink ? because::isABrokenLink
                                                            : because::isNotARegularFile});
            }
        });
        if (error && !isRead && current == folder)
            throw Error(ErrorCode::unusable, task::systemReason(error), folder);
        if (error) // a network share or a CD that fails midway
            skipped.push_back({current, task::systemReason(error)});
    }
    std::sort(below.begin(), below.end());
    for (const fs::path &path : below)
        addFile(path);
}

FileList listFiles(const std::vector<fs::path> &paths, const task::Progress &progress) {
    FileList list(progress);
    for (const fs::path &path : paths) {
        try {
            list.add(path);
        } catch (const Error &error) {
            // One bad path among several does not stop the scan; a full disk does.
            if (paths.size() == 1 || error.code() == ErrorCode::output)
                throw;
            list.skipped.push_back({path, error.code() == ErrorCode::outOfMemory
                                              ? task::Reason(because::needsTooMuchMemory)
                                              : error.reason()});
        }
    }
    return list;
}

} // namespace pellucid::dicom
