// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/archive/object_folder.h"
#include "core/archive/retrieval.h"
#include "core/archive/sending.h"
#include "core/archive/server.h"
#include "core/dicom/missing_objects.h"
#include "core/dicom/scan.h"
#include "core/dicom/write_series.h"
#include "core/phantom/phantom.h"
#include "core/task/error.h"
#include "tests/network/servers.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::test {

namespace fs = std::filesystem;

/// The bytes of a file after its meta header, which a receiver writes itself.
inline std::string dataSetOf(const fs::path &file) {
    const std::string bytes = readText(file);
    std::uint32_t group = 0;
    if (bytes.size() > 144)
        std::memcpy(&group, bytes.data() + 140, sizeof group);
    return bytes.substr(std::min(bytes.size(), std::size_t(144 + group)));
}

/// The objects in a folder, and whatever else is there but the notes of what is missing.
inline std::vector<fs::path> filesIn(const fs::path &folder) {
    std::vector<fs::path> files;
    if (fs::exists(folder))
        for (const auto &entry : fs::recursive_directory_iterator(folder))
            if (entry.is_regular_file() && entry.path().filename() != dicom::missingObjectsName)
                files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// The data sets of a folder, as digests that a failed comparison can print.
inline std::multiset<std::string> dataSetsIn(const fs::path &folder) {
    std::multiset<std::string> sets;
    for (const fs::path &file : filesIn(folder)) {
        const std::string set = dataSetOf(file);
        sets.insert(std::to_string(set.size()) + " bytes, " +
                    std::to_string(std::hash<std::string>()(set)));
    }
    return sets;
}

inline archive::Server serverAt(int port, const std::string &ae) {
    archive::Server server;
    server.name = "test";
    server.peer.host = "127.0.0.1";
    server.peer.port = port;
    server.peer.calledAe = ae;
    server.peer.connectSeconds = 5.0;
    server.peer.associationSeconds = 10.0;
    server.peer.silenceSeconds = 10.0;
    return server;
}

/// Tests against real servers, skipped where DCMTK's programs are missing.
class Pacs : public testing::Test {
protected:
    void SetUp() override {
        if (!isInstalled("dcmqrscp"))
            GTEST_SKIP() << "dcmqrscp is not installed";
    }

    /// A series on disk. *Shape*: its slices are `side` x `side`.
    fs::path series(const std::string &name, int slices, int side = 64,
                    dicom::TransferSyntax syntax = dicom::TransferSyntax::explicitLittle) {
        const volume::Volume volume = phantom::makePhantom(
            phantom::Kind::head,
            phantom::phantomLattice(phantom::Kind::head,
                                    {.size = volume::GridSize{side, side, slices}}));
        dicom::writeCtSeries(m_folder / name, volume,
                             {.patientName = "Test^" + name,
                              .patientId = "ID-" + name,
                              .studyDescription = "Study " + name,
                              .seriesDescription = "Series",
                              .bodyPart = "HEAD",
                              .windows = {}},
                             syntax);
        return m_folder / name;
    }

    static std::string studyIn(const fs::path &folder) {
        return dicom::scan({folder}).patients.at(0).studies.at(0).uid;
    }

    static void put(const archive::Server &server, const fs::path &folder) {
        const auto report = archive::send(server, filesIn(folder));
        ASSERT_TRUE(report.notSent.empty()) << report.notSent.front().reason.english();
    }

    archive::RetrievalReport get(const archive::Server &server, const std::string &study,
                                 const std::string &to = "got") {
        const archive::ObjectFolder folder(m_folder / to,
                                           archive::ObjectFolder::Durability::cached);
        return archive::retrieve(server, {study, {}}, folder);
    }

    /// The reason why something failed.
    template <class F> static std::string failureOf(F &&work) {
        try {
            work();
        } catch (const task::Error &error) {
            EXPECT_EQ(error.code(), task::ErrorCode::unreachable) << error.what();
            return error.reason().english();
        }
        return "nothing failed";
    }

    TemporaryFolder m_folder;
};

/// Tests against scripted servers, which need no program.
class PacsScripted : public Pacs {
protected:
    void SetUp() override {}
};

} // namespace pellucid::test
