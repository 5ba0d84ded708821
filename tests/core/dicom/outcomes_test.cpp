// SPDX-License-Identifier: GPL-3.0-or-later
// outcomes.md says how each folder of real and nasty files ends: what becomes a volume, what
// images, what is not used and why. A file that ends otherwise is a change to be looked at.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/task/error.h"
#include "tests/support/files.h"
#include "tests/support/test_data.h"

namespace pellucid {

namespace {

namespace fs = std::filesystem;

// The reason without what differs from file to file.
std::string kindOf(const std::string &reason) {
    std::string kind = reason.substr(0, reason.find(" ("));
    kind = kind.substr(0, kind.find(": "));
    std::string out;
    for (const char c : kind)
        if (!std::isdigit((unsigned char)(c)))
            out += c;
        else if (out.empty() || out.back() != '#')
            out += '#';
    return out.substr(0, out.find("has the instance UID of") == 0 ? 23 : std::string::npos);
}

// "| folder | volumes | images | not used |", with sizes of volumes and counts of reasons.
std::string outcomeOf(const fs::path &folder) {
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
                                      std::to_string(n.k) +
                                      (loaded.volume.notes().warnings.empty() ? "" : " (warned)"));
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

} // namespace

TEST(Outcomes, AreThoseOfTheTable) {
    PELLUCID_NEEDS_TEST_DATA();
    std::map<std::string, std::string> expected;
    std::istringstream table(
        test::readText(fs::path(PELLUCID_SOURCE) / "tests/core/dicom/outcomes.md"));
    for (std::string line; std::getline(table, line);)
        if (line.starts_with("| ") && !line.starts_with("| folder"))
            expected[line.substr(2, line.find(" |") - 2)] = line;
    std::set<std::string> seen;
    for (const auto &entry : fs::directory_iterator(test::testData())) {
        if (!entry.is_directory())
            continue;
        const std::string name = entry.path().filename().string();
        seen.insert(name);
        EXPECT_EQ(outcomeOf(entry.path()), expected[name]);
    }
    EXPECT_EQ(seen.size(), expected.size());
}

} // namespace pellucid
