// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "core/files/session_folder.h"

namespace pellucid::files {

/// Files of one folder that belong together, as the frames of a turn: they take their names, one
/// after the other, when all are on the disk. What was written before under those names stays till
/// then; of files that are given up none is left, and a kill leaves a hidden folder that the next
/// set there removes. One in the moment of the names leaves some with the new, some with the old.
class FileSet {
public:
    /// `file`: one of them. *Throws* Error{output}.
    explicit FileSet(const std::filesystem::path &file);
    /// Where to write meanwhile what will have that name, or is what a link of that name points at.
    /// *Shape*: with its extension. *Throws* Error{output} where the name is a device's or a
    /// pipe's.
    std::filesystem::path aside(const std::filesystem::path &file);
    /// *Throws* Error{output}: what has its name by then keeps it, in place of what was there.
    void commit();

private:
    SessionFolder m_folder;
    std::vector<std::filesystem::path> m_files;
};

} // namespace pellucid::files
