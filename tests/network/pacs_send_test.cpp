// SPDX-License-Identifier: GPL-3.0-or-later
// Sending to servers: what is left out, and what they refuse.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <utility>
#include <vector>

#include "core/archive/reasons.h"
#include "core/archive/sending.h"
#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/dicom/write_capture.h"
#include "core/network/client/reasons.h"
#include "core/task/error.h"
#include "tests/network/pacs.h"
#include "tests/network/scripted_server.h"
#include "tests/support/command.h"

namespace pellucid {

using namespace test;
namespace because = task::because;

// A folder as on a disc: its texts and its DICOMDIR are no objects, and are not missed.
TEST_F(Pacs, WhatIsNoObjectIsLeftOut) {
    test::Dcmqrscp dcmqrscp;
    const archive::Server server = serverAt(dcmqrscp.port(), "COMMON");
    const fs::path disc = series("D", 3);
    for (const fs::path &file : filesIn(disc)) // discs have short names
        fs::rename(file, disc / file.stem());
    ASSERT_EQ(std::system(("cd '" + disc.string() + "' && dcmmkdir IM0001 IM0002 IM0003").c_str()),
              0);
    std::ofstream(disc / "README.TXT") << "Open with a viewer.";
    const auto report = archive::send(server, {disc});
    EXPECT_EQ(report.state.sent, 3U);
    EXPECT_TRUE(report.notSent.empty());
    EXPECT_EQ(report.leftOut.size(), 2U);
    // A file that the user names is missed.
    EXPECT_EQ(archive::send(server, {disc / "README.TXT"}).notSent.size(), 1U);
}

// A server that accepts only plain pixels gets them if the user allows it; the values stay.
TEST_F(Pacs, RefusedEncodingsAreUncompressedIfAllowed) {
    test::Dcmqrscp dcmqrscp; // without an option, it accepts plain pixels
    archive::Server server = serverAt(dcmqrscp.port(), "COMMON");
    const auto valuesIn = [](const fs::path &folder) {
        const auto catalogue = dicom::scan({folder});
        const volume::Volume volume =
            dicom::loadVolume(*dicom::defaultSelection(catalogue).volume).volume;
        std::vector<double> values;
        volume.visit([&](auto samples) { values.assign(samples.begin(), samples.end()); });
        return values;
    };
    int number = 0;
    for (const auto syntax : {dicom::TransferSyntax::jpegLs, dicom::TransferSyntax::jpegLossless,
                              dicom::TransferSyntax::jpeg2000, dicom::TransferSyntax::rle,
                              dicom::TransferSyntax::deflated}) {
        const std::string name = "U" + std::to_string(number++);
        const fs::path sent = series(name, 4, 33, syntax);
        server.mayUncompress = false;
        const auto refused = archive::send(server, {sent});
        ASSERT_EQ(refused.notSent.size(), 4U) << name;
        EXPECT_TRUE(refused.notSent.front().reason.is(because::mayBeUncompressed))
            << refused.notSent.front().reason.english();
        server.mayUncompress = true;
        const auto report = archive::send(server, {sent});
        EXPECT_TRUE(report.notSent.empty()) << name << report.notSent.front().reason.english();
        EXPECT_EQ(report.uncompressed, 4U);
        EXPECT_TRUE(get(server, studyIn(sent), "got" + name).isComplete()) << name;
        EXPECT_EQ(valuesIn(m_folder / ("got" + name)), valuesIn(sent)) << name;
    }
}

// Captures in color, too.
TEST_F(Pacs, RefusedColorsAreUncompressedIfAllowed) {
    if (!test::isInstalled("dcmcjpeg") || !test::isInstalled("dcmcrle"))
        GTEST_SKIP() << "dcmtk is not installed";
    test::Dcmqrscp dcmqrscp;
    archive::Server server = serverAt(dcmqrscp.port(), "COMMON");
    const auto run = [](const std::string &command) {
        EXPECT_EQ(test::run(command).exitCode, 0) << command;
    };
    for (const auto &[compress, uncompress] :
         {std::pair("dcmcrle", "dcmdrle"), std::pair("dcmcjpeg +eb", "dcmdjpeg")}) {
        const fs::path of = m_folder / uncompress, sent = of / "sent", plain = of / "plain";
        fs::create_directories(sent);
        fs::create_directories(plain);
        constexpr int height = 20, width = 31;
        std::vector<std::uint8_t> rgba(std::size_t(4) * height * width);
        for (std::size_t n = 0; n < rgba.size(); ++n)
            rgba[n] = std::uint8_t(n % 4 == 3 ? 255 : n * (n % 4 + 1));
        dicom::CaptureLabels labels;
        labels.patientId = "COLORS";
        labels.studyUid = dicom::newSeriesUid(); // any UID
        dicom::writeCapture(of / "made.dcm", rgba, height, width, labels);
        run(std::string(compress) + " '" + (of / "made.dcm").string() + "' '" +
            (sent / "c.dcm").string() + "'");
        run(std::string(uncompress) + " '" + (sent / "c.dcm").string() + "' '" +
            (plain / "c.dcm").string() + "'");
        server.mayUncompress = false;
        EXPECT_EQ(archive::send(server, {sent}).notSent.size(), 1U) << compress;
        server.mayUncompress = true;
        const auto report = archive::send(server, {sent});
        EXPECT_TRUE(report.notSent.empty()) << compress << report.notSent.front().reason.english();
        EXPECT_EQ(report.uncompressed, 1U);
        EXPECT_TRUE(get(server, labels.studyUid, "colors" + std::string(uncompress)).isComplete());
        EXPECT_EQ(dataSetsIn(m_folder / ("colors" + std::string(uncompress))), dataSetsIn(plain))
            << compress;
    }
}

// A server that refuses everything tells whether it refuses the kind of object or its encodings
// (PS3.8, table 9-18).
TEST_F(PacsScripted, ARefusedKindIsNoRefusedEncoding) {
    constexpr int kindIsRefused = 3, encodingIsRefused = 4;
    const fs::path sent = series("R", 2, 16, dicom::TransferSyntax::jpegLs);
    for (const int result : {kindIsRefused, encodingIsRefused}) {
        const test::ScriptedServer scripted(
            [](test::ScriptedAssociation &, const test::ScriptedRequest &) {},
            [result](const std::string &, const std::string &) { return result; });
        archive::Server server = serverAt(scripted.port(), "REFUSES");
        const auto report = archive::send(server, {sent});
        ASSERT_EQ(report.notSent.size(), 2U);
        const task::Reason reason = report.notSent.front().reason;
        EXPECT_EQ(reason.is(because::serverLacksTheService), result == kindIsRefused)
            << reason.english();
        EXPECT_EQ(reason.is(because::mayBeUncompressed), result == encodingIsRefused)
            << reason.english();
        // Also if uncompressing is allowed, which then helps neither.
        server.mayUncompress = true;
        const auto again = archive::send(server, {sent});
        ASSERT_EQ(again.notSent.size(), 2U);
        EXPECT_FALSE(again.notSent.front().reason.is(because::mayBeUncompressed));
    }
}

} // namespace pellucid
