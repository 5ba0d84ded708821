// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/phantom/phantom.h"

namespace pellucid::test {

/// A small head whose slices are tilted and thick, to be written as a series.
inline volume::Volume tiltedHead(int slices = 7) {
    return phantom::makePhantom(
        phantom::Kind::head,
        phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{33, 30, slices},
                                                      .spacingMm = glm::dvec3(6.1, 6.7, 30.0),
                                                      .tiltRad = 0.3}));
}

/// Changes attributes of files by `dcmodify`. False if it fails.
inline bool modify(const std::string &changes, const std::vector<std::filesystem::path> &files) {
    std::string command = "dcmodify -nb " + changes;
    for (const std::filesystem::path &file : files)
        command += " '" + file.string() + "'";
    return std::system((command + " > /dev/null").c_str()) == 0;
}

/// The volume that the program shows first of the files at a path.
inline dicom::LoadedVolume loadDefault(const std::filesystem::path &path) {
    const auto catalogue = dicom::scan({path});
    return dicom::loadVolume(*dicom::defaultSelection(catalogue).volume);
}

} // namespace pellucid::test
