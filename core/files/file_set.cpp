// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/file_set.h"

#include <string>
#include <system_error>

#include "core/files/atomic_file.h"
#include "core/task/error.h"

namespace pellucid::files {

namespace fs = std::filesystem;

namespace {

fs::path nameAside(std::size_t number, const fs::path &file) {
    return std::to_string(number) + file.extension().string();
}

// A folder that is not there is not made: its name may be a slip.
const fs::path &inFolder(const fs::path &file) {
    std::error_code failed;
    if (!fs::is_directory(file.parent_path().empty() ? "." : file.parent_path(), failed))
        throw task::Error(task::ErrorCode::output, failed ? failed.message() : "is not in a folder",
                          file);
    return file;
}

} // namespace

FileSet::FileSet(const fs::path &file) : m_folder(SessionFolder::beside(inFolder(file))) {}

fs::path FileSet::aside(const fs::path &file) {
    m_files.push_back(file);
    return m_folder.path() / nameAside(m_files.size() - 1, file);
}

void FileSet::commit() {
    for (std::size_t n = 0; n < m_files.size(); ++n)
        files::rename(m_folder.path() / nameAside(n, m_files[n]), m_files[n]);
}

} // namespace pellucid::files
