// SPDX-License-Identifier: GPL-3.0-or-later
// Many studies by one recipe.
#include "tests/cli/cli.h"

#include <chrono>
#include <map>
#include <random>
#include <set>
#include <thread>

#include <nlohmann/json.hpp>

#include "core/classify/density_field.h"
#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/dicom/study_index.h"
#include "core/files/video_file.h"
#include "tests/support/files.h"
#include "tests/support/test_data.h"

namespace pellucid {

namespace {

using namespace test;
using nlohmann::json;
using namespace std::chrono_literals;

// What a batch has made: the files of each study, and the records without what differs from run to
// run.
std::map<std::string, std::string> contentsOf(const fs::path &out) {
    std::map<std::string, std::string> contents;
    for (const auto &entry : fs::recursive_directory_iterator(out)) {
        if (!entry.is_regular_file())
            continue;
        std::string text = readText(entry.path());
        if (entry.path().filename() == "done.json") {
            json record = json::parse(text);
            record.erase("seconds");
            text = record.dump();
        }
        contents[entry.path().lexically_relative(out).string()] = text;
    }
    return contents;
}

class Batch : public Cli {
protected:
    // Small studies, each with UIDs of its own.
    fs::path studies(int count, const std::string &options = "--kind head --size 32x32x16") {
        const fs::path all = folder / "studies";
        fs::create_directories(all);
        for (int n = 0; n < count; ++n) {
            const auto r = cli("phantom " + quoted(all / std::to_string(n)) + " " + options);
            EXPECT_EQ(r.exitCode, 0) << r.error;
        }
        return all;
    }
    fs::path recipe(const std::string &outputs) {
        writeText(folder / "recipe.json", R"({"recipe": 1, "outputs": [)" + outputs + "]}");
        return folder / "recipe.json";
    }
    CommandResult batch(const fs::path &recipe, const fs::path &in, const fs::path &out,
                        const std::string &options = "", const std::string &before = "") {
        return cli("batch " + quoted(recipe) + " " + quoted(in) + " --out " + quoted(out) + " " +
                       options,
                   before);
    }
};

const char *const everyFormat =
    R"({"view": "front", "size": 48}, {"name": "grey", "format": "png16", "size": 48},
       {"name": "values", "format": "npy", "view": "left", "size": 48},
       {"name": "volume", "format": "nrrd", "view": "LAO30,CRA20", "size": 48},
       {"name": "capture", "format": "dicom", "look": "Bone", "size": 48},
       {"name": "loop", "format": "dicom-loop", "turntable": 3, "size": 48},
       {"name": "hidden", "format": "dicom", "deidentify": true, "size": 48},
       {"name": "turn", "turntable": 3, "format": "npy", "size": 48},
       {"name": "frames", "turntable": 3, "size": 48})";

} // namespace

// Whatever the number of jobs, threads and parts: the same bits.
TEST_F(Batch, MakesTheSameHoweverItIsDividedUp) {
    const fs::path in = studies(6);
    std::string outputs = everyFormat;
    const bool hasVideo = files::VideoFile::isAvailable() && programOfAnotherSystem() == nullptr;
    if (hasVideo)
        outputs += R"(, {"name": "video", "format": "mp4", "turntable": 4, "size": 48})";
    const fs::path made = recipe(outputs);
    const auto r = batch(made, in, folder / "one", "--jobs 1 --threads 1 --json");
    ASSERT_EQ(r.exitCode, 0) << r.error;
    const json report = json::parse(r.out);
    EXPECT_EQ(report["studies"], 6);
    EXPECT_EQ(report["done"], 6);
    ASSERT_EQ(report["finished"].size(), 6U);
    for (const json &study : report["finished"]) {
        EXPECT_TRUE(fs::exists(folder / "one" / study["study"].get<std::string>() / "done.json"));
        EXPECT_GT(study["error"], 0.0);
    }
    EXPECT_TRUE(report["failed"].empty());
    const auto truth = contentsOf(folder / "one");
    EXPECT_GE(truth.size(), 6U * (hasVideo ? 15U : 14U));
    for (const auto &[name, text] : truth)
        EXPECT_FALSE(text.empty()) << name;
    ASSERT_EQ(batch(made, in, folder / "many", "--jobs 4").exitCode, 0);
    EXPECT_EQ(contentsOf(folder / "many"), truth);
    for (int shard = 0; shard < 3; ++shard)
        ASSERT_EQ(
            batch(made, in, folder / "parts", "--shard " + std::to_string(shard) + "/3").exitCode,
            0);
    EXPECT_EQ(contentsOf(folder / "parts"), truth);
    EXPECT_EQ(entries(folder / "parts"), 6U); // nothing but the studies
}

