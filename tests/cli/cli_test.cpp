// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cli/cli.h"

#include <cmath>
#include <map>
#include <set>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "core/decoding/client/read_volume_file.h"
#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/dicom/write_series.h"
#include "core/reference/wide_kernel.h"
#include "core/scene/scene.h"
#include "core/volume/nrrd.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/fields.h"
#include "tests/support/files.h"
#include "tests/support/test_data.h"

namespace pellucid {

namespace {

using namespace test;
using nlohmann::json;

struct RenderCase {
    const char *name, *phantom, *view;
    scene::StandardView standard;
    scene::ViewAngles angles;
};

// The promise of the default quality, end to end: relative L2 at most 1.1e-3 against the exact
// image.
TEST_F(Cli, RendersToNumbersThatTheExactReferenceConfirms) {
    using scene::StandardView;
    const RenderCase cases[] = {
        {"isotropic head", "--kind head --size 64x64x60", "--view front", StandardView::front, {}},
        {"anisotropic chest",
         "--kind chest --size 80x64x24 --spacing 5,5,15",
         "--view left --azimuth 20 --elevation 15 --roll 7",
         StandardView::left,
         {20, 15, 7}},
        {"tilted head",
         "--kind head --size 60x64x20 --spacing 4,3.8,12 --tilt 25",
         "--view top --elevation -33",
         StandardView::top,
         {0, -33, 0}},
        {"cube on axis", "--kind cube --size 40x40x40", "--view bottom", StandardView::bottom, {}}};
    for (const RenderCase &c : cases) {
        const fs::path series = phantomFolder(c.phantom), out = folder / "image.npy";
        const auto r = cli("render " + quoted(series) + " -o " + quoted(out) + " --json " + c.view);
        ASSERT_EQ(r.exitCode, 0) << r.error;
        const auto catalogue = dicom::scan({series});
        const auto volume = dicom::loadVolume(*dicom::defaultSelection(catalogue).volume).volume;
        const auto field = classify::densityField(volume, classify::defaultFieldWindow(volume));
        auto camera = scene::defaultCamera(volume.lattice());
        camera.orientation = scene::viewOrientation(c.standard, c.angles);
        int height = 0, width = 0;
        const auto image = readNpy(out, height, width);
        ASSERT_EQ(width, camera.width) << c.name;
        ASSERT_EQ(height, camera.height) << c.name;
        const auto truth = reference::WideKernel(field.values, field.support).image(camera, {});
        const double error = test::relativeL2(image, truth);
        EXPECT_LT(error, 1.1e-3) << c.name;
        const json figures = json::parse(r.out)["predicted_error"];
        const double predicted = figures["relative_l2"];
        EXPECT_TRUE(figures["whole"]) << r.out;
        EXPECT_LE(error, predicted) << c.name;
        const json measured = json::parse(r.out)["measured_error"];
        EXPECT_LE(measured["low"], error) << c.name;
        EXPECT_LE(error, 1.1 * measured["high"].get<double>()) << c.name;
        EXPECT_GT(measured["frequencies"], 0) << c.name;
    }
}

// A single picture needs no spectrum of the volume, and less memory; both ways show the same.
TEST_F(Cli, SumsASinglePictureAlongItsView) {
    const fs::path series = phantomFolder("--kind head --size 128x128x96");
    const auto render = [&](const std::string &name, const std::string &options) {
        const auto r = cli("render " + quoted(series) + " -o " + quoted(folder / name) +
                           " --azimuth 30 --elevation 20 --json " + options);
        EXPECT_EQ(r.exitCode, 0) << r.error;
        return json::parse(r.out);
    };
    const json sums = render("sums.npy", ""), spectrum = render("spectrum.npy", "--padding 1.5");
    EXPECT_EQ(sums["plan"]["model"]["combination"], "the samples are summed along the view");
    EXPECT_EQ(spectrum["plan"]["model"]["combination"], "one grey image");
    EXPECT_LT(sums["bytes"], spectrum["bytes"]);
    for (const auto &[key, value] : sums["plan"].items())
        EXPECT_TRUE(spectrum["plan"].contains(key)) << key;
    int height = 0, width = 0;
    EXPECT_LT(test::relativeL2(readNpy(folder / "sums.npy", height, width),
                               readNpy(folder / "spectrum.npy", height, width)),
              1.1e-3);
}

// Pixels that are fitted to the body may be too small for sums.
TEST_F(Cli, SumsNoPictureWhoseFittedPixelsAreSmall) {
    const fs::path series = phantomFolder("--kind head --size 96x96x96");
    const auto combination = [&](const std::string &size) {
        const auto r = cli("render " + quoted(series) + " -o " + quoted(folder / "fitted.png") +
                           " --azimuth 30 --elevation 20 --fit body --json --size " + size);
        EXPECT_EQ(r.exitCode, 0) << r.error;
        return json::parse(r.out)["plan"]["model"]["combination"];
    };
    EXPECT_EQ(combination("90"), "the samples are summed along the view");
    EXPECT_EQ(combination("1000"), "one grey image");
}

// A part of a picture that holds less than its share of the whole is planned again until it keeps
// the tolerance itself. The parts are strips of a few thick, tilted slices, from the middle to
// beyond the skin.
TEST_F(Cli, PlansAPartOfAPictureMoreClosely) {
    const fs::path series =
                       phantomFolder("--kind head --size 160x160x4 --spacing 1,1,4.85 --tilt 15"),
                   out = folder / "part.npy", file = folder / "part.json";
    const auto catalogue = dicom::scan({series});
    const auto volume = dicom::loadVolume(*dicom::defaultSelection(catalogue).volume).volume;
    const auto field = classify::densityField(volume, classify::defaultFieldWindow(volume));
    const reference::WideKernel exact(field.values, field.support);
    const auto render = [&](double pan, const std::string &options) {
        scene::Scene scene;
        scene.camera = {
            scene::viewOrientation(scene::StandardView::front), 1.0, 12, 40, {pan, 0.0}};
        std::ofstream(file) << scene::toJson(scene);
        const auto r = cli("render " + quoted(series) + " -o " + quoted(out) + " --json --scene " +
                           quoted(file) + options);
        EXPECT_EQ(r.exitCode, 0) << r.error;
        const json report = json::parse(r.out);
        // The plan's figures are for the whole.
        EXPECT_FALSE(report["predicted_error"]["whole"]) << pan;
        EXPECT_LE(report["measured_error"]["relative_l2"], scene.tolerance) << pan;
        return std::pair(scene, report);
    };
    for (const double pan : {56.0, 76.0, 80.0, 81.0, 82.0, 84.0}) {
        const auto [scene, report] = render(pan, "");
        int height = 0, width = 0;
        const auto image = readNpy(out, height, width);
        const double error = test::relativeL2(image, exact.image(scene.camera, scene.image));
        EXPECT_LE(error, 1.1 * report["measured_error"]["high"].get<double>()) << pan;
        EXPECT_LE(error, scene.tolerance) << pan;
    }
    // Several pictures are made from a spectrum, and the middle is not planned again.
    const auto planned = [&](double pan) {
        return render(pan, " --turntable --frames 2").second["plan"]["predicted_error"];
    };
    EXPECT_LT(planned(84.0).get<double>(), 0.7 * planned(56.0).get<double>());
}

// The plan of a workstation's scene stays, because one engine serves every view; a part that may
// miss the tolerance is rendered with one kernel.
TEST_F(Cli, RendersAPartOfAWorkstationsPictureWithOneKernel) {
    const fs::path series = phantomFolder("--kind head --size 160x160x40"),
                   file = folder / "part.json";
    const auto figures = [&](double pixelMm, double panMm) {
        scene::Scene scene;
        scene.camera = {
            scene::viewOrientation(scene::StandardView::front), pixelMm, 40, 40, {panMm, 0.0}};
        scene.plannedFor = scene::PlannedFor::volume;
        std::ofstream(file) << scene::toJson(scene);
        const auto r = cli("render " + quoted(series) + " -o " + quoted(folder / "part.npy") +
                           " --json --scene " + quoted(file));
        EXPECT_EQ(r.exitCode, 0) << r.error;
        return json::parse(r.out);
    };
    const json whole = figures(10.0, 0.0), beside = figures(0.5, 80.0);
    EXPECT_GT(whole["plan"]["kernel_widths"].size(), 1u);
    EXPECT_EQ(beside["plan"]["kernel_widths"].size(), 1u);
    EXPECT_EQ(beside["plan"]["padded"], whole["plan"]["padded"]);
    EXPECT_EQ(beside["plan"]["kernel"], whole["plan"]["kernel"]);
    EXPECT_EQ(beside["plan"]["predicted_error"], whole["plan"]["predicted_error"]);
    // In air there is nothing that an error could be relative to.
    const json air = figures(0.5, 150.0);
    EXPECT_GT(air["measured_error"]["high"], 1.0);
    EXPECT_NE(air["warnings"].dump().find("this part contains so little"), std::string::npos);
}

TEST_F(Cli, MeasuresTheErrorsThatAreAskedFor) {
    const fs::path series = phantomFolder("--kind head --size 24x24x12"), out = folder / "p.npy";
    const auto measured = [&](const std::string &more) {
        const auto r = cli("render " + quoted(series) + " -o " + quoted(out) + " --json " + more);
        EXPECT_EQ(r.exitCode, 0) << r.error;
        return json::parse(r.out)["measured_error"];
    };
    EXPECT_TRUE(measured("--check none").is_null());
    EXPECT_GT(measured("")["relative_l2"], 0.0);
    EXPECT_GT(measured("--check all")["relative_l2"], 0.0);
    EXPECT_GT(
        measured("--light 1,1,1 --depth-cue linear:0.7 --crop 0.1,0.9,0,1,0,1")["relative_l2"],
        0.0);
    const auto r = cli("render " + quoted(series) + " -o " + quoted(out) + " --check some");
    EXPECT_EQ(r.exitCode, 2);
    EXPECT_NE(r.error.find("--check"), std::string::npos) << r.error;
}

// Real series, cropped to at most 96 samples a side, through NRRD files.
TEST_F(Cli, RendersCropsOfRealSeriesExactly) {
    PELLUCID_NEEDS_TEST_DATA();
    for (const char *name : {"ct_chest_philips_64", "ct_head_tilt_ge_28"}) {
        const auto catalogue = dicom::scan({test::testData() / name});
        const auto volume = dicom::loadVolume(*dicom::defaultSelection(catalogue).volume).volume;
        const int slices = std::min(37, volume.lattice().size().k);
        const auto crop = volume.cropped({{208, 160, 0}, {304, 256, slices}});
        const fs::path nrrd = folder / "crop.nrrd", out = folder / "image.npy";
        volume::writeNrrd(nrrd, crop);
        for (const auto &[text, angles] : {std::pair{"--view front", scene::ViewAngles{}},
                                           {"--view front --azimuth 35 --elevation 20 --roll 5",
                                            scene::ViewAngles{35, 20, 5}}}) {
            const auto r = cli("render " + quoted(nrrd) + " --window -900,2000 -o " + quoted(out) +
                               " " + text);
            ASSERT_EQ(r.exitCode, 0) << r.error;
            const auto field = classify::densityField(crop, {-900, 2000});
            auto camera = scene::defaultCamera(crop.lattice());
            camera.orientation = scene::viewOrientation(scene::StandardView::front, angles);
            int height = 0, width = 0;
            const auto image = readNpy(out, height, width);
            EXPECT_LT(
                test::relativeL2(
                    image, reference::WideKernel(field.values, field.support).image(camera, {})),
                1.1e-3)
                << name << text;
        }
    }
}

#ifndef PELLUCID_SANITIZED // sanitizers reserve terabytes
TEST_F(Cli, TheChestTakesItsMemoryAndNoMore) {
    PELLUCID_NEEDS_TEST_DATA();
    const fs::path out = folder / "chest.png";
    // 1.5 GB is the promise; seconds are printed, not asserted, because machines are noisy.
    const auto r = run("/usr/bin/env bash -c 'ulimit -v 3000000; TIMEFORMAT=%R; time " + program() +
                       " render " + (test::testData() / "ct_chest_philips_64").string() + " -o " +
                       out.string() + "'");
    EXPECT_EQ(r.exitCode, 0) << r.error;
    RecordProperty("seconds", r.error);
    EXPECT_GT(fs::file_size(out), 50000U);
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    EXPECT_LT(usage.ru_maxrss, 1500L * 1024);
}
#endif

TEST_F(Cli, InfoTellsGeometryAndReasons) {
    const fs::path series = phantomFolder("--kind head --size 32x30x8 --spacing 7,7,28 --tilt 20");
    std::ofstream(series / "readme.txt") << "hello, this is not an image";
    const auto r = cli("info " + quoted(series) + " --json");
    ASSERT_EQ(r.exitCode, 0) << r.error;
    const json j = json::parse(r.out);
    const json &volume = j["patients"][0]["studies"][0]["series"][0]["volumes"][0];
    EXPECT_EQ(volume["size"], json({32, 30, 8}));
    EXPECT_NEAR(volume["tilt_deg"].get<double>(), 20.0, 1e-4);
    EXPECT_NEAR(volume["spacing_mm"][2].get<double>(), 28.0, 1e-6);
    EXPECT_EQ(j["skipped"].size(), 1U);
    const auto text = cli("info " + quoted(series));
    EXPECT_NE(text.out.find("tilted by 20.0 degrees"), std::string::npos);
    EXPECT_NE(text.out.find("files that are not images: 1"), std::string::npos);
}

TEST_F(Cli, DcmtkFindsThePhantomValid) {
    const fs::path series = phantomFolder("--kind metal --size 24x24x3 --transfer-syntax jpeg-ls");
    const auto dump = run("dcmdump -E " + quoted(series / "IM0002.dcm"));
    EXPECT_EQ(dump.exitCode, 0) << dump.error;
    EXPECT_EQ(dump.error, "");
    EXPECT_NE(dump.out.find("JPEGLSLossless"), std::string::npos);
    EXPECT_NE(dump.out.find("CTImageStorage"), std::string::npos);
}

TEST_F(Cli, SecondaryCapturesBelongToTheStudy) {
    const fs::path series = phantomFolder("--kind head --size 40x40x30"), out = folder / "shot.dcm";
    ASSERT_EQ(cli("render " + quoted(series) + " -o " + quoted(out) + " --view left").exitCode, 0);
    const auto dump = run("dcmdump " + quoted(out));
    EXPECT_EQ(dump.error, "");
    const auto value = [](const std::string &text, const std::string &tag) {
        const auto at = text.find(tag), from = text.find('[', at);
        return text.substr(from + 1, text.find(']', from) - from - 1);
    };
    const auto slice = run("dcmdump " + quoted(series / "IM0001.dcm"));
    EXPECT_EQ(value(dump.out, "(0020,000d)"), value(slice.out, "(0020,000d)")); // the study
    EXPECT_NE(value(dump.out, "(0020,000e)"),
              value(slice.out, "(0020,000e)"));        // a series of its own
    EXPECT_EQ(value(dump.out, "(0020,0020)"), "P\\F"); // from the left: posterior at the right
    EXPECT_NEAR(std::stod(value(dump.out, "(0018,1510)")), 90.0, 1e-3);
    EXPECT_NEAR(std::stod(value(dump.out, "(0018,1511)")), 0.0, 1e-3);
    // As typed for a C-arm.
    ASSERT_EQ(
        cli("render " + quoted(series) + " -o " + quoted(out) + " --carm LAO30,CRA20").exitCode, 0);
    const auto angled = run("dcmdump " + quoted(out));
    EXPECT_NEAR(std::stod(value(angled.out, "(0018,1510)")), 30.0, 1e-3);
    EXPECT_NEAR(std::stod(value(angled.out, "(0018,1511)")), 20.0, 1e-3);
    EXPECT_EQ(cli("render " + quoted(series) + " -o " + quoted(out) + " --carm LAO300").exitCode,
              2);
    // Frames of a turn are one series.
    ASSERT_EQ(
        cli("render " + quoted(series) + " -o " + quoted(out) + " --frames 2 --turntable").exitCode,
        0);
    const auto first = run("dcmdump " + quoted(folder / "shot_0000.dcm")),
               second = run("dcmdump " + quoted(folder / "shot_0001.dcm"));
    EXPECT_EQ(value(first.out, "(0020,000e)"), value(second.out, "(0020,000e)"));
    EXPECT_NE(value(first.out, "(0008,0018)"), value(second.out, "(0008,0018)"));
    EXPECT_EQ(value(second.out, "(0020,0013)"), "2");
}

// Balls at known places in the patient, seen at the angles of a C-arm, against the definition of
// DICOM's positioner angles (PS3.3, C.8.7.5): computed here from the direction of the detector, and
// not from the program's own matrices.
TEST_F(Cli, CArmAnglesShowBallsWhereTheDefinitionPutsThem) {
    const glm::dvec3 balls[] = {{70, 10, 20}, {-30, 60, -50}, {10, -75, 40}};
    constexpr double radiusMm = 7.0, stepMm = 1.5;
    const auto lattice = volume::Lattice::centred({128, 128, 128}, glm::dvec3(stepMm));
    std::vector<std::int16_t> hu;
    for (int k = 0; k < 128; ++k)
        for (int j = 0; j < 128; ++j)
            for (int i = 0; i < 128; ++i) {
                const glm::dvec3 at = lattice.patient(volume::VoxelIndex{i, j, k}).mm;
                double inside = 0.0; // soft over a sample, so that its middle is where it is
                for (const glm::dvec3 &ball : balls)
                    inside = std::max(
                        inside,
                        std::clamp((radiusMm - glm::distance(at, ball)) / stepMm + 0.5, 0.0, 1.0));
                hu.push_back(std::int16_t(std::lround(-1000.0 + 2000.0 * inside)));
            }
    const fs::path series = folder / "balls", out = folder / "balls.npy";
    dicom::writeCtSeries(series, {lattice, hu, volume::ValueUnit::hounsfield}, {},
                         dicom::TransferSyntax::explicitLittle);
    const struct {
        const char *text;
        double lao, cra;
    } views[] = {{"AP", 0, 0},
                 {"LAO90", 90, 0},
                 {"RAO30", -30, 0},
                 {"LAO30,CRA20", 30, 20},
                 {"RAO45,CAU35", -45, -35},
                 {"LAO110,CRA10", 110, 10}};
    constexpr int side = 220;
    constexpr double pixelMm = 1.0, radian = 3.14159265358979323846 / 180.0;
    for (const auto &view : views) {
        ASSERT_EQ(cli("render " + quoted(series) + " -o " + quoted(out) + " --carm " + view.text +
                      " --size 220x220 --pixel-mm 1")
                      .exitCode,
                  0);
        int height = 0, width = 0;
        const auto image = readNpy(out, height, width);
        ASSERT_EQ(width, side);
        ASSERT_EQ(height, side);
        const double a = view.lao * radian, b = view.cra * radian;
        const glm::dvec3 detector(std::sin(a) * std::cos(b), -std::cos(a) * std::cos(b),
                                  std::sin(b));
        const glm::dvec3 right(std::cos(a), std::sin(a), 0.0), up = glm::cross(detector, right);
        for (const glm::dvec3 &ball : balls) {
            const double u = glm::dot(ball, right), v = glm::dot(ball, up);
            const double column = u / pixelMm + 0.5 * (side - 1),
                         row = -v / pixelMm + 0.5 * (side - 1);
            double sum = 0.0, columns = 0.0, rows = 0.0;
            for (int y = int(row) - 11; y <= int(row) + 12; ++y)
                for (int x = int(column) - 11; x <= int(column) + 12; ++x) {
                    const double value = image[std::size_t(y) * side + std::size_t(x)];
                    sum += value;
                    columns += value * x;
                    rows += value * y;
                }
            // A tenth of a degree moves a ball at 75 mm by 0.13 mm.
            EXPECT_NEAR(columns / sum, column, 0.1) << view.text;
            EXPECT_NEAR(rows / sum, row, 0.1) << view.text;
        }
    }
}

TEST_F(Cli, ReadsTheNamedSeries) {
    const fs::path series = phantomFolder("--kind cube --size 16x16x16");
    const auto render = [&](const std::string &named) {
        return cli("render " + quoted(series) + " -o " + quoted(folder / "image.png") +
                   " --json --series " + named);
    };
    const auto found = render("1");
    ASSERT_EQ(found.exitCode, 0) << found.error;
    const std::string uid = json::parse(found.out)["volume"]["series"];
    EXPECT_EQ(render(uid).exitCode, 0);
    EXPECT_EQ(render("77").exitCode, 3);
    const auto empty = render("''");
    EXPECT_EQ(empty.exitCode, 2);
    EXPECT_NE(empty.error.find("--series: must not be empty"), std::string::npos) << empty.error;
}

TEST_F(Cli, ReadsTheNumberedVolume) {
    const fs::path series = folder / "gaps";
    test::writeSeries(series, {.slices = 30, .missing = {11, 12}});
    const std::string path = quoted(series), out = " -o " + quoted(folder / "v.nrrd");
    const auto info = cli("info " + path);
    EXPECT_NE(info.out.find("3. "), std::string::npos) << info.out;
    const auto listed = json::parse(cli("info " + path + " --json").out);
    const auto &volumes = listed["patients"][0]["studies"][0]["series"][0]["volumes"];
    ASSERT_EQ(volumes.size(), 3U);
    std::set<int> slices;
    for (const auto &volume : volumes) {
        const std::string number = std::to_string(volume["number"].get<int>());
        const auto written = cli("volume " + path + " --volume " + number + out);
        ASSERT_EQ(written.exitCode, 0) << written.error;
        EXPECT_EQ(written.error.find("--volume selects"), std::string::npos) << written.error;
        const int read = decoding::readVolumeFile(folder / "v.nrrd").lattice().size().k;
        EXPECT_EQ(read, volume["size"][2].get<int>());
        slices.insert(read);
    }
    EXPECT_EQ(slices, (std::set<int>{11, 17, 30}));
    EXPECT_NE(cli("volume " + path + out).error.find("--volume selects another"),
              std::string::npos);
    const auto beyond = cli("volume " + path + " --volume 4" + out);
    EXPECT_EQ(beyond.exitCode, 3);
    EXPECT_NE(beyond.error.find("has no volume 4"), std::string::npos) << beyond.error;
    EXPECT_EQ(cli("volume " + path + " --volume 0" + out).exitCode, 2);
    EXPECT_EQ(cli("volume " + path + " --volume 1 --fill-gaps" + out).exitCode, 2);
}

TEST_F(Cli, VolumeWritesValuesAndField) {
    const fs::path series = phantomFolder("--kind head --size 32x30x8 --tilt 15");
    ASSERT_EQ(cli("volume " + quoted(series) + " -o " + quoted(folder / "v.nrrd")).exitCode, 0);
    ASSERT_EQ(cli("volume " + quoted(series) + " -o " + quoted(folder / "f.nrrd") +
                  " --field --window 0,1000 --gzip")
                  .exitCode,
              0);
    const auto values = decoding::readVolumeFile(folder / "v.nrrd"),
               field = decoding::readVolumeFile(folder / "f.nrrd");
    EXPECT_FALSE(values.isFloat());
    EXPECT_TRUE(field.isFloat());
    EXPECT_EQ(values.lattice().size(), field.lattice().size());
    EXPECT_NEAR(values.lattice().shearRad(), 15.0 * 3.14159265358979 / 180.0, 1e-6);
    for (int i = 0; i < 32; ++i)
        EXPECT_NEAR(field.value({i, 15, 4}),
                    std::clamp(values.value({i, 15, 4}) / 1000.0, 0.0, 1.0), 1e-6);
}

// A look against the exact projection of its own fields, in grey and in color.
TEST_F(Cli, ScenesTurntablesAndFormats) {
    const fs::path series = phantomFolder("--kind ellipsoids --size 32x32x32");
    ASSERT_EQ(cli("render " + quoted(series) + " -o " + quoted(folder / "turn.png") +
                  " --frames 3 --turntable --size 40x30")
                  .exitCode,
              0);
    EXPECT_TRUE(fs::exists(folder / "turn_0000.png") && fs::exists(folder / "turn_0002.png"));
    ASSERT_EQ(cli("render " + quoted(series) + " -o " + quoted(folder / "i.nrrd") + " --size 40x30")
                  .exitCode,
              0);
    EXPECT_EQ(decoding::readVolumeFile(folder / "i.nrrd").lattice().size(),
              (volume::GridSize{40, 30, 1}));
    scene::Scene scene;
    scene.camera = {scene::viewOrientation(scene::StandardView::left), 2.0, 30, 20, {1.0, 2.0}};
    scene.image.reconstruction = scene::Reconstruction::linear;
    std::ofstream(folder / "scene.json") << scene::toJson(scene);
    ASSERT_EQ(cli("render " + quoted(series) + " -o " + quoted(folder / "s.npy") + " --scene " +
                  quoted(folder / "scene.json"))
                  .exitCode,
              0);
    int height = 0, width = 0;
    readNpy(folder / "s.npy", height, width);
    EXPECT_EQ(width, 30);
    EXPECT_EQ(height, 20);
    // The exact reference meets a tolerance that the engine cannot, and the output says so.
    const auto fine = cli("render " + quoted(series) + " -o " + quoted(folder / "r.npy") +
                          " --quality reference --json");
    EXPECT_EQ(fine.exitCode, 0);
    EXPECT_NE(fine.out.find("exact reference"), std::string::npos);
}

TEST_F(Cli, TheSameBitsForAnyNumberOfThreads) {
    const fs::path series = phantomFolder("--kind head --size 300x280x40");
    const auto image = [&](int threads) {
        const fs::path out = folder / "t.npy";
        EXPECT_EQ(cli("render " + quoted(series) + " -o " + quoted(out) +
                      " --azimuth 33 --size 600x500 --threads " + std::to_string(threads))
                      .exitCode,
                  0);
        int height = 0, width = 0;
        return readNpy(out, height, width);
    };
    const auto one = image(1);
    EXPECT_EQ(one, image(2));
    EXPECT_EQ(one, image(4));
}

TEST_F(Cli, BothEnginesGiveOnePicture) {
    const fs::path series = phantomFolder("--kind head --size 48x52x40 --tilt 12");
    for (const char *options : {"", "--depth-cue linear:1 --light 1,0,0.5 --ambient 0.4",
                                "--quality draft --azimuth 40 --uniform"}) {
        const std::string asked = std::string(" --view left ") + options;
        const auto processor = picture(series, "--engine cpu" + asked);
        const auto card = picture(series, "--engine gpu" + asked);
        EXPECT_LE(test::relativeL2(card, processor), 3e-4) << options;
    }
    const std::string out = " -o " + quoted(folder / "one.png");
    const auto rendered = cli("render " + quoted(series) + out + " --engine gpu --json");
    EXPECT_EQ(rendered.exitCode, 0) << rendered.error;
    const json report = json::parse(rendered.out);
    EXPECT_EQ(report["device"], "gpu");
    EXPECT_EQ(report["engine"].get<std::string>().rfind("GPU engine, ", 0), 0U);
    EXPECT_EQ(report["engine_reason"], "the graphics card was requested");
    const fs::path turn = folder / "turn";
    fs::create_directory(turn);
    EXPECT_EQ(cli("render " + quoted(series) + " -o " + quoted(turn / "t.png") +
                  " --engine gpu --frames 3 --turntable")
                  .exitCode,
              0);
    EXPECT_EQ(entries(turn), 3U);
    // By default the CPU renders one picture, and many where OpenGL runs on a software renderer.
    const auto many = cli("render " + quoted(series) + out + " --frames 2 --turntable --json");
    EXPECT_EQ(json::parse(many.out)["device"], "cpu");
    EXPECT_FALSE(json::parse(many.out)["engine_reason"].get<std::string>().empty());
}

TEST_F(Cli, WithoutACardTheProcessorRendersOrAReasonIsGiven) {
    const fs::path series = phantomFolder("--kind cube --size 16x16x16");
    const fs::path out = folder / "one.png";
    const std::string command = "render " + quoted(series) + " -o " + quoted(out);
    const std::string old =
        "MESA_GL_VERSION_OVERRIDE=3.3 MESA_EXTENSION_OVERRIDE=-GL_ARB_compute_shader";
    expectOneLine(cli(command + " --engine gpu", old), 5, "OpenGL 3.3");
    EXPECT_FALSE(fs::exists(out));
    EXPECT_EQ(cli(command, old).exitCode, 0);
    // The exact reference does not run on the GPU.
    expectOneLine(cli(command + " --engine gpu --quality reference"), 5, "reference");
    EXPECT_EQ(cli(command + " --frames 2 --turntable", old).exitCode, 0);
}

} // namespace
} // namespace pellucid
