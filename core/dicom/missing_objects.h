// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pellucid::dicom {

/// The name of the file in a study's folder that says how many of its objects are missing.
inline constexpr const char *missingObjectsName = "missing-objects.txt";

/// Notes in a folder that a retrieval has not brought all objects of a study, or of some of its
/// series, so that whoever opens the rest hears of it; 0: removes the note, unless it is of more
/// series than these. *Shape*: `seriesUids`: those that were retrieved; none: all of the study.
/// *Throws* Error{output}.
void noteMissingObjects(const std::filesystem::path &studyFolder,
                        const std::vector<std::string> &seriesUids, std::size_t missing);

/// The number of objects missing from the study that a file belongs to, by the note in its folder
/// or in the folder above; nothing if there is no note, or it is not readable.
std::optional<std::size_t> missingObjectsBeside(const std::filesystem::path &file);

} // namespace pellucid::dicom