// One output is what `render` makes.
TEST_F(Batch, MakesWhatRenderMakes) {
    const fs::path in = studies(1, "--kind chest --size 48x40x24 --spacing 8,8,12");
    const fs::path made = recipe(R"({"name": "v", "view": "left", "format": "npy"})");
    ASSERT_EQ(batch(made, in, folder / "out").exitCode, 0);
    const fs::path study = fs::directory_iterator(folder / "out")->path();
    int height = 0, width = 0;
    const auto values = readNpy(study / "v.npy", height, width);
    const auto single = picture(in, "--view left");
    ASSERT_EQ(values.size(), single.size());
    double most = 0.0, difference = 0.0;
    for (std::size_t n = 0; n < values.size(); ++n) {
        most = std::max(most, double(std::abs(single[n])));
        difference = std::max(difference, double(std::abs(values[n] - single[n])));
    }
    EXPECT_LE(difference, 1e-5 * most); // other plans of the Fourier transform round differently
    const json record = json::parse(readText(study / "done.json"));
    EXPECT_LE(record["outputs"][0]["predicted_error"], record["outputs"][0]["tolerance"]);
}

// With less memory, a study is not made in another way: it fails.
TEST_F(Batch, MemoryDecidesWhetherButNotHow) {
    const fs::path in = studies(1, "--kind chest --size 64x64x64");
    const fs::path made =
        recipe(R"({"view": "front", "format": "npy", "tolerance": "fine", "size": 64})");
    ASSERT_EQ(batch(made, in, folder / "much").exitCode, 0);
    const auto truth = contentsOf(folder / "much");
    int done = 0, failed = 0;
    for (int megabytes = 60; megabytes > 1; megabytes = megabytes * 3 / 4) {
        const fs::path out = folder / ("m" + std::to_string(megabytes));
        const auto r = batch(made, in, out, "--memory " + std::to_string(megabytes) + "MB");
        if (r.exitCode == 0) {
            EXPECT_EQ(contentsOf(out), truth) << megabytes;
            EXPECT_EQ(failed, 0) << "less is enough";
            ++done;
        } else {
            EXPECT_EQ(r.exitCode, 7) << r.error;
            EXPECT_NE(r.error.find("need"), std::string::npos) << r.error;
            ++failed;
        }
    }
    EXPECT_GT(done, 0);
    EXPECT_GT(failed, 0);
}

TEST_F(Batch, SkipsWhatIsDoneAndUnchanged) {
    const fs::path in = studies(3);
    const fs::path made = recipe(R"({"view": "front", "format": "npy", "size": 32})");
    const auto report = [&](const std::string &options) {
        const auto r = batch(made, in, folder / "out", options + " --json");
        EXPECT_EQ(r.exitCode, 0) << r.error;
        return json::parse(r.out);
    };
    EXPECT_EQ(report("--resume")["done"], 3);
    EXPECT_EQ(report("--resume")["skipped"], 3);
    EXPECT_EQ(report("")["done"], 3); // made anew
    // Results among the inputs are none themselves.
    const auto within = cli("batch " + quoted(made) + " " + quoted(folder.path()) + " --out " +
                            quoted(folder / "out") + " --resume --json");
    EXPECT_EQ(within.exitCode, 0) << within.error;
    EXPECT_EQ(json::parse(within.out)["skipped"], 3) << within.out;
    // A study that has changed is made again, and so is one whose results have.
    const fs::path file = fs::directory_iterator(in / "1")->path();
    fs::last_write_time(file, fs::last_write_time(file) + 1s);
    EXPECT_EQ(report("--resume")["done"], 1);
    const fs::path study = fs::directory_iterator(folder / "out")->path();
    fs::remove(study / "front.npy");
    EXPECT_EQ(report("--resume")["done"], 1);
    EXPECT_TRUE(fs::exists(study / "front.npy"));
    recipe(R"({"view": "back", "format": "npy", "size": 32})");
    EXPECT_EQ(report("--resume")["done"], 3);
    EXPECT_FALSE(fs::exists(study / "front.npy"));
}

