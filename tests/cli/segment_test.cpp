// SPDX-License-Identifier: GPL-3.0-or-later
// Segmentations on the command line: shown, listed, written.
#include "tests/cli/cli.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/classify/shown_fields.h"
#include "core/decoding/client/read_volume_file.h"
#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/preprocess/segment_class.h"
#include "core/preprocess/step_cache.h"
#include "core/reference/wide_kernel.h"
#include "core/scene/scene.h"
#include "core/segment/reasons.h"
#include "core/segment/segment_set.h"
#include "core/subtraction/difference.h"
#include "core/volume/nrrd.h"

namespace pellucid {

namespace {

using namespace test;
using nlohmann::json;

volume::Volume volumeIn(const fs::path &series) {
    const auto catalogue = dicom::scan({series});
    return dicom::loadVolume(*dicom::defaultSelection(catalogue).volume).volume;
}

TEST_F(Cli, SegmentsAreProjectedAsTheExactReferenceDoes) {
    const fs::path series = phantomFolder("--kind chest --size 48x44x36"),
                   organs = folder / "organs.dcm", out = folder / "image.npy";
    auto r = cli("segment " + quoted(series) + " --class bone:#ff8000 --class lung:#0040ff -o " +
                 quoted(organs) + " --json");
    ASSERT_EQ(r.exitCode, 0) << r.error;
    EXPECT_EQ(json::parse(r.out)["segments"].size(), 2U);
    const volume::Volume volume = volumeIn(series);
    auto camera = scene::defaultCamera(volume.lattice());
    camera.orientation = scene::viewOrientation(scene::StandardView::front, {20, 0, 0});
    const auto set =
        segment::SegmentSet(volume.lattice()).with(segment::loadSegmentation(organs, volume));
    preprocess::StepCache steps(0);
    preprocess::ClassRunner runner(steps, set);
    const auto classes = [&](std::vector<std::pair<const char *, double>> names) {
        classify::Look look;
        for (const auto &[name, weight] : names) {
            look.classes.push_back(preprocess::classOf(*set->find(name), 0));
            look.classes.back().weight = weight;
        }
        return look;
    };
    const struct {
        std::string options;
        classify::Look look;
    } cases[] = {{"", classes({{"bone", 1.0}, {"lung", 1.0}})},
                 {" --segment 'b*=0.5' --segment lung=2", classes({{"bone", 0.5}, {"lung", 2.0}})},
                 {" --segment lung=1", classes({{"lung", 1.0}})}};
    for (const auto &c : cases) {
        r = cli("render " + quoted(series) + " -o " + quoted(out) + " --azimuth 20 --json" +
                " --segmentation " + quoted(organs) + c.options);
        ASSERT_EQ(r.exitCode, 0) << r.error;
        const json report = json::parse(r.out);
        EXPECT_EQ(report["segmentations"][0]["segments"].size(), 2U);
        const auto fields =
            classify::shownFields(volume, classify::defaultFieldWindow(volume), c.look, &runner);
        int height = 0, width = 0;
        const auto got = readNpy(out, height, width, 3);
        ASSERT_EQ(got.size(), std::size_t(3 * camera.width * camera.height));
        std::vector<double> expected(got.size());
        for (std::size_t n = 0; n < fields.channels.size(); ++n) {
            const classify::DensityField &field = fields.channels[n];
            const auto image = reference::WideKernel(field.values, field.support).image(camera, {});
            const double color[] = {fields.colors[n].red, fields.colors[n].green,
                                    fields.colors[n].blue};
            for (std::size_t p = 0; p < image.size(); ++p)
                for (std::size_t d = 0; d < 3; ++d)
                    expected[3 * p + d] += color[d] * image[p];
        }
        double error = 0.0, sum = 0.0;
        for (std::size_t n = 0; n < got.size(); ++n) {
            error += (got[n] - expected[n]) * (got[n] - expected[n]);
            sum += expected[n] * expected[n];
        }
        EXPECT_LE(std::sqrt(error / sum), report["predicted_error"]["relative_l2"].get<double>());
        EXPECT_LE(std::sqrt(error / sum), 1.1e-3);
    }
}

TEST_F(Cli, ScenesKeepClassesOfSegments) {
    const fs::path series = phantomFolder("--kind chest --size 32x32x24"),
                   organs = folder / "organs.dcm", out = folder / "image.png",
                   scene = folder / "scene.json";
    ASSERT_EQ(cli("segment " + quoted(series) + " --class bone -o " + quoted(organs)).exitCode, 0);
    classify::TissueClass tissue{"spine", classify::lowestValue, classify::highestValue};
    tissue.segment = "bone";
    tissue.edge = 0.7;
    scene::Scene made;
    made.camera.width = made.camera.height = 32;
    made.camera.pixelMm = 10.0;
    made.look.classes = {tissue};
    EXPECT_EQ(scene::sceneFromJson(scene::toJson(made)).look, made.look);
    std::ofstream(scene) << scene::toJson(made);
    const std::string command =
        "render " + quoted(series) + " --scene " + quoted(scene) + " -o " + quoted(out);
    expectOneLine(cli(command), 2, "the class 'spine' needs the segment 'bone'");
    EXPECT_FALSE(fs::exists(out));
    EXPECT_EQ(cli(command + " --segmentation " + quoted(organs)).exitCode, 0);
    EXPECT_TRUE(fs::exists(out));
}

TEST_F(Cli, InfoListsSegmentationsOfTheStudy) {
    const fs::path series = phantomFolder("--kind chest --size 32x32x24");
    ASSERT_EQ(cli("segment " + quoted(series) + " --class bone --class fat -o " +
                  quoted(series / "organs.dcm"))
                  .exitCode,
              0);
    const auto r = cli("info --json " + quoted(series));
    ASSERT_EQ(r.exitCode, 0) << r.error;
    const json study = json::parse(r.out)["patients"][0]["studies"][0];
    ASSERT_EQ(study["segmentations"].size(), 1U);
    EXPECT_EQ(study["segmentations"][0]["segments"], json({"bone", "fat"}));
    EXPECT_EQ(json::parse(r.out)["skipped"].size(), 0U);
    EXPECT_NE(cli("info " + quoted(series)).out.find("2 segments: bone, fat"), std::string::npos);
    // It is a file that is read.
    expectOneLine(cli("render " + quoted(series) + " -o " + quoted(series / "organs.dcm")), 2,
                  "is one of the files that are read");
}

// Labels beside the volume's samples: a line of the log, and of the report, says how far.
TEST_F(Cli, SaysHowFarSegmentsAreFromTheSamples) {
    const fs::path series = phantomFolder("--kind sphere --size 24x24x24"),
                   labels = folder / "labels.nrrd", out = folder / "image.png";
    const volume::Lattice lattice = volumeIn(series).lattice();
    for (const double part : {0.0, 0.25}) { // of a column
        const auto moved =
            volume::Lattice::make(lattice.size(), {lattice.origin().mm + part * lattice.step(0)},
                                  {lattice.step(0), lattice.step(1), lattice.step(2)});
        volume::writeNrrd(
            labels, volume::Volume(moved, std::vector<std::int16_t>(lattice.size().count(), 1),
                                   volume::ValueUnit::none));
        const auto r = cli("render " + quoted(series) + " -o " + quoted(out) + " --json" +
                           " --segmentation " + quoted(labels));
        ASSERT_EQ(r.exitCode, 0) << r.error;
        const json warnings = json::parse(r.out)["segmentations"][0]["warnings"];
        const std::string expected = task::because::segmentsBetweenSamples(
                                         fmt::format("{:.3g}", 0.25 * lattice.spacingMm(0)))
                                         .english();
        EXPECT_EQ(warnings, part > 0.0 ? json::array({expected}) : json::array());
        EXPECT_EQ(r.error.find(expected) != std::string::npos, part > 0.0) << r.error;
    }
}

TEST_F(Cli, GrowsARegionAndWritesIt) {
    const fs::path series = phantomFolder("--kind sphere --size 40x40x40"),
                   out = folder / "ball.nrrd", field = folder / "field.nrrd";
    const volume::Volume volume = volumeIn(series);
    const double inside = volume.value({20, 20, 20});
    const auto r =
        cli("segment " + quoted(series) + " --grow 0,0,0 --between " + std::to_string(inside - 1) +
            "," + std::to_string(inside + 1) + " --name ball -o " + quoted(out) + " --json");
    ASSERT_EQ(r.exitCode, 0) << r.error;
    const auto segments = json::parse(r.out)["segments"];
    EXPECT_EQ(segments[0]["name"], "ball");
    const volume::Volume labels = decoding::readVolumeFile(out);
    double samples = 0.0;
    for (int k = 0; k < 40; ++k)
        for (int j = 0; j < 40; ++j)
            for (int i = 0; i < 40; ++i) {
                EXPECT_EQ(labels.value({i, j, k}) == 1.0,
                          std::abs(volume.value({i, j, k}) - inside) <= 1.0);
                samples += labels.value({i, j, k});
            }
    EXPECT_NEAR(segments[0]["volume_ml"].get<double>(),
                samples * volume.lattice().cellVolumeMm3() / 1000.0, 1e-6);
    // Its field, by the name that the label volume keeps.
    ASSERT_EQ(cli("volume " + quoted(series) + " --segmentation " + quoted(out) +
                  " --segment ball --window 0,100 -o " + quoted(field))
                  .exitCode,
              0);
    EXPECT_GT(decoding::readVolumeFile(field).value({20, 20, 20}), 0.0);
}

// A class that needs a point gets it, or is refused; a scene keeps it.
TEST_F(Cli, TheClassOfAPresetIsGivenItsPoint) {
    const fs::path series = phantomFolder("--kind sphere --size 32x32x32"),
                   preset = folder / "grow.json", out = folder / "part.nrrd";
    std::ofstream(preset)
        << R"({"schema":"pellucid-preset/2","name":"Grow","classes":[{"name":"Ball",)"
           R"("range":[-100,30000],"steps":[{"kind":"connected"}]}]})";
    const std::string segment =
        "segment " + quoted(series) + " --preset " + quoted(preset) + " -o " + quoted(out);
    expectOneLine(cli(segment), 2, "the class 'Ball' needs a point in the patient");
    expectOneLine(cli(segment + " --point Ball=0,0"), 2, "--point");
    expectOneLine(cli(segment + " --point 0,0,0"), 2, "is not NAME=x,y,z");
    expectOneLine(cli(segment + " --point Cube=0,0,0"), 2, "no class 'Cube' takes points");
    expectOneLine(cli(segment + " --point Ball=0,0,9999"), 2, "is outside the volume");
    const auto r = cli(segment + " --point Ball=0,0,0 --json");
    ASSERT_EQ(r.exitCode, 0) << r.error;
    const json report = json::parse(r.out);
    EXPECT_GT(report["segments"][0]["volume_ml"].get<double>(), 0.0);
    EXPECT_GE(report["times_ms"]["find"].get<double>(), 0.0);
    EXPECT_EQ(decoding::readVolumeFile(out).value({16, 16, 16}), 1.0F);
}

TEST_F(Cli, SubtractsWithWeights) {
    const fs::path series = phantomFolder("--kind head --size 24x24x24"), out = folder / "sum.nrrd";
    const std::string volume = "volume " + quoted(series) + " --subtract " + quoted(series) +
                               " --field --window 0,4000 -o " + quoted(out) + " --weights ";
    // Twice the volume without the volume is the volume.
    ASSERT_EQ(cli(volume + "2,-1").exitCode, 0);
    const volume::Volume before = volumeIn(series), field = decoding::readVolumeFile(out);
    for (const int i : {4, 9, 12, 15})
        EXPECT_NEAR(field.value({i, 12, 12}),
                    std::clamp(double(before.value({i, 12, 12})) / 4000.0, 0.0, 1.0), 1e-5);
    expectOneLine(cli(volume + "1,-3"), 2, "the weight -3 is not between -2 and 2");
    expectOneLine(cli(volume + "1"), 2, "--weights");
}

// The difference of two phantoms is projected as the exact reference projects it.
TEST_F(Cli, SubtractsAnotherVolumeExactly) {
    const fs::path series = phantomFolder("--kind chest --size 48x44x36"),
                   other = phantomFolder("--kind head --size 48x44x36 --spacing 8,8,10"),
                   out = folder / "image.npy";
    const volume::Volume a = volumeIn(series), b = volumeIn(other);
    const auto d = subtraction::difference(a, b);
    for (const auto &[options, look] :
         {std::pair(std::string(), classify::Look()),
          std::pair(std::string(" --class loss=1"),
                    classify::Look{{}, {classify::differenceClasses()[1]}})}) {
        auto r = cli("render " + quoted(series) + " --subtract " + quoted(other) + " -o " +
                     quoted(out) + " --json --window 0,500" + options);
        ASSERT_EQ(r.exitCode, 0) << r.error;
        classify::Look grey = look;
        for (classify::TissueClass &tissue : grey.classes)
            tissue.color = {};
        preprocess::StepCache steps(0);
        const auto fields = classify::shownFields(d, {0.0, 500.0}, grey, &steps);
        const auto &field = fields.channels.front();
        auto camera = scene::defaultCamera(a.lattice());
        camera.orientation = scene::viewOrientation(scene::StandardView::front, {0, 0, 0});
        int height = 0, width = 0;
        const auto got = readNpy(out, height, width);
        const auto truth = reference::WideKernel(field.values, field.support).image(camera, {});
        ASSERT_EQ(got.size(), truth.size());
        double error = 0.0, sum = 0.0;
        for (std::size_t n = 0; n < got.size(); ++n) {
            error += (got[n] - truth[n]) * (got[n] - truth[n]);
            sum += truth[n] * truth[n];
        }
        const double relative = std::sqrt(error / sum);
        EXPECT_LE(relative, 1.1e-3) << options;
        EXPECT_LE(relative, json::parse(r.out)["predicted_error"]["relative_l2"].get<double>());
        EXPECT_TRUE(json::parse(r.out)["registration"].is_null());
    }
    const auto r = cli("render " + quoted(series) + " --subtract " + quoted(series) +
                       " --register rigid -o " + quoted(out) + " --json --window 0,500");
    ASSERT_EQ(r.exitCode, 0) << r.error;
    const json registration = json::parse(r.out)["registration"];
    EXPECT_LT(registration["angle_deg"].get<double>(), 0.1);
    expectOneLine(cli("render " + quoted(series) + " --register rigid -o " + quoted(out)), 2,
                  "--subtract");
    expectOneLine(cli("render " + quoted(series) + " --subtract " + quoted(folder / "none") +
                      " -o " + quoted(out)),
                  3, "none");
}

TEST_F(Cli, SegmentOptionsAreRefusedWithAReason) {
    const fs::path series = phantomFolder("--kind sphere --size 24x24x24"),
                   other = phantomFolder("--kind sphere --size 24x24x24"), out = folder / "o.dcm",
                   organs = folder / "organs.dcm";
    ASSERT_EQ(
        cli("segment " + quoted(other) + " --grow 0,0,0 --between -2000,3000 -o " + quoted(organs))
            .exitCode,
        0);
    const std::string start = "segment " + quoted(series) + " ";
    const std::string to = " -o " + quoted(out);
    expectOneLine(cli(start + "--class bone -o " + quoted(folder / "o.png")), 2,
                  "must end in .dcm or .nrrd");
    expectOneLine(cli(start + to), 2, "name what to write");
    expectOneLine(cli(start + "--class nose" + to), 2, "unknown class 'nose'");
    expectOneLine(cli(start + "--grow 0,0,0" + to), 2, "--between");
    expectOneLine(cli(start + "--grow 0,0 --between 1,2" + to), 2, "--grow");
    expectOneLine(cli(start + "--grow 0,0,9000 --between 1,2" + to), 2, "outside the volume");
    expectOneLine(cli(start + "--grow 0,0,0 --between 30000,30001" + to), 2,
                  "no value at the points to grow from");
    expectOneLine(cli(start + "--segment a" + to), 2, "--segmentation");
    expectOneLine(cli("render " + quoted(other) + " --segmentation " + quoted(organs) +
                      " --segmentation " + quoted(organs) + " -o " + quoted(folder / "p.png")),
                  2, "given twice");
    expectOneLine(cli(start + "--segmentation " + quoted(organs) + to), 3,
                  "belongs to another study");
    expectOneLine(cli(start + "--segmentation " + quoted(folder / "none.dcm") + to), 3, "none.dcm");
    expectOneLine(cli("segment " + quoted(other) + " --segmentation " + quoted(organs) +
                      " --segment nose" + to),
                  2, "no segment 'nose'; there are: region");
    EXPECT_FALSE(fs::exists(out));
}

} // namespace

} // namespace pellucid
