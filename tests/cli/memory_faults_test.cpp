// SPDX-License-Identifier: GPL-3.0-or-later
// Files that ask for more memory than there is, and programs that are given little.
#include <cstdlib>

#include "core/decoding/client/reasons.h"
#include "core/dicom/scan.h"
#include "tests/cli/faults.h"
#include "tests/support/little_memory.h"

namespace pellucid {

using namespace test;

#ifndef PELLUCID_SANITIZED // sanitizers reserve terabytes
// A file that asks for more memory than there is costs only itself.
TEST_F(Faults, AFileThatAnnouncesTooMuchCostsNoOther) {
    const fs::path in = series("both", 12, 256), huge = folder / "both/A.dcm";
    std::string type = "ORIGINAL";
    while (type.size() < 700)
        type += "\\\\ABCDEFGHIJKLMNOP";
    fs::copy_file(in / "IM0001.dcm", huge);
    ASSERT_EQ(
        run("dcmodify -nb -gin -m Rows=1 -m Columns=1 -i NumberOfFrames=65000 -i ImageType=\"" +
            type + "\" " + quoted(huge))
            .exitCode,
        0);
    const test::LittleMemory little(700);
    const auto catalogue = dicom::scan({in});
    ASSERT_EQ(catalogue.skipped.size(), 1U);
    EXPECT_EQ(catalogue.skipped[0].path, huge);
    EXPECT_TRUE(catalogue.skipped[0].reason.is(task::because::needsTooMuchMemory));
    EXPECT_EQ(dicom::defaultSelection(catalogue).volume->frames.size(), 12U);
}

// Each file has a few kilobytes and announces a hundred thousand frames.
TEST_F(Faults, ManyFramesOfSmallFilesStayWithinMemory) {
    const fs::path in = series("frames", 1, 256);
    std::string type = "ORIGINAL";
    while (type.size() < 400)
        type += "\\\\ABCDEFGHIJKLMNOP";
    ASSERT_EQ(
        std::system(("dcmodify -nb -m Rows=1 -m Columns=1 -i NumberOfFrames=65000 -i ImageType=\"" +
                     type + "\" " + quoted(in / "IM0001.dcm") + " > /dev/null")
                        .c_str()),
        0);
    for (int n = 2; n < 24; ++n) {
        const fs::path copy = in / ("IM" + std::to_string(n) + ".dcm");
        fs::copy_file(in / "IM0001.dcm", copy);
        ASSERT_EQ(std::system(("dcmodify -nb -gin " + quoted(copy) + " > /dev/null").c_str()), 0);
    }
    for (const char *limit : {"ulimit -v 1500000;", "ulimit -v 3000000;"}) {
        const auto r = cli("info " + quoted(in), limit);
        EXPECT_TRUE(r.exitCode == 0 || r.exitCode == 3 || r.exitCode == 4) << r.exitCode << r.error;
        EXPECT_NE((r.out + r.error).find("memory"), std::string::npos) << r.error;
    }
}

// Memory grows in steps from too little to start to enough. The work is done, or refused in one
// line with a documented code.
TEST_F(Faults, LittleMemoryIsRefusedOrReduced) {
    const fs::path in = series("head", 96, 192), out = folder / "out.png";
    int done = 0, refused = 0;
    for (int mb = 150; mb <= 1500; mb += 75) {
        fs::remove(out);
        const std::string limit = "ulimit -v " + std::to_string(mb * 1024) + ";";
        if (cli("--version", limit).exitCode != 0)
            continue; // the libraries themselves do not fit
        const auto r = cli("render " + quoted(in) + " -o " + quoted(out) + " --threads 2", limit);
        EXPECT_EQ(fs::exists(out), r.exitCode == 0) << mb;
        if (r.exitCode == 0) {
            ++done;
            continue;
        }
        ++refused;
        // The decoder has the same limit.
        const bool isDecoder = r.error.find("the decoder cannot be started") != std::string::npos;
        EXPECT_EQ(r.exitCode, isDecoder ? 1 : 4) << mb << " MB: " << r.error;
        EXPECT_TRUE(isDecoder || r.error.find("memory") != std::string::npos) << mb << r.error;
    }
    EXPECT_GT(done, 0);
    EXPECT_GT(refused, 0);
}
#endif

} // namespace pellucid