// Broken studies are listed, and do not stop the others.
TEST_F(Batch, ListsWhatFailsAndGoesOn) {
    const fs::path in = studies(4);
    // One study is cut off, one has a single slice, and there are files of other kinds.
    for (const auto &entry : fs::directory_iterator(in / "1"))
        fs::resize_file(entry.path(), fs::file_size(entry.path()) / 2);
    std::vector<fs::path> slices(fs::directory_iterator(in / "2"), {});
    for (std::size_t n = 1; n < slices.size(); ++n)
        fs::remove(slices[n]);
    writeText(in / "notes.txt", "no image");
    const fs::path made = recipe(R"({"view": "front", "format": "npy", "size": 32})");
    const auto r = batch(made, in, folder / "out", "--json");
    EXPECT_EQ(r.exitCode, 7) << r.error;
    const json report = json::parse(r.out);
    EXPECT_EQ(report["done"], 2) << r.out;
    EXPECT_EQ(report["damaged_files"].size(), slices.size()) << r.out;
    EXPECT_EQ(report["without_such_a_series"].size(), 1U) << r.out; // a recipe asks for volumes
    EXPECT_EQ(report["unused_files"].size(), 1U) << r.out;
    EXPECT_EQ(entries(folder / "out"), 2U);
    EXPECT_NE(r.error.find("damaged files: 16"), std::string::npos) << r.error;
}

// Intact files that cannot be projected are no failures; an archive may contain studies.
TEST_F(Batch, FilesOfOtherKindsAreNoFailures) {
    const fs::path in = studies(1);
    writeText(in / ".placeholder", "");
    const fs::path made = recipe(R"({"view": "front", "size": 32})");
    EXPECT_EQ(batch(made, in, folder / "out").exitCode, 0);
    ASSERT_EQ(std::system(("cd " + quoted(in) + " && python3 -m zipfile -c more.zip 0").c_str()),
              0);
    const auto r = batch(made, in, folder / "out");
    EXPECT_EQ(r.exitCode, 7) << r.error;
    EXPECT_NE(r.error.find("more.zip"), std::string::npos) << r.error;
}

// A recipe for other studies is no failure of these.
TEST_F(Batch, PassesOverStudiesWithoutSuchASeries) {
    const fs::path in = studies(2);
    writeText(folder / "mr.json",
              R"({"recipe": 1, "series": {"modality": "MR"}, "outputs": [{"size": 32}]})");
    const auto r = batch(folder / "mr.json", in, folder / "out", "--json");
    EXPECT_EQ(r.exitCode, 0) << r.error;
    const json report = json::parse(r.out);
    EXPECT_EQ(report["without_such_a_series"].size(), 2U);
    EXPECT_TRUE(report["failed"].empty());
    EXPECT_EQ(entries(folder / "out"), 0U);
}

// A look that shows nothing of a study, or is for others, makes no picture of it.
TEST_F(Batch, ALookThatDoesNotSuitIsAFailure) {
    const fs::path in = studies(1);
    const auto fails = [&](const std::string &outputs, const std::string &part) {
        const auto r = batch(recipe(outputs), in, folder / "out");
        EXPECT_EQ(r.exitCode, 7) << r.out;
        EXPECT_NE(r.error.find(part), std::string::npos) << r.error;
        EXPECT_EQ(entries(folder / "out"), 0U);
    };
    writeText(folder / "empty.json",
              R"({"schema": "pellucid-preset/2", "name": "Empty", "modality": "CT", "classes": [
                  {"name": "Nothing", "range": [9000, 9500], "weight": 1, "color": "#ffffff"}]})");
    fails(R"({"look": "empty.json", "size": 32})", "no value is in a shown class");
    fails(R"({"size": 32}, {"name": "b", "look": "MR: brain", "size": 32})", "b: ");
}

