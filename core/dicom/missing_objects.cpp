// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/missing_objects.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "core/files/atomic_file.h"
#include "core/files/read_text.h"
#include "core/task/error.h"

namespace pellucid::dicom {

namespace {

namespace fs = std::filesystem;

struct Note {
    std::size_t missing = 0;
    std::vector<std::string> seriesUids; ///< none: of the whole study
};

// The number, then the series, a line each.
std::optional<Note> noteIn(const fs::path &folder) {
    constexpr std::size_t mostBytes = 1 << 20;
    std::error_code unknown;
    const fs::path path = folder / missingObjectsName;
    if (!fs::is_regular_file(path, unknown))
        return std::nullopt;
    try {
        std::istringstream lines(files::readText(path, mostBytes));
        std::string line;
        std::getline(lines, line);
        Note note;
        const auto [end, error] =
            std::from_chars(line.data(), line.data() + line.size(), note.missing);
        if (error != std::errc() || end != line.data() + line.size())
            return std::nullopt;
        while (std::getline(lines, line))
            note.seriesUids.push_back(line);
        return note;
    } catch (const task::Error &) {
        return std::nullopt;
    }
}

} // namespace

void noteMissingObjects(const fs::path &studyFolder, const std::vector<std::string> &seriesUids,
                        std::size_t missing) {
    const fs::path path = studyFolder / missingObjectsName;
    const std::optional<Note> before = noteIn(studyFolder);
    const auto isRetrieved = [&](const std::string &uid) {
        return std::find(seriesUids.begin(), seriesUids.end(), uid) != seriesUids.end();
    };
    const bool coversBefore =
        !before || seriesUids.empty() ||
        (!before->seriesUids.empty() &&
         std::all_of(before->seriesUids.begin(), before->seriesUids.end(), isRetrieved));
    if (!coversBefore && missing <= before->missing)
        return;
    if (missing == 0) {
        std::error_code ignored;
        fs::remove(path, ignored);
        return;
    }
    std::string text = std::to_string(missing) + "\n";
    if (coversBefore)
        for (const std::string &uid : seriesUids)
            text += uid + "\n";
    files::AtomicFile file(path, files::AtomicFile::Readers::user);
    file.write(text);
    file.commit();
}

std::optional<std::size_t> missingObjectsBeside(const fs::path &file) {
    const fs::path folder = fs::absolute(file).parent_path();
    for (const fs::path &one : {folder, folder.parent_path()})
        if (const auto note = noteIn(one))
            return note->missing;
    return std::nullopt;
}

} // namespace pellucid::dicom
