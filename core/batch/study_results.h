// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include "core/batch/done_record.h"
#include "core/files/session_folder.h"

namespace pellucid::batch {

/// Whether the folder of a study, if there is one, may be replaced: it is empty, or contains
/// results only. *Throws* Error{unusable} if not.
void requireReplaceable(const std::filesystem::path &place);

/// The results of one study, which get their folder when all of them are there. Until then, and if
/// the program is killed, the results of an earlier run stay; on file systems that cannot exchange
/// two folders at once, a kill at the end may leave neither. Several machines may share the folder.
class StudyResults {
public:
    /// *Shape*: `key`: the name of the study's folder in `out`. *Throws* Error{output};
    /// as requireReplaceable.
    StudyResults(const std::filesystem::path &out, const std::string &key);

    /// Where to write the results.
    const std::filesystem::path &folder() const { return m_folder; }
    /// Writes the record, with the files that are there, and puts the folder in its place. *Throws*
    /// Error{output}.
    void publish(DoneRecord record);

private:
    void replace(std::error_code &failed) const;

    std::filesystem::path m_place;
    files::SessionFolder m_aside;
    std::filesystem::path m_folder;
};

} // namespace pellucid::batch