// A picture may be seen without the record of its batch.
TEST_F(Batch, PicturesNameTheirErrorAndWarnings) {
    const fs::path in = studies(1);
    std::vector<fs::path> slices(fs::directory_iterator(in / "0"), {});
    std::sort(slices.begin(), slices.end());
    fs::remove(slices[slices.size() / 2]); // a gap
    ASSERT_EQ(
        batch(recipe(R"({"view": "front", "size": 32, "format": "dicom"})"), in, folder / "out")
            .exitCode,
        0);
    const fs::path made = fs::directory_iterator(folder / "out")->path() / "front.dcm";
    const std::string text = readText(made);
    EXPECT_NE(text.find(", measured (relative L2)"), std::string::npos);
    EXPECT_NE(text.find("Not for diagnostic use\r\n"), std::string::npos);
}

// What differs between outputs, such as their warnings, does not tear a study apart.
TEST_F(Batch, DeidentifiedPicturesOfAStudyStayTogether) {
    const fs::path in = studies(1, "--kind head --size 12x12x8");
    const auto made =
        batch(recipe(R"({"name": "a", "format": "dicom", "deidentify": true, "size": 32},
        {"name": "b", "format": "dicom", "deidentify": true, "size": 32, "tolerance": 1e-9,
         "turntable": 2})"),
              in, folder / "out");
    ASSERT_EQ(made.exitCode, 0) << made.error;
    EXPECT_NE(made.error.find("tolerance"), std::string::npos); // b has a warning
    EXPECT_NE(made.out.find("1 beyond the tolerance"), std::string::npos) << made.out;
    const fs::path study = fs::directory_iterator(folder / "out")->path();
    // The value of a UI element of group 0020.
    const auto uidOf = [&](const char *file, char element) {
        const std::string text = readText(study / file);
        const auto at = text.find(std::string{'\x20', '\0', element, '\0', 'U', 'I'});
        return at == std::string::npos ? std::string()
                                       : text.substr(at + 8, std::uint8_t(text[at + 6]));
    };
    EXPECT_FALSE(uidOf("a.dcm", '\x0d').empty());
    EXPECT_EQ(uidOf("a.dcm", '\x0d'), uidOf("b_0000.dcm", '\x0d'));
    EXPECT_EQ(uidOf("b_0000.dcm", '\x0e'), uidOf("b_0001.dcm", '\x0e'));
    EXPECT_NE(uidOf("a.dcm", '\x0e'), uidOf("b_0000.dcm", '\x0e'));
}

// Pictures that fit the body show it larger, and the same of it.
TEST_F(Batch, PicturesFitTheBody) {
    const fs::path in = studies(1, "--kind chest --size 64x64x64 --spacing 6,6,6");
    const fs::path made =
        recipe(R"({"view": "left", "format": "npy", "fit": "body", "size": 100, "name": "sized"},
                  {"view": "left", "format": "npy", "fit": "body", "name": "free"},
                  {"view": "left", "format": "npy", "name": "whole"})");
    ASSERT_EQ(batch(made, in, folder / "out").exitCode, 0);
    const fs::path study = fs::directory_iterator(folder / "out")->path();
    const auto massOf = [&](const std::string &name) {
        int height = 0, width = 0;
        const auto values = readNpy(study / (name + ".npy"), height, width);
        const double pixelMm = json::parse(readText(study / (name + ".json")))["pixel_mm"];
        double sum = 0.0;
        for (const float value : values)
            sum += value;
        return std::pair(sum * pixelMm * pixelMm, width);
    };
    const auto [whole, wholeWidth] = massOf("whole");
    for (const char *const name : {"sized", "free"}) {
        const auto [mass, width] = massOf(name);
        EXPECT_NEAR(mass, whole, 5e-3 * whole) << name; // nothing of the body is cut off
        EXPECT_LT(width, wholeWidth) << name;
    }
    // The command line fits in the same way.
    int height = 0, width = 0;
    const auto single = picture(in, "--view left --fit body");
    const auto values = readNpy(study / "free.npy", height, width);
    ASSERT_EQ(single.size(), values.size());
    expectOneLine(cli("render " + quoted(in) + " -o " + quoted(folder / "x.npy") +
                      " --fit body --size 64 --pixel-mm 2"),
                  2, "--fit");
}

