// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/dicom/group_series.h"

namespace pellucid::test {

/// A file at a depth along z, 4 x 3 pixels of 1 mm.
inline dicom::SeriesFile file(const std::string &name, double z) {
    dicom::SeriesFile f{name, {}};
    f.header.rows = 3;
    f.header.columns = 4;
    f.header.sopInstanceUid = "1.2." + name;
    dicom::FrameHeader frame;
    frame.positionMm = glm::dvec3(0, 0, z);
    frame.rowAxis = glm::dvec3(1, 0, 0);
    frame.columnAxis = glm::dvec3(0, 1, 0);
    frame.spacingMm = glm::dvec2(1, 1);
    frame.sliceThicknessMm = 2.5;
    f.header.frames = {frame};
    return f;
}

/// Files f0, f1 .. at depths.
inline std::vector<dicom::SeriesFile> stack(const std::vector<double> &depths) {
    std::vector<dicom::SeriesFile> files;
    for (const double z : depths)
        files.push_back(file("f" + std::to_string(files.size()), z));
    return files;
}

/// The volumes of a series whose skipped files do not matter.
inline std::vector<dicom::VolumeEntry> group(const std::vector<dicom::SeriesFile> &files) {
    std::vector<dicom::Skipped> skipped;
    return dicom::groupSeries(files, skipped);
}

inline std::vector<double> evenDepths(int count, double step) {
    std::vector<double> depths;
    for (int n = 0; n < count; ++n)
        depths.push_back(n * step);
    return depths;
}

} // namespace pellucid::test
