// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/task/error.h"
#include "tests/support/files.h"

namespace pellucid::test {

namespace fs = std::filesystem;

// The reason without the parts that differ from file to file.
inline std::string kindOf(const task::Reason &reason) {
    std::string kind = reason.english();
    kind = kind.substr(0, kind.find(" ("));
    kind = kind.substr(0, kind.find(": "));
    std::string out;
    for (const char c : kind)
        if (!std::isdigit((unsigned char)(c)))
            out += c;
        else if (out.empty() || out.back() != '#')
            out += '#';
    return out.substr(0, out.find("has the same instance UID as") == 0 ? 28 : std::string::npos);
}

// " (missing slices, interpolated)": what the volume says.
inline std::string warningsOf(const volume::Volume &volume) {
    std::string all;
    for (const task::Reason &warning : volume.notes().warnings)
        all += (all.empty() ? " (" : " + ") + kindOf(warning);
    return all.empty() ? all : all + ")";
}

// "| folder | volumes | images | not used |", with sizes of volumes and counts of reasons.
inline std::string outcomeOf(const fs::path &folder) {
    std::map<std::string, int> reasons;
    std::vector<std::string> volumes;
    int images = 0;
    const auto skip = [&](const std::vector<dicom::Skipped> &skipped) {
        for (const auto &s : skipped)
            if (const std::string name = s.path.filename().string();
                name != "LICENSE.txt" && name != "SOURCE.txt")
                ++reasons[kindOf(s.reason)];
    };
    try {
        const auto catalogue = dicom::scan({folder});
        skip(catalogue.skipped);
        for (const auto &s : dicom::selections(catalogue)) {
            try {
                const auto loaded = dicom::loadVolume(*s.volume);
                skip(loaded.skipped);
                const auto n = loaded.volume.lattice().size();
                if (loaded.volume.notes().placed)
                    volumes.push_back(std::to_string(n.i) + "x" + std::to_string(n.j) + "x" +
                                      std::to_string(n.k) + warningsOf(loaded.volume));
                else
                    images += n.k;
            } catch (const task::Error &error) {
                ++reasons[kindOf(error.reason())];
            }
        }
    } catch (const task::Error &error) {
        ++reasons[kindOf(error.reason())];
    }
    std::sort(volumes.begin(), volumes.end());
    std::ostringstream row;
    row << "| " << folder.filename().string() << " |";
    std::map<std::string, int> sizes;
    for (const std::string &size : volumes)
        ++sizes[size];
    for (const auto &[size, count] : sizes)
        row << (count > 1 ? " " + std::to_string(count) + " of" : "") << " " << size << ";";
    row << " | " << images << " |";
    for (const auto &[reason, count] : reasons)
        row << " " << count << " " << reason << ";";
    row << " |";
    return row.str();
}

/// The rows of outcomes.md by their first column.
inline std::map<std::string, std::string> outcomesTable() {
    std::map<std::string, std::string> rows;
    std::istringstream table(readText(fs::path(PELLUCID_SOURCE) / "tests/core/dicom/outcomes.md"));
    for (std::string line; std::getline(table, line);)
        if (line.starts_with("| ") && !line.starts_with("| folder"))
            rows[line.substr(2, line.find(" |") - 2)] = line;
    return rows;
}

} // namespace pellucid::test
