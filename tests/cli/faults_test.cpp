// SPDX-License-Identifier: GPL-3.0-or-later
// Programs are killed, files change, folders are locked. The work is done completely or not at all,
// and one line gives the reason.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <random>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "core/decoding/client/reasons.h"
#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/presets/preset.h"
#include "core/task/error.h"
#include "tests/cli/faults.h"
#include "tests/support/files.h"
#include "tests/support/read_only_folder.h"

namespace pellucid {

using namespace test;

using namespace std::chrono_literals;

namespace {

// Runs the work in a child process and kills it after a while. True if it was killed before it
// ended.
template <class F> bool killedAfter(std::chrono::microseconds time, F &&work) {
    const pid_t child = ::fork();
    if (child == 0) {
        try {
            work();
        } catch (...) {
            ::_exit(9);
        }
        ::_exit(0);
    }
    std::this_thread::sleep_for(time);
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFSIGNALED(status);
}

} // namespace

TEST_F(Faults, AKilledSaveLeavesTheOldOrTheNewPreset) {
    const fs::path path = folder / "kept.json";
    presets::Preset before, after;
    before.name = after.name = "Kept";
    before.look.transferFunction.weights = {0.0, 1.0};
    after.look.transferFunction.weights = {0.5, 1.5, 0.25};
    after.notes = std::string(200000, 'n'); // many writes
    presets::writePreset(path, before);
    std::mt19937 random(3);
    int killed = 0;
    for (int round = 0; round < 60; ++round) {
        const auto &next = round % 2 == 0 ? after : before;
        killed += killedAfter(std::chrono::microseconds(random() % 6000), [&] {
            for (;;)
                presets::writePreset(path, next);
        });
        const auto kept = presets::readPreset(path);
        EXPECT_TRUE(kept.look == before.look || kept.look == after.look);
    }
    EXPECT_EQ(killed, 60);
    // An unfinished file has no name. A complete one is hidden between two system calls.
    std::size_t left = 0;
    for (const auto &entry : fs::directory_iterator(folder.path()))
        if (entry.path() != path) {
            EXPECT_EQ(entry.path().filename().string().front(), '.');
            const auto whole = presets::readPreset(entry.path());
            EXPECT_TRUE(whole.look == before.look || whole.look == after.look);
            ++left;
        }
    EXPECT_LT(left, 20U); // of 60: most are killed earlier
}

TEST_F(Faults, AKilledExportLeavesAWholePictureOrNone) {
    const fs::path in = series("head", 40), out = folder / "out.png";
    const std::string render = program() + " render " + quoted(in) + " -o " + quoted(out);
    using Clock = std::chrono::steady_clock;
    const auto timed = [&](const std::string &command) {
        const auto start = Clock::now();
        const CommandResult result = run(command);
        return std::pair(result, std::chrono::duration<double>(Clock::now() - start).count());
    };
    auto [whole, wholeSeconds] = timed(render);
    ASSERT_EQ(whole.exitCode, 0) << whole.error;
    std::mt19937 random(5);
    int killed = 0;
    for (int round = 0; round < 25; ++round) {
        fs::remove(out);
        const double share = 0.2 + 0.9 * double(random() % 1000) / 1000.0;
        const auto [ended, seconds] =
            timed("timeout -s KILL " + std::to_string(share * wholeSeconds) + " " + render);
        killed += ended.exitCode == 128 + SIGKILL ? 1 : 0;
        if (ended.exitCode == 0) // the machine was busy the first time
            wholeSeconds = std::min(wholeSeconds, seconds);
        if (!fs::exists(out))
            continue;
        const std::string png = readText(out);
        EXPECT_EQ(png.substr(1, 3), "PNG");
        EXPECT_EQ(png.substr(png.size() - 8, 4), "IEND");
    }
    EXPECT_GT(killed, 3); // of 25: some end first
    whole = run(render);
    EXPECT_EQ(whole.exitCode, 0) << whole.error;
}

TEST_F(Faults, AFileThatChangesWhileItIsReadIsAVolumeOrAReason) {
    const fs::path in = series("changing", 30, 256);
    const fs::path victim = in / "IM0011.dcm";
    const std::string whole = readText(victim);
    std::atomic<bool> isOver = false;
    std::jthread changer([&] {
        std::mt19937 random(7);
        while (!isOver) {
            std::error_code ignored;
            switch (random() % 4) {
            case 0:
                fs::resize_file(victim, random() % (whole.size() + 1), ignored);
                break;
            case 1:
                fs::remove(victim, ignored);
                break;
            default:
                writeText(victim, whole);
            }
            std::this_thread::sleep_for(300us);
        }
    });
    int volumes = 0, reasons = 0;
    for (int round = 0; round < 40; ++round) {
        try {
            const auto catalogue = dicom::scan({in});
            const auto loaded = dicom::loadVolume(*dicom::defaultSelection(catalogue).volume);
            const int slices = loaded.volume.lattice().size().k;
            // All slices are there, or a reason is given for the missing one.
            const bool hasReason = !loaded.skipped.empty() || !catalogue.skipped.empty() ||
                                   !loaded.volume.notes().warnings.empty();
            EXPECT_TRUE(slices == 30 || hasReason) << slices;
            ++volumes;
            reasons += hasReason ? 1 : 0;
        } catch (const task::Error &error) {
            EXPECT_FALSE(error.reason().english().empty());
            ++reasons;
        }
    }
    isOver = true;
    EXPECT_GT(volumes, 0);
    EXPECT_GT(reasons, 0); // a change was noticed
}

// Zeros compress to a thousandth, so any archive may contain a gigabyte of them.
TEST_F(Faults, EndlessZerosAreRefusedAndTheDecoderEndsWithTheProgram) {
    const fs::path zeros = folder / "zeros.dcm";
    writeText(zeros, readText(series("few", 2) / "IM0001.dcm").substr(0, 2000));
    fs::resize_file(zeros, 1U << 30); // a sparse file
    const auto result = cli("info " + quoted(zeros));
    expectOneLine(result, 3, "zeros.dcm: ");
    EXPECT_TRUE(result.error.find("has too many data elements for an image") != std::string::npos ||
                result.error.find("takes too long to read") != std::string::npos)
        << result.error;

    // Finds the decoders of a program by name. One of them works for seconds.
    const auto decodersOf = [](pid_t parent) {
        std::vector<pid_t> found;
        for (const auto &entry : fs::directory_iterator("/proc")) {
            if (std::atoi(entry.path().filename().c_str()) == 0)
                continue;
            std::istringstream stat(readText(entry.path() / "stat"));
            pid_t pid = 0, of = 0;
            std::string name, state;
            if (stat >> pid >> name >> state >> of && name == "(pellucid-decode)" && of == parent)
                found.push_back(pid);
        }
        return found;
    };
    const std::string file = program();
    const pid_t child = ::fork();
    if (child == 0) {
        ::execl(file.c_str(), file.c_str(), "info", zeros.c_str(), nullptr);
        ::_exit(9);
    }
    const auto isAtWork = [](pid_t pid) { // it has used half a second
        const std::string stat = readText(fs::path("/proc") / std::to_string(pid) / "stat");
        std::istringstream fields(stat.substr(std::min(stat.size(), stat.find(')') + 1)));
        std::string skipped;
        for (int n = 3; n < 14; ++n)
            fields >> skipped;
        long ticks = 0;
        return fields >> ticks && ticks > ::sysconf(_SC_CLK_TCK) / 2;
    };
    std::vector<pid_t> decoders;
    for (int n = 0; (decoders.empty() || !isAtWork(decoders[0])) && n < 3000; ++n) {
        std::this_thread::sleep_for(10ms);
        decoders = decodersOf(child);
    }
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ASSERT_EQ(decoders.size(), 1U);
    const auto isThere = [&] {
        const std::string stat = readText(fs::path("/proc") / std::to_string(decoders[0]) / "stat");
        return stat.find("(pellucid-decode)") != std::string::npos &&
               stat.find(") Z ") == std::string::npos;
    };
    for (int n = 0; isThere() && n < 300; ++n)
        std::this_thread::sleep_for(10ms);
    EXPECT_FALSE(isThere()); // otherwise it would work for seconds
}

TEST_F(Faults, ScenesThatArePipesOrEndlessAreRefused) {
    const fs::path in = series("head", 4);
    const auto render = [&](const fs::path &scene) {
        return cli("render " + quoted(in) + " -o " + quoted(folder / "out.png") + " --scene " +
                   quoted(scene));
    };
    ASSERT_EQ(std::system(("mkfifo " + quoted(folder / "pipe")).c_str()), 0);
    expectOneLine(render(folder / "pipe"), 3, "is not a regular file");
    writeText(folder / "large.json", std::string(66 << 20, ' '));
    expectOneLine(render(folder / "large.json"), 3,
                  "is larger than the 64 MB limit for this kind of file");
    writeText(folder / "bad.json", "{");
    expectOneLine(render(folder / "bad.json"), 3, "bad.json");
    expectOneLine(render(folder / "absent.json"), 3, "does not exist");
}

// The libraries decode these to the end and report the damage only to a log that nobody reads.
TEST_F(Faults, DamagedCompressedPixelsAreMentioned) {
    for (const auto syntax : {dicom::TransferSyntax::rle, dicom::TransferSyntax::jpegLossless,
                              dicom::TransferSyntax::jpeg2000}) {
        const fs::path in = folder / dicom::transferSyntaxNames().at(std::size_t(syntax));
        dicom::writeCtSeries(in, head(8, 48), {}, syntax);
        const auto volume = [&] {
            return cli("volume " + quoted(in) + " -o " + quoted(folder / "v.nrrd"));
        };
        EXPECT_EQ(volume().error, "") << in;
        // Zeros replace the last bytes; in JPEG files, a few bytes before the end.
        const fs::path victim = in / "IM0004.dcm";
        std::string bytes = readText(victim);
        const std::size_t from = bytes.size() - 900;
        const std::size_t count = syntax == dicom::TransferSyntax::jpegLossless ? 60 : 892;
        bytes.replace(from, count, count, '\0');
        writeText(victim, bytes);
        const auto result = volume();
        EXPECT_EQ(result.exitCode, 0);
        EXPECT_NE(result.error.find("IM0004.dcm"), std::string::npos) << in << result.error;
    }
}

// The picture lacks the unused files of a series, and shows only one of two series.
TEST_F(Faults, UnusedFilesAndSeriesAreReported) {
    const fs::path in = series("mixed", 8);
    fs::resize_file(in / "IM0001.dcm", 4000);
    const auto render = [&] {
        return cli("render " + quoted(in) + " -o " + quoted(folder / "out.png"));
    };
    const auto cut = render();
    EXPECT_EQ(cut.exitCode, 0);
    EXPECT_NE(cut.error.find("IM0001.dcm: not used: the pixel data is truncated"),
              std::string::npos)
        << cut.error;
    // Files with the same reason share a line.
    for (const char *name : {"a.dcm", "b.dcm", "c.dcm", "d.dcm", "e.dcm"})
        std::ofstream(in / name);
    const auto empty = render();
    EXPECT_NE(empty.error.find("5 not used: is empty: "), std::string::npos) << empty.error;
    EXPECT_NE(empty.error.find("c.dcm and 2 others\n"), std::string::npos) << empty.error;
    dicom::writeCtSeries(in / "other", head(3), {.patientName = "Other", .seriesNumber = 2},
                         dicom::TransferSyntax::explicitLittle);
    EXPECT_NE(render().error.find("one of 2 series of 2 patients"), std::string::npos);
}

TEST_F(Faults, InputsAreNotOverwritten) {
    const fs::path in = series("own", 3);
    const std::string before = readText(in / "IM0001.dcm");
    expectOneLine(cli("render " + quoted(in) + " -o " + quoted(in / "IM0001.dcm")), 2,
                  "is one of the files that are read");
    EXPECT_EQ(readText(in / "IM0001.dcm"), before);
    // The frames of a turntable do not overwrite them either.
    fs::rename(in / "IM0001.dcm", in / "turn_0001.dcm");
    expectOneLine(
        cli("render " + quoted(in) + " --turntable --frames 2 -o " + quoted(in / "turn.dcm")), 2,
        "turn_0001.dcm: -o: is one of the files that are read");
    EXPECT_EQ(readText(in / "turn_0001.dcm"), before);
    EXPECT_FALSE(fs::exists(in / "turn_0000.dcm"));
    const fs::path nrrd = folder / "v.nrrd";
    ASSERT_EQ(cli("volume " + quoted(in) + " -o " + quoted(nrrd)).exitCode, 0);
    expectOneLine(cli("volume " + quoted(nrrd) + " --field -o " + quoted(nrrd)), 2,
                  "is one of the files that are read");
}

// The series of two patients have one number: neither may be shown for the other.
TEST_F(Faults, ASeriesOfSeveralPatientsIsAskedForByItsUid) {
    const fs::path both = folder / "both";
    for (const char *patient : {"A", "B"})
        dicom::writeCtSeries(both / patient, head(3), {.patientName = patient, .seriesNumber = 2},
                             dicom::TransferSyntax::explicitLittle);
    const std::string out = " -o " + quoted(folder / "o.png");
    expectOneLine(cli("render " + quoted(both) + out + " --series 2"), 3, "by UID: ");
    EXPECT_FALSE(fs::exists(folder / "o.png"));
}

// A terminal executes control characters.
TEST_F(Faults, ControlCharactersInFileNamesDoNotReachTheTerminal) {
    const fs::path name = folder / "a\x1b[2J\x07\x9b\xe2\x80\xae\xd8\x9c\xe0\x82\x9b\xc2\x9b"
                                   "\xe2\x80\x8b\xf3\xa0\x81\x81"
                                   "31m.dcm";
    writeText(name, "no image");
    const auto r = cli("info " + quoted(folder.path()));
    EXPECT_EQ(r.exitCode, 3);
    const auto json = cli("info --json " + quoted(folder.path()));
    EXPECT_NE(json.out.find("\\u202e"), std::string::npos) << json.out;
    EXPECT_NE(json.out.find("\\udb40\\udc41"), std::string::npos) << json.out;
    for (const std::string &text : {r.out, r.error, json.out}) {
        EXPECT_EQ(text.find_first_of("\x1b\x07"), std::string::npos);
        EXPECT_EQ(text.find('\x9b'), std::string::npos);
        EXPECT_EQ(text.find("\xe2\x80\xae"), std::string::npos); // reverses the text after it
        EXPECT_EQ(text.find("\xd8\x9c"), std::string::npos);
        EXPECT_EQ(text.find("\xe2\x80\x8b"), std::string::npos);     // has no width
        EXPECT_EQ(text.find("\xf3\xa0\x81\x81"), std::string::npos); // is not shown at all
        EXPECT_NE(text.find("31m.dcm"), std::string::npos);
    }
}

// After the scan a file is replaced by another valid slice of the same series.
TEST_F(Faults, ASliceReplacedAfterTheScanIsNamedAndLeftOut) {
    const fs::path in = series("replaced", 30);
    const auto catalogue = dicom::scan({in});
    fs::copy_file(in / "IM0020.dcm", in / "IM0011.dcm", fs::copy_options::overwrite_existing);
    const auto loaded = dicom::loadVolume(*dicom::defaultSelection(catalogue).volume);
    ASSERT_EQ(loaded.skipped.size(), 1U);
    EXPECT_EQ(loaded.skipped[0].path, in / "IM0011.dcm");
    EXPECT_TRUE(loaded.skipped[0].reason.is(task::because::changedWhileRead));
    EXPECT_FALSE(loaded.volume.notes().warnings.empty());
}

TEST_F(Faults, TwentyThousandFilesWithLoopsPipesAndDevicesAreScanned) {
    const fs::path in = series("head", 12);
    fs::create_directories(in / "many");
    for (int n = 0; n < 20000; ++n)
        writeText(in / "many" / ("note" + std::to_string(n)), "no image at all, but a note");
    fs::create_directory_symlink(in, in / "many/loop");
    fs::create_symlink(in / "nowhere", in / "many/broken");
    ASSERT_EQ(std::system(("mkfifo '" + (in / "many/pipe").string() + "'").c_str()), 0);
    fs::create_symlink("/dev/zero", in / "many/zero");
    const auto catalogue = dicom::scan({in});
    EXPECT_EQ(dicom::defaultSelection(catalogue).volume->geometry.lattice.size().k, 12);
    EXPECT_EQ(catalogue.skipped.size(), 20004U);
}

// Nothing is written, and no existing file is harmed.
TEST_F(Faults, AReadOnlyFolderIsLeftAsItIs) {
    const fs::path in = series("head", 12), locked = folder / "locked";
    fs::create_directory(locked);
    const fs::path kept = locked / "kept.json";
    presets::Preset preset;
    preset.name = "Kept";
    presets::writePreset(kept, preset);
    const ReadOnlyFolder lock(locked);
    // Root could write here all the same.
    const std::string as = ::geteuid() == 0 ? "setpriv --bounding-set=-dac_override" : "";
    const std::string render = "render " + quoted(in) + " -o ";
    for (const std::string &command :
         {render + quoted(locked / "o.png"),
          render + quoted(locked / "t.png") + " --turntable --frames 3",
          "volume " + quoted(in) + " -o " + quoted(locked / "o.nrrd"),
          "phantom " + quoted(locked / "p") + " --kind cube --size 8x8x8"}) {
        const auto r = cli(command, as);
        expectOneLine(r, 1, "locked");
        EXPECT_NE(r.error.find("ermission denied"), std::string::npos) << r.error;
    }
    presets::Preset other = preset;
    other.notes = "changed";
    EXPECT_THROW(presets::writePreset(kept, other), task::Error);
    EXPECT_TRUE(presets::readPreset(kept).notes.empty());
    EXPECT_EQ(entries(locked), 1U);
}

} // namespace pellucid