// Volumes in an archive have the same names in every run, and however the batch is divided up.
TEST_F(Batch, VolumesInAnArchiveAreFoundAgain) {
    const fs::path in = studies(2), packed = folder / "packed";
    fs::create_directory(packed);
    for (const char *const name : {"0", "1"})
        ASSERT_EQ(cli("volume " + quoted(in / name) + " -o " +
                      quoted(packed / (std::string(220, name[0]) + ".nrrd")))
                      .exitCode,
                  0);
    const fs::path archive = folder / "volumes.zip";
    ASSERT_EQ(std::system(("cd " + quoted(packed) + " && python3 -m zipfile -c " + quoted(archive) +
                           " *.nrrd")
                              .c_str()),
              0);
    const fs::path made = recipe(R"({"view": "front", "format": "npy", "size": 32})");
    const auto done = [&](const std::string &options, const char *what) {
        const auto r = batch(made, archive, folder / "out", options + " --json");
        EXPECT_EQ(r.exitCode, 0) << r.error;
        return json::parse(r.out)[what].get<int>();
    };
    EXPECT_EQ(done("", "done"), 2);
    EXPECT_EQ(done("--resume", "skipped"), 2);
    EXPECT_EQ(done("--shard 0/2", "done") + done("--shard 1/2", "done"), 2);
    EXPECT_EQ(entries(folder / "out"), 2U);
}

// Results replace results only.
TEST_F(Batch, ReplacesNothingButResults) {
    const fs::path in = studies(1);
    const fs::path made = recipe(R"({"view": "front", "size": 32})");
    ASSERT_EQ(batch(made, in, folder / "out").exitCode, 0);
    const std::string uid = fs::directory_iterator(folder / "out")->path().filename().string();
    const fs::path images = folder / "images" / uid;
    fs::create_directories(images);
    writeText(images / "1.dcm", "an image that was retrieved");
    const auto r = batch(made, in, folder / "images");
    EXPECT_EQ(r.exitCode, 7) << r.error;
    EXPECT_NE(r.error.find(uid + ": is not a folder of results"), std::string::npos) << r.error;
    EXPECT_EQ(readText(images / "1.dcm"), "an image that was retrieved");
    EXPECT_EQ(entries(images), 1U);
    // Someone's notes beside the results are not lost.
    const fs::path results = folder / "out" / uid;
    writeText(results / "notes.txt", "looks odd");
    writeText(results / ".DS_Store", ""); // a file manager looked at them
    const auto kept = batch(made, in, folder / "out");
    EXPECT_EQ(kept.exitCode, 7) << kept.error;
    EXPECT_NE(kept.error.find("contains 'notes.txt', which is not a result"), std::string::npos)
        << kept.error;
    EXPECT_EQ(readText(results / "notes.txt"), "looks odd");
    fs::remove(results / "notes.txt");
    EXPECT_EQ(batch(made, in, folder / "out").exitCode, 0);
}

// A missing slice is reported.
TEST_F(Batch, WarningsOfTheVolumeAreInTheRecord) {
    const fs::path in = studies(1);
    std::vector<fs::path> slices(fs::directory_iterator(in / "0"), {});
    std::sort(slices.begin(), slices.end());
    fs::remove(slices[slices.size() / 2]); // a gap
    ASSERT_EQ(batch(recipe(R"({"view": "front", "size": 32})"), in, folder / "out").exitCode, 0);
    const json record =
        json::parse(readText(fs::directory_iterator(folder / "out")->path() / "done.json"));
    EXPECT_FALSE(record["outputs"][0]["warnings"].empty()) << record;
}

// A kill leaves whole results and nothing else that counts; --resume makes the rest.
TEST_F(Batch, KillsLoseNothing) {
    const fs::path in = studies(8);
    const fs::path made = recipe(R"({"view": "front", "size": 64}, {"turntable": 4, "size": 64})");
    ASSERT_EQ(batch(made, in, folder / "truth").exitCode, 0);
    const auto truth = contentsOf(folder / "truth");
    const bool isLong = std::getenv("PELLUCID_LONG_TESTS") != nullptr;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> seconds(0.02, 1.2);
    int kills = 0, undone = 0;
    const fs::path out = folder / "out";
    for (int round = 0; kills < (isLong ? 50 : 8) && round < 400; ++round) {
        fs::create_directories(out); // a kill may come before the program makes it
        const auto r =
            batch(made, in, out, "--resume", "timeout -s KILL " + std::to_string(seconds(random)));
        if (r.exitCode == 0) { // it was done before the kill
            fs::remove_all(out);
            continue;
        }
        ++kills;
        std::size_t done = 0;
        for (const auto &entry : fs::directory_iterator(out)) {
            if (entry.path().filename().string().front() == '.')
                continue;
            ++done;
            // All of it, and nothing else.
            std::map<std::string, std::string> whole;
            for (const auto &[name, text] : truth)
                if (name.rfind(entry.path().filename().string() + "/", 0) == 0)
                    whole[name.substr(name.find('/') + 1)] = text;
            ASSERT_EQ(contentsOf(entry.path()), whole) << entry.path();
        }
        undone += done < 8 ? 1 : 0;
    }
    EXPECT_GT(undone, 0);
    ASSERT_EQ(batch(made, in, out, "--resume").exitCode, 0);
    EXPECT_EQ(contentsOf(out), truth);
    EXPECT_EQ(entries(out), 8U); // what was unfinished is gone
}

