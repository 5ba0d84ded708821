// SPDX-License-Identifier: GPL-3.0-or-later
// A command that cannot succeed ends with one line, the documented exit code and no partial file.
#include "tests/cli/cli.h"

#include <unistd.h>

#include "tests/support/dicom_writer.h"
#include "tests/support/files.h"
#include "tests/support/test_data.h"

namespace pellucid {

namespace {

using namespace test;

TEST_F(Cli, UsageErrorsNameTheOption) {
    const std::string out = " -o " + (folder / "o.png").string();
    expectOneLine(cli(""), 2, "subcommand");
    expectOneLine(cli("render"), 2, "--output");
    expectOneLine(cli("render -o x.png"), 2, "PATH");
    for (const char *bad : {"Bone=1", "bone", "bone=x", "bone=3", "bone=1:red", "bone=1:#12345"})
        expectOneLine(cli("render /tmp" + out + " --class " + bad), 2, "");
    for (const char *bad : {"1", "1,x", "1,3", "1,1,", "1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1"})
        expectOneLine(cli("render /tmp" + out + " --bezier " + bad), 2, "");
    expectOneLine(cli("render /tmp" + out + " --view sideways"), 2, "--view");
    expectOneLine(cli("render /tmp -o /tmp/x.bmp"), 2, "x.bmp");
    expectOneLine(cli("render /tmp" + out + " --frames 3"), 2, "--turntable");
    expectOneLine(cli("render /tmp" + out + " --engine fast"), 2, "--engine");
    expectOneLine(cli("phantom " + (folder / "p").string() + " --kind torso"), 2, "--kind");
    expectOneLine(cli("phantom " + (folder / "p").string() + " --transfer-syntax gif"), 2, "gif");
    expectOneLine(cli("phantom " + (folder / "p").string() + " --spacing 1,2"), 2, "--spacing");
    const fs::path series = phantomFolder("--kind cube --size 16x16x16");
    expectOneLine(cli("render " + quoted(series) + out + " --orientation 0,0,0,0"), 2, "zero");
    expectOneLine(cli("render " + quoted(series) + out + " --scene ''"), 2, "--scene");
    expectOneLine(cli("render " + quoted(series) + out + " --window 5,1"), 2, "--window");
    expectOneLine(cli("render " + quoted(series) + out + " --size 10x10x10"), 2, "--size");
    expectOneLine(cli("render " + quoted(series) + out + " --memory 1000"), 4, "MB");
    // A pixel so small that the slice would not fit any machine.
    expectOneLine(cli("render " + quoted(series) + out + " --pixel-mm 1e-5 --size 10x10"), 4,
                  "pixels");
    EXPECT_FALSE(fs::exists(folder / "o.png"));
}

TEST_F(Cli, APhantomReplacesNothing) {
    const std::string command = "phantom " + quoted(folder / "p") + " --kind cube --size 8x8x";
    fs::create_directory(folder / "p");
    std::ofstream(folder / "p/IM0003.dcm") << "of somebody";
    expectOneLine(cli(command + "4"), 1, "IM0003.dcm: already exists");
    EXPECT_FALSE(fs::exists(folder / "p/IM0001.dcm"));
    EXPECT_EQ(test::readText(folder / "p/IM0003.dcm"), "of somebody");
    EXPECT_EQ(cli(command + "2").exitCode, 0);
}

TEST_F(Cli, BadInputIsOneLineAndExitCodeThree) {
    const std::string out = " -o " + (folder / "o.png").string();
    fs::create_directory(folder / "empty");
    std::ofstream(folder / "text.txt") << "The quick brown fox jumps over the lazy dog.\n";
    for (const char *command : {"render", "info", "volume"}) {
        const std::string target = std::string(command) == "info" ? ""
                                   : std::string(command) == "volume"
                                       ? " -o " + (folder / "o.nrrd").string()
                                       : out;
        expectOneLine(cli(std::string(command) + " " + quoted(folder / "absent") + target), 3,
                      "absent");
        expectOneLine(cli(std::string(command) + " " + quoted(folder / "empty") + target), 3,
                      "empty");
        expectOneLine(cli(std::string(command) + " " + quoted(folder / "text.txt") + target), 3,
                      "text.txt");
    }
    const fs::path series = phantomFolder("--kind cube --size 32x32x1");
    fs::resize_file(series / "IM0001.dcm", 1500);
    expectOneLine(cli("render " + quoted(series / "IM0001.dcm") + out), 3, "IM0001.dcm");
    EXPECT_FALSE(fs::exists(folder / "o.png"));
}

TEST_F(Cli, AFolderWithoutPermissionIsNamed) {
    if (geteuid() == 0)
        GTEST_SKIP() << "root may read everything";
    fs::create_directory(folder / "locked");
    fs::permissions(folder / "locked", fs::perms::none);
    expectOneLine(cli("info " + quoted(folder / "locked")), 3, "locked");
    fs::permissions(folder / "locked", fs::perms::owner_all);
}

// Root may read every folder, so this test runs the program as another user.
TEST_F(Cli, AFolderOfAnotherUserIsNamed) {
    PELLUCID_NEEDS_THIS_SYSTEM("Wine belongs to one user");
    if (geteuid() != 0)
        GTEST_SKIP() << "needs root to become another user";
    fs::permissions(folder.path(),
                    fs::perms::owner_all | fs::perms::others_exec | fs::perms::others_read);
    fs::create_directory(folder / "locked");
    fs::permissions(folder / "locked", fs::perms::owner_all);
    const auto r = run("setpriv --reuid=65534 --clear-groups test -x " + program());
    if (r.exitCode != 0)
        GTEST_SKIP() << "the program is not reachable for another user";
    expectOneLine(cli("info " + quoted(folder / "locked"), "setpriv --reuid=65534 --clear-groups"),
                  3, "locked");
}

TEST_F(Cli, AFullDiskLeavesNothingBehind) {
    PELLUCID_NEEDS_THIS_SYSTEM("Wine's own files are larger than the limit");
    // The limit on the size of files also applies to the decoder's arena, which has a megabyte.
    const fs::path series = phantomFolder("--kind head --size 120x120x80");
    const std::string full = "ulimit -f 2200;"; // in blocks of 512 bytes
    fs::create_directory(folder / "out");
    for (const char *name : {"o.npy", "o.nrrd"})
        expectOneLine(cli("render " + quoted(series) + " --size 2000x2000 -o " +
                              quoted(folder / "out" / name),
                          full),
                      1, name);
    expectOneLine(cli("volume " + quoted(series) + " -o " + quoted(folder / "out/v.nrrd"), full), 1,
                  "v.nrrd");
    expectOneLine(
        cli("phantom " + quoted(folder / "out/p") + " --kind cube --size 64x64x8", "ulimit -f 4;"),
        1, "IM000");
    expectOneLine(cli("render " + quoted(series) + " -o " + quoted(folder / "no/such/folder.png")),
                  1, "folder.png");
    EXPECT_EQ(entries(folder / "out"), 0U);
}

TEST_F(Cli, AnInterruptEndsWithOneLineAndNoFile) {
    const fs::path out = folder / "series";
    // A second thread means that the program handles signals: a signal sent while the libraries are
    // still loading would end the process without a message.
    const auto r = run(program() + " phantom " + out.string() +
                       " --kind head --size 600x600x600 & p=$!; "
                       "until [ \"$(ls /proc/$p/task 2>/dev/null | wc -l)\" -gt 1 ]; do "
                       "kill -0 $p || exit 1; sleep 0.01; done; kill -INT $p; wait $p");
    expectOneLine(r, 130, "cancelled");
    EXPECT_FALSE(fs::exists(out));
}

} // namespace
} // namespace pellucid
