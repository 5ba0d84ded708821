// SPDX-License-Identifier: GPL-3.0-or-later
// Command-line options for what a picture shows of a volume, and how.
#include "tests/cli/cli.h"

#include <array>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "core/classify/crop_box.h"
#include "core/decoding/client/read_volume_file.h"
#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/reference/shaded_field.h"
#include "core/reference/wide_kernel.h"
#include "core/scene/scene.h"
#include "tests/support/fields.h"
#include "tests/support/json_text.h"

namespace pellucid {

namespace {

using namespace test;
using nlohmann::json;

TEST_F(Cli, ClassesAndTransferFunctionsAgainstTheExactReference) {
    const fs::path series = phantomFolder("--kind chest --size 56x48x40"),
                   out = folder / "image.npy";
    const auto catalogue = dicom::scan({series});
    const auto volume = dicom::loadVolume(*dicom::defaultSelection(catalogue).volume).volume;
    const auto window = classify::defaultFieldWindow(volume);
    auto camera = scene::defaultCamera(volume.lattice());
    camera.orientation = scene::viewOrientation(scene::StandardView::front, {30, 0, 0});
    const auto standard = [](const std::string &name, double weight, const char *color) {
        for (classify::TissueClass tissue : classify::standardClasses())
            if (tissue.name == name) {
                tissue.weight = weight;
                tissue.color = classify::colorFromText(color);
                return tissue;
            }
        throw std::runtime_error(name);
    };
    const struct {
        std::string options;
        classify::Look look;
        classify::CropBox crop;
    } cases[] = {{"--bezier 0,0.5,2,2", {{{0.0, 0.5, 2.0, 2.0}}, {}}},
                 {"--bezier 0,2,0,2,0,2,0,2,0,2,0,2,0,2,0,2",
                  {{{0, 2, 0, 2, 0, 2, 0, 2, 0, 2, 0, 2, 0, 2, 0, 2}}, {}}},
                 {"--class bone=1.5", {{}, {standard("bone", 1.5, "#ffffff")}}},
                 {"--class bone=1:#ff8000 --class lung=2:#0040ff --class fat=0",
                  {{}, {standard("bone", 1.0, "#ff8000"), standard("lung", 2.0, "#0040ff")}}},
                 {"--crop 0.25,1,0,0.6,0.1,0.9", {}, {{0.25, 0.0, 0.1}, {1.0, 0.6, 0.9}}}};
    for (const auto &c : cases) {
        const auto r = cli("render " + quoted(series) + " -o " + quoted(out) +
                           " --azimuth 30 --json " + c.options);
        ASSERT_EQ(r.exitCode, 0) << r.error;
        const auto fields =
            classify::cropped(classify::shownFields(volume, window, c.look, nullptr), c.crop);
        const int channels = fields.isGrey() ? 1 : 3;
        int height = 0, width = 0;
        const auto image = readNpy(out, height, width, channels);
        std::vector<double> truth(image.size());
        for (std::size_t n = 0; n < fields.channels.size(); ++n) {
            const auto &field = fields.channels[n];
            const auto plane = reference::WideKernel(field.values, field.support).image(camera, {});
            const classify::Color &color = fields.colors[n];
            const std::array<double, 3> parts{color.red, color.green, color.blue};
            for (std::size_t p = 0; p < plane.size(); ++p)
                for (std::size_t channel = 0; channel < std::size_t(channels); ++channel)
                    truth[p * std::size_t(channels) + channel] += parts[channel] * plane[p];
        }
        const double error = test::relativeL2(image, truth);
        EXPECT_LE(error, 1.1e-3) << c.options;
        EXPECT_LE(error, json::parse(r.out)["predicted_error"]["relative_l2"].get<double>());
    }
    const fs::path nrrd = folder / "class.nrrd";
    const auto refused =
        cli("render " + quoted(series) + " -o " + quoted(nrrd) + " --class bone=1:#ff0000");
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_NE(refused.error.find("colored"), std::string::npos);
    EXPECT_FALSE(fs::exists(nrrd));
    EXPECT_EQ(cli("volume " + quoted(series) + " -o " + quoted(nrrd) + " --class bone").exitCode,
              0);
    const auto written = decoding::readVolumeFile(nrrd);
    const auto expected =
        classify::classField(volume, window, standard("bone", 1.0, "#ffffff"), nullptr).values;
    for (const volume::VoxelIndex at : {volume::VoxelIndex{28, 40, 20}, {3, 3, 3}, {28, 36, 10}})
        EXPECT_EQ(written.value(at), expected.value(at));
}

TEST_F(Cli, PresetsAreListedShownCheckedAndMoved) {
    // The test has a library of its own.
    setenv("XDG_DATA_HOME", (folder / "data").c_str(), 1);
    const auto list = cli("preset list");
    EXPECT_EQ(list.exitCode, 0);
    EXPECT_NE(list.out.find("Bone over soft tissue"), std::string::npos);
    EXPECT_GE(std::count(list.out.begin(), list.out.end(), '\n'), 15);
    const fs::path file = folder / "bone.json";
    ASSERT_EQ(cli("preset export Bone -o " + quoted(file)).exitCode, 0);
    EXPECT_EQ(cli("preset validate " + quoted(file)).exitCode, 0);
    EXPECT_NE(cli("preset show bone").out.find("pellucid-preset/2"), std::string::npos);
    // A built-in preset is never replaced. Under another name it can be imported, once.
    EXPECT_EQ(cli("preset import " + quoted(file)).exitCode, 2);
    EXPECT_EQ(cli("preset import " + quoted(file) + " --name Mine").exitCode, 0);
    EXPECT_EQ(cli("preset import " + quoted(file) + " --name Mine").exitCode, 2);
    EXPECT_EQ(cli("preset import " + quoted(file) + " --name Mine --replace").exitCode, 0);
    EXPECT_NE(cli("preset list").out.find("Mine"), std::string::npos);

    std::ofstream(folder / "bad.json") << "{\n  \"schema\": \"pellucid-preset/2\",\n"
                                          "  \"name\": \"x\",\n  \"window\": [3]\n}\n";
    const auto bad = cli("preset validate " + quoted(folder / "bad.json"));
    EXPECT_EQ(bad.exitCode, 3);
    EXPECT_NE(bad.error.find("bad.json: line 4: /window: must be two numbers"), std::string::npos)
        << bad.error;
    // A damaged preset in the library is skipped with a reason; the others stay usable.
    fs::copy_file(folder / "bad.json", folder / "data/pellucid/presets/bad.json");
    const auto warned = cli("preset list");
    EXPECT_EQ(warned.exitCode, 0);
    EXPECT_NE(warned.error.find("bad.json: line 4"), std::string::npos) << warned.error;
    EXPECT_NE(warned.out.find("Mine"), std::string::npos);
    unsetenv("XDG_DATA_HOME");
}

TEST_F(Cli, APresetMakesThePictureThatItsClassesMake) {
    const fs::path series = phantomFolder("--kind head --size 56x56x40");
    std::ofstream(folder / "p.json")
        << R"({"schema": "pellucid-preset/2", "name": "p", "window": [-900, 2000], "classes": [)"
        << R"({"name": "Bone", "range": [250, 2500], "softness": 150, "weight": 0.7}]})";
    EXPECT_EQ(picture(series, "--preset " + quoted(folder / "p.json")),
              picture(series, "--class bone=0.7"));
    const auto unknown = cli("render " + quoted(series) + " -o x.png --preset Bonee");
    EXPECT_EQ(unknown.exitCode, 2);
    EXPECT_EQ(cli("render " + quoted(series) + " -o x.png --preset /nowhere/x.json").exitCode, 3);
    // Canny finds edges in a small share of the samples.
    const fs::path nrrd = folder / "edges.nrrd";
    ASSERT_EQ(cli("volume " + quoted(series) + " -o " + quoted(nrrd) + " --edges").exitCode, 0);
    const auto edges = decoding::readVolumeFile(nrrd);
    std::size_t some = 0, count = 0;
    edges.visit([&](auto samples) {
        for (const auto e : samples) {
            EXPECT_TRUE(e >= 0 && e <= 1);
            some += e > 0;
            ++count;
        }
    });
    EXPECT_GT(some, count / 200);
    EXPECT_LT(some, count / 4);
}

// Cue and light are compared with the exact image of the field shaded in space, both for the engine
// and at the reference quality.
TEST_F(Cli, CueAndLightAgainstTheExactReference) {
    const fs::path series = phantomFolder("--kind head --size 48x50x36 --tilt 12");
    const auto catalogue = dicom::scan({series});
    const auto loaded = dicom::loadVolume(*dicom::defaultSelection(catalogue).volume);
    const classify::FieldWindow window{-900.0, 2000.0};
    const auto field = classify::densityField(loaded.volume, window);
    const volume::Lattice &lattice = loaded.volume.lattice();
    shading::Light red, blue;
    red.direction = {1, 0.5, 0.3};
    red.color = {1.0, 64.0 / 255.0, 0.0};
    red.strength = 0.7;
    blue.direction = {-1, 0, 0};
    blue.color = {0.0, 0.0, 1.0};
    const struct {
        const char *options;
        shading::Shading shading;
        int channels;
    } cases[] = {
        {"--depth-cue linear:0.8", {.cue = {shading::CueKind::linear, 0.8}}, 1},
        {"--depth-cue sine:1 --ambient 0.5 --light 0,0,2",
         {.cue = {shading::CueKind::sine, 1.0}, .ambient = 0.5, .lights = {{}}},
         1},
        {"--depth-cue curve:0,2,0.5", {.cue = {shading::CueKind::curve, 1.0, {0, 2, 0.5}}}, 1},
        {"--ambient 0.2 --light 1,0.5,0.3:#ff4000:0.7 --light -1,0,0:#0000ff",
         {.ambient = 0.2, .lights = {red, blue}},
         3},
        {"--ambient 1.5", {.ambient = 1.5}, 1}};
    for (const auto &[options, shading, channels] : cases) {
        scene::Camera camera = scene::defaultCamera(lattice);
        camera.orientation = scene::viewOrientation(scene::StandardView::front, {25, 15, 0});
        std::vector<double> expected(std::size_t(camera.width) * camera.height * channels);
        for (int c = 0; c < channels; ++c) {
            const auto shaded = reference::shadedField(field, shading, camera.axes(), c,
                                                       shading::shadingScale(lattice));
            const auto plane =
                reference::WideKernel(shaded.values, shaded.support).image(camera, {});
            for (std::size_t n = 0; n < plane.size(); ++n)
                expected[n * channels + c] = plane[n];
        }
        for (const auto &[quality, tolerance] :
             {std::pair{"standard", 1.1e-3}, std::pair{"reference", 1e-6}}) {
            const fs::path out = folder / "p.npy";
            const auto r = cli("render " + quoted(series) + " -o " + quoted(out) +
                               " --azimuth 25 --elevation 15 --quality " + quality + " " + options);
            ASSERT_EQ(r.exitCode, 0) << r.error;
            int height = 0, width = 0;
            const auto samples = readNpy(out, height, width, channels);
            ASSERT_EQ(samples.size(), expected.size());
            EXPECT_LE(relativeL2(samples, expected), tolerance) << options << " " << quality;
        }
    }
}

TEST_F(Cli, LightsFollowTheViewerOrThePatientThroughATurntable) {
    const fs::path series = phantomFolder("--kind head --size 40x40x40");
    const auto frame = [&](const std::string &options, const char *name) {
        const auto r = cli("render " + quoted(series) + " -o " + quoted(folder / "t.npy") +
                           " --ambient 0.1 --light 1,0,0.2 --frames 2 --turntable " + options);
        EXPECT_EQ(r.exitCode, 0) << r.error;
        int height = 0, width = 0;
        return readNpy(folder / name, height, width);
    };
    // The first frame is the same; in the second, half a turn later, the patient's lit side is at
    // the left.
    EXPECT_EQ(frame("", "t_0000.npy"), frame("--light-frame patient", "t_0000.npy"));
    const auto viewer = frame("", "t_0001.npy"),
               patient = frame("--light-frame patient", "t_0001.npy");
    EXPECT_GT(relativeL2(patient, viewer), 0.05);
    const auto mirrored = cli("render " + quoted(series) + " -o " + quoted(folder / "m.npy") +
                              " --ambient 0.1 --light -1,0,-0.2 --view back");
    EXPECT_EQ(mirrored.exitCode, 0);
    int height = 0, width = 0;
    EXPECT_LT(relativeL2(patient, readNpy(folder / "m.npy", height, width)), 1e-6);
}

TEST_F(Cli, SceneAndPresetCarryCueAndLights) {
    const fs::path series = phantomFolder("--kind sphere --size 32x32x32");
    const std::string shading = R"("cue": {"kind": "linear", "strength": 0.5}, "ambient": 0.25,
        "lights": [{"direction": [-1, 1, 0.5], "strength": 0.9}])";
    const std::string options =
        "--depth-cue linear:0.5 --ambient 0.25 --light -1,1,0.5:#ffffff:0.9";
    std::ofstream(folder / "p.json") << R"({"schema": "pellucid-preset/2", "name": "p",
        "window": [-900, 2000], )" << shading
                                     << "}";
    const auto expected = picture(series, options);
    EXPECT_EQ(picture(series, "--preset " + quoted(folder / "p.json")), expected);
    // An option overrides the preset.
    EXPECT_EQ(
        picture(series, "--preset " + quoted(folder / "p.json") + " --depth-cue none --ambient 1"),
        picture(series, "--light -1,1,0.5:#ffffff:0.9"));
    scene::Scene scene;
    const auto catalogue = dicom::scan({series});
    scene.camera = scene::defaultCamera(
        dicom::loadVolume(*dicom::defaultSelection(catalogue).volume).volume.lattice());
    scene.shading = test::readJson<shading::Shading>("{" + shading + "}");
    std::ofstream(folder / "s.json") << scene::toJson(scene);
    EXPECT_EQ(picture(series, "--scene " + quoted(folder / "s.json")), expected);
}