TEST_F(Batch, RefusesWhatMakesNoSense) {
    const fs::path in = studies(1);
    const fs::path made = recipe(R"({"view": "front", "size": 32})");
    const auto refuses = [&](const std::string &options, const std::string &part) {
        expectOneLine(batch(made, in, folder / "out", options), 2, part);
    };
    for (const char *const shard : {"4/4", "-1/4", "1", "a/b", "1/0", "0.5/2", "1/2/3"})
        refuses(std::string("--shard ") + shard, "--shard");
    refuses("--jobs 0", "--jobs");
    refuses("--find modality=CT", "--from");
    refuses("--send nobody", "--send");
    expectOneLine(cli("batch " + quoted(made) +
                      " --from nobody --out x --find modality=CT --find "
                      "modality=MR"),
                  2, "given twice");
    recipe(R"({"view": "front", "size": 32, "format": "dicom"})");
    refuses("--send nobody", "nobody");
    EXPECT_FALSE(fs::exists(folder / "out"));
    expectOneLine(cli("batch " + quoted(made) + " " + quoted(in)), 2, "--out or --send");
    expectOneLine(cli("batch " + quoted(made) + " --out x"), 2, "PATH or --from");
    expectOneLine(batch(folder / "missing.json", in, folder / "out"), 3, "missing.json");
    expectOneLine(batch(made, folder / "nowhere", folder / "out"), 3, "nowhere");
    const fs::path empty = folder / "empty";
    fs::create_directory(empty);
    EXPECT_EQ(batch(made, empty, folder / "out").exitCode, 3);
    ASSERT_EQ(batch(recipe(R"({"view": "front", "size": 32, "format": "dicom"})"), in,
                    folder / "captures")
                  .exitCode,
              0);
    // A square picture needs one number.
    ASSERT_EQ(
        cli("render " + quoted(in) + " -o " + quoted(folder / "s.npy") + " --size 40").exitCode, 0);
    int height = 0, width = 0;
    readNpy(folder / "s.npy", height, width);
    EXPECT_EQ(height, 40);
    EXPECT_EQ(width, 40);
    expectOneLine(batch(made, folder / "captures", folder / "captures"), 3,
                  "all its studies are in the folder of results (--out), which is not searched");
    // A part without studies is no failure.
    int none = 0;
    for (int shard = 0; shard < 50; ++shard)
        none += batch(made, in, folder / "out", "--shard " + std::to_string(shard) + "/50 --json")
                            .out.find("\"studies\": 0") != std::string::npos
                    ? 1
                    : 0;
    EXPECT_EQ(none, 49);
}

