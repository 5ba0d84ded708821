// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/file_set.h"

#include <string>
#include <system_error>

#include "core/files/atomic_file.h"
#include "core/files/reasons.h"
#include "core/task/error.h"

namespace pellucid::files {

namespace fs = std::filesystem;

namespace {

fs::path temporaryName(std::size_t number, const fs::path &file) {
    return std::to_string(number) + file.extension().string();
}

// A missing folder is not created, because its name may be a typing error.
SessionFolder folderFor(const fs::path &file) {
    std::error_code failed;
    if (!fs::is_directory(file.parent_path().empty() ? "." : file.parent_path(), failed))
        throw task::Error(task::ErrorCode::output,
                          failed ? task::systemReason(failed) : task::because::isNotInAFolder,
                          file);
    try {
        return SessionFolder::beside(file);
    } catch (const task::Error &error) {
        throw task::Error(error.code(), task::because::cannotBeWritten(error.reason()), file);
    }
}

} // namespace

FileSet::FileSet(const fs::path &file) : m_folder(folderFor(file)) {}

fs::path FileSet::aside(const fs::path &file) {
    m_files.push_back(targetOf(file));
    return m_folder.path() / temporaryName(m_files.size() - 1, file);
}

void FileSet::commit() {
    // Flushes all bytes before the first rename, so that the renames take only a moment.
    flush(m_folder.path());
    for (std::size_t n = 0; n < m_files.size(); ++n) {
        std::error_code failed;
        fs::rename(m_folder.path() / temporaryName(n, m_files[n]), m_files[n], failed);
        if (failed)
            throw task::Error(task::ErrorCode::output,
                              task::because::cannotBeWritten(task::systemReason(failed)),
                              m_files[n]);
    }
}

} // namespace pellucid::files