TEST_F(Cli, BadCuesAndLightsAreOneLine) {
    const fs::path series = phantomFolder("--kind sphere --size 16x16x16");
    const auto refuse = [&](const std::string &options, int code, const std::string &part) {
        const auto r =
            cli("render " + quoted(series) + " -o " + quoted(folder / "x.png") + " " + options);
        expectOneLine(r, code, part);
        EXPECT_FALSE(fs::exists(folder / "x.png"));
    };
    refuse("--depth-cue linear", 2, "--depth-cue: unknown depth cue 'linear': use none");
    refuse("--depth-cue linear:2", 2, "between 0 and 1");
    refuse("--depth-cue sine:x", 2, "'x' is not a number");
    refuse("--depth-cue curve:1", 2, "2 to 8 values");
    refuse("--depth-cue curve:1,3", 2, "between 0 and 2");
    refuse("--light 1,0", 2, "is not of the form u,v,w");
    refuse("--light 0,0,0", 2, "must be finite and not zero");
    refuse("--light 1,0,0:red", 2, "--light:");
    refuse("--light 1,0,0:#ff0000:7", 2, "between 0 and 1");
    refuse("--light nan,0,0", 2, "is not a number");
    refuse("--ambient 3", 2, "--ambient");
    refuse("--light-frame patient", 2, "--light-frame requires --light");
    std::ofstream(folder / "p.json") << "{\"schema\": \"pellucid-preset/2\", \"name\": \"p\",\n"
                                        "\"lights\": [{\"direction\": [1, 0, 0]},\n"
                                        "{\"direction\": [0, 0, 0]}]}";
    refuse("--preset " + quoted(folder / "p.json"), 3,
           "p.json: line 3: /lights/1: the direction of a light must be finite and not zero");
    // A color picture needs a file format that holds colors.
    const auto grey = cli("render " + quoted(series) + " -o " + quoted(folder / "x.nrrd") +
                          " --light 1,0,0:#ff0000");
    expectOneLine(grey, 2, "colored pictures are written as .png, .npy or .dcm");
}

} // namespace
} // namespace pellucid