// The center of mass of a picture is where its matrix takes that of the field.
TEST_F(Batch, MatricesSayWhereAPointIs) {
    const fs::path in = phantomFolder("--kind chest --size 48x40x24 --spacing 5,5,8");
    const auto catalogue = dicom::scan({in});
    const auto volume = dicom::loadVolume(*dicom::defaultSelection(catalogue).volume).volume;
    const auto field = classify::densityField(volume, classify::defaultFieldWindow(volume));
    glm::dvec3 middle(0.0);
    double mass = 0.0;
    const volume::GridSize size = field.values.lattice().size();
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i) {
                const double value = field.values.value({i, j, k});
                mass += value;
                middle += value * field.values.lattice().patient(volume::VoxelIndex{i, j, k}).mm;
            }
    middle /= mass;
    const glm::dvec3 c = volume.lattice().center().mm;
    json views;
    views["size"] = {104, 100};
    views["pixel_mm"] = 4.0;
    views["views"] = {"AP",
                      "LAO40,CRA25",
                      {{"primary_deg", -100}, {"secondary_deg", -30}, {"roll_deg", 20}},
                      {{"matrix",
                        {{0.25, 0.0, 0.0, 53.3 - 0.25 * c.x},
                         {0.0, 0.0, -0.25, 46.1 + 0.25 * c.z},
                         {0.0, 0.0, 0.0, 1.0}}}}};
    writeText(folder / "list.json", views.dump());
    const std::string render = "render " + quoted(in) + " --matrix " + quoted(folder / "list.json");
    const auto r = cli(render + " -o " + quoted(folder / "views.npy"));
    ASSERT_EQ(r.exitCode, 0) << r.error;
    const json geometry = json::parse(readText(folder / "views.json"));
    ASSERT_EQ(geometry["views"].size(), 4U);
    EXPECT_NEAR(geometry["views"][3]["matrix"][0][3], 53.3 - 0.25 * c.x, 1e-9);
    EXPECT_NEAR(geometry["views"][1]["primary_deg"], 40.0, 1e-9);
    const std::string bytes = readText(folder / "views.npy");
    ASSERT_NE(bytes.find("'shape': (4, 100, 104)"), std::string::npos) << bytes.substr(0, 128);
    const auto *const samples = reinterpret_cast<const float *>(bytes.data() + bytes.size() -
                                                                4 * sizeof(float) * 100 * 104);
    for (int view = 0; view < 4; ++view) {
        double sum = 0.0, column = 0.0, row = 0.0;
        for (int y = 0; y < 100; ++y)
            for (int x = 0; x < 104; ++x) {
                const double value = samples[(view * 100 + y) * 104 + x];
                sum += value;
                column += value * x;
                row += value * y;
            }
        const json &m = geometry["views"][std::size_t(view)]["matrix"];
        const auto along = [&](int n) {
            return m[n][0].get<double>() * middle.x + m[n][1].get<double>() * middle.y +
                   m[n][2].get<double>() * middle.z + m[n][3].get<double>();
        };
        EXPECT_NEAR(column / sum, along(0), 0.02) << view;
        EXPECT_NEAR(row / sum, along(1), 0.02) << view;
    }
    // The list itself is not replaced by the description of its views.
    expectOneLine(cli(render + " -o " + quoted(folder / "list.npy")), 2, "list.json");
    EXPECT_EQ(readText(folder / "list.json"), views.dump());
    expectOneLine(cli(render + " -o " + quoted(folder / "x.png")), 2, ".npy");
    writeText(folder / "bad.json", "{\"views\": [\n\"sideways\"]}");
    expectOneLine(cli("render " + quoted(in) + " --matrix " + quoted(folder / "bad.json") + " -o " +
                      quoted(folder / "x.npy")),
                  3, "line 2");
}

// An index finds the studies that a scan finds.
TEST_F(Batch, AnIndexFindsTheStudiesOfAScan) {
    const fs::path in = studies(3);
    writeText(in / "notes.txt", "no image");
    const auto compare = [](const fs::path &path) {
        const dicom::StudyIndex index = dicom::indexStudies({path});
        const dicom::Catalogue catalogue = dicom::scan({path});
        std::multiset<std::string> indexed, scanned;
        std::size_t filesIndexed = 0;
        for (const dicom::IndexedStudy &study : index.studies) {
            EXPECT_FALSE(study.files.empty());
            filesIndexed += study.files.size();
            if (!study.uid.empty())
                indexed.insert(study.uid);
        }
        for (const dicom::Patient &patient : catalogue.patients)
            for (const dicom::Study &study : patient.studies)
                if (!study.uid.empty())
                    scanned.insert(study.uid);
        EXPECT_EQ(indexed, scanned) << path;
        EXPECT_GT(filesIndexed, 0U) << path;
    };
    compare(in);
    if (const char *const data = std::getenv("PELLUCID_TEST_DATA"))
        for (const char *const name : {"ct_chest_philips_64", "nasty_ct_mixed_series_philips",
                                       "nasty_mr_duplicate_pos_ge_8", "nasty_dicomdir_pydicom"})
            compare(fs::path(data) / name);
}

} // namespace pellucid
