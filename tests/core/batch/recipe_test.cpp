// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/batch/recipe.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include <nlohmann/json.hpp>

#include "core/classify/couch.h"
#include "core/presets/preset_library.h"
#include "core/task/error.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::batch {

namespace {

Recipe read(const std::string &text) {
    return recipeFromJson(text, {});
}

// Why a recipe is refused.
std::string faultOf(const std::string &text) {
    try {
        read(text);
    } catch (const task::Error &error) {
        EXPECT_EQ(error.code(), task::ErrorCode::unusable);
        return error.reason().english();
    }
    return "it is read";
}

volume::Volume volumeOf(volume::GridSize size, glm::dvec3 spacingMm) {
    return {volume::Lattice::centred(size, spacingMm),
            std::vector<std::int16_t>(size.count(), std::int16_t(40)),
            volume::ValueUnit::hounsfield};
}

dicom::VolumeEntry stack(int slices, double distanceMm) {
    dicom::VolumeEntry entry;
    entry.geometry.lattice = volume::Lattice::centred({8, 8, slices}, {1.0, 1.0, distanceMm});
    return entry;
}

} // namespace

TEST(Recipe, TheSmallestMakesTheValuesOfTheFront) {
    const Recipe recipe = read(R"({"recipe": 1, "outputs": [{"view": "front", "format": "npy"}]})");
    ASSERT_EQ(recipe.outputs.size(), 1U);
    const Output &output = recipe.outputs.front();
    EXPECT_EQ(output.format, Format::npy);
    EXPECT_EQ(filesOf(output), std::vector<std::string>{"front.npy"});
    const volume::Volume volume = volumeOf({20, 30, 40}, {1.0, 1.0, 2.0});
    const scene::Scene scene = sceneOf(output, volume);
    EXPECT_EQ(scene.camera, scene::defaultCamera(volume.lattice()));
    EXPECT_EQ(scene.tolerance, scene::Scene().tolerance);
}

TEST(Recipe, FaultsAreNamedWithTheirLines) {
    const std::pair<const char *, const char *> faults[] = {
        {"{\"recipe\": 1,\n \"outputs\": [\n }", "line 3"},
        {"{\"recipe\": 2, \"outputs\": [{}]}", "line 1: /recipe: is not 1"},
        {"{\"outputs\": [{}]}", "has no recipe"},
        {"{\"recipe\": 1, \"outputs\": []}", "/outputs: must not be empty"},
        {"{\"recipe\": 1,\n\"outputs\": [{},\n{\"veiw\": \"front\"}]}", "line 3: /outputs/1/veiw"},
        {"{\"recipe\": 1, \"outputs\": [{\"view\": \"fornt\"}]}", "/outputs/0/view"},
        {"{\"recipe\": 1, \"outputs\": [{\"format\": \"gif\"}]}", "use one of png, png16, npy"},
        {"{\"recipe\": 1, \"outputs\": [{\"format\": \"mp4\"}]}", "needs a turntable"},
        {"{\"recipe\": 1, \"outputs\": [{\"size\": [0, 5]}]}", "whole number from 1 to 16384"},
        {"{\"recipe\": 1, \"outputs\": [{\"size\": 1.5}]}", "whole number"},
        {"{\"recipe\": 1, \"outputs\": [{\"pixel_mm\": 0}]}", "must be positive"},
        {"{\"recipe\": 1, \"outputs\": [{\"tolerance\": \"best\"}]}", "use one of draft"},
        {"{\"recipe\": 1, \"outputs\": [{\"turntable\": 1}]}", "from 2 to 3600"},
        {"{\"recipe\": 1, \"outputs\": [{\"name\": \"../x\"}]}", "/outputs/0/name"},
        {"{\"recipe\": 1, \"outputs\": [{\"name\": \"Done\"}]}", "is reserved"},
        {"{\"recipe\": 1, \"outputs\": [{}, {}]}",
         "/outputs/1: needs a name: its default, 'picture'"},
        {"{\"recipe\": 1, \"outputs\": [{\"view\": \"AP\"}, {\"name\": \"ap\"}]}",
         "/outputs/1/name: another output has the name 'ap'"},
        {"{\"recipe\": 1, \"outputs\": [{}],\n\"outputs\": [{}]}",
         "line 2: the member 'outputs' is given twice"},
        {"{\"recipe\": 1, \"outputs\": [{\"deidentify\": true}]}", "/outputs/0/deidentify: is for"},
        {"{\"recipe\": 1, \"outputs\": [{\"fit\": \"body\", \"size\": 9, \"pixel_mm\": 1}]}",
         "/outputs/0/fit: cannot be met"},
        {"{\"recipe\": 1, \"outputs\": [{\"fit\": \"body\", \"size\": 9, \"views\": "
         "[{\"matrix\": [[1,0,0,0],[0,1,0,0],[0,0,0,1]]}]}]}",
         "/outputs/0/fit: cannot be met: the matrices"},
        {"{\"recipe\": 1, \"outputs\": [{\"look\": \"nothing like this\"}]}", "/outputs/0/look"},
        {"{\"recipe\": 1, \"outputs\": [{\"turntable\": 3, \"name\": \"a\"},\n"
         "{\"name\": \"a_0002\"}]}",
         "line 2: /outputs/1/name: another output has the name 'a_0002'"},
        {"{\"recipe\": 1, \"outputs\": [{\"look\": \"Bone over soft tissue\", \"format\": "
         "\"png16\"}]}",
         "/outputs/0/format"},
        {"{\"recipe\": 1, \"outputs\": [{\"size\": 9, \"pixel_mm\": 3, \"views\": "
         "[{\"matrix\": [[1,0,0,0],[0,1,0,0],[0,0,0,1]]}]}]}",
         "/outputs/0/pixel_mm"},
        {"{\"recipe\": 1, \"outputs\": [{\"scene\": \"missing.json\"}]}",
         "/outputs/0/scene: missing.json: "},
        {"{\"recipe\": 1, \"outputs\": [{\"view\": \"left\", \"views\": [\"AP\"]}]}",
         "more than one"},
        {"{\"recipe\": 1, \"outputs\": [{\"views\": []}]}", "/outputs/0/views"},
        {"{\"recipe\": 1, \"series\": {\"slice_mm\": [3, 1]}, \"outputs\": [{}]}",
         "/series/slice_mm"},
        {"{\"recipe\": 1, \"series\": {\"modality\": 5}, \"outputs\": [{}]}", "must be text"}};
    for (const auto &[text, part] : faults)
        EXPECT_NE(faultOf(text).find(part), std::string::npos) << text << "\n" << faultOf(text);
}

// What is written differently and means the same has the same digest; what a name stands for
// belongs to it.
TEST(Recipe, TheDigestIsOfTheContent) {
    const std::string digest = read(R"({"recipe": 1, "outputs": [{"view": "left"}]})").digest;
    EXPECT_EQ(read("{ \"outputs\":[ {\"view\":\"left\"} ],\n\n\"recipe\":1}").digest, digest);
    EXPECT_NE(read(R"({"recipe": 1, "outputs": [{"view": "right"}]})").digest, digest);
    EXPECT_EQ(read(R"({"recipe": 1, "notes": "x", "outputs": [{"view": "left"}]})").digest, digest);
    EXPECT_EQ(read(R"({"$schema": "x", "recipe": 1, "outputs": [{"view": "left"}]})").digest,
              digest);
    const test::TemporaryFolder folder;
    presets::Preset preset;
    preset.name = "Mine";
    preset.look.transferFunction.weights = {0.0, 1.0};
    presets::writePreset(folder / "mine.json", preset);
    test::writeText(folder / "recipe.json",
                    R"({"recipe": 1, "outputs": [{"look": "mine.json", "view": "left"}]})");
    const std::string before = readRecipe(folder / "recipe.json").digest;
    EXPECT_EQ(readRecipe(folder / "recipe.json").digest, before);
    preset.look.transferFunction.weights = {0.0, 0.9};
    presets::writePreset(folder / "mine.json", preset);
    EXPECT_NE(readRecipe(folder / "recipe.json").digest, before);
}

TEST(Recipe, ViewsTurnAndFitTheVolume) {
    const Recipe recipe = read(R"({"recipe": 1, "outputs": [
        {"view": "LAO30,CRA20", "size": [200, 100]},
        {"turntable": 4, "size": 64},
        {"name": "fine", "turntable": 3, "format": "npy", "pixel_mm": 0.5},
        {"name": "listed", "views": ["AP", {"primary_deg": 90}], "size": 32}]})");
    const volume::Volume volume = volumeOf({20, 30, 40}, {1.0, 1.0, 2.0});
    const double across = 2.0 * volume.lattice().radiusMm();
    const scene::Scene oblique = sceneOf(recipe.outputs[0], volume);
    EXPECT_EQ(oblique.camera.width, 200);
    EXPECT_NEAR(oblique.camera.pixelMm, across / 100.0, 1e-12); // the smaller side
    const std::vector<std::string> frames{"turntable_0000.png", "turntable_0001.png",
                                          "turntable_0002.png", "turntable_0003.png"};
    EXPECT_EQ(filesOf(recipe.outputs[1]), frames);
    const auto cameras =
        camerasOf(recipe.outputs[1], sceneOf(recipe.outputs[1], volume), volume.lattice());
    ASSERT_EQ(cameras.size(), 4U);
    const glm::dquat back = scene::viewOrientation(scene::StandardView::back);
    EXPECT_NEAR(std::abs(glm::dot(cameras[2].orientation, back)), 1.0, 1e-12);
    EXPECT_EQ(filesOf(recipe.outputs[2]), std::vector<std::string>{"fine.npy"});
    const scene::Scene fine = sceneOf(recipe.outputs[2], volume);
    EXPECT_EQ(fine.camera.pixelMm, 0.5);
    EXPECT_GE(fine.camera.width * 0.5, across);
    EXPECT_EQ(recipe.outputs[3].views.size(), 2U);
}

// An output without a name is named after its view.
TEST(Recipe, AnglesNameAnOutput) {
    const Recipe recipe = read(R"({"recipe": 1, "outputs": [{"view": "LAO 30, CRA 20"}]})");
    EXPECT_EQ(filesOf(recipe.outputs.front()), std::vector<std::string>{"LAO_30,_CRA_20.png"});
    const Recipe spaces =
        read(R"({"recipe": 1, "outputs": [{"view": "LAO30)" + std::string(300, ' ') + R"("}]})");
    EXPECT_LT(filesOf(spaces.outputs.front()).front().size(), 100U);
}

TEST(Recipe, ABodyFillsAllViewsOfAnOutput) {
    const Recipe recipe = read(R"({"recipe": 1, "outputs": [
        {"name": "sized", "turntable": 8, "fit": "body", "size": [120, 200]},
        {"name": "free", "turntable": 8, "fit": "body", "pixel_mm": 0.5}]})");
    const volume::Volume volume = volumeOf({60, 60, 60}, {2.0, 2.0, 2.0});
    scene::Exposure exposure;
    exposure.lowMm = {-30.0, -10.0, -50.0};
    exposure.highMm = {20.0, 5.0, 10.0};
    for (const Output &output : recipe.outputs) {
        scene::Scene scene = sceneOf(output, volume);
        const auto whole = camerasOf(output, scene, volume.lattice());
        EXPECT_EQ(whole.front().panMm, glm::dvec2(0.0)); // nothing is known of the body
        scene.tone.exposure = exposure;
        const auto cameras = camerasOf(output, scene, volume.lattice());
        double fullest = 0.0;
        for (const scene::Camera &camera : cameras) {
            EXPECT_EQ(camera.pixelMm, cameras.front().pixelMm);
            EXPECT_EQ(camera.width, cameras.front().width);
            EXPECT_LE(camera.width, whole.front().width);
            // Every corner is in the picture.
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec3 p((corner & 1) ? -30.0 : 20.0, (corner & 2) ? -10.0 : 5.0,
                                   (corner & 4) ? -50.0 : 10.0);
                const double u = (glm::dot(camera.axes()[0], p) - camera.panMm.x) / camera.pixelMm,
                             v = (glm::dot(camera.axes()[1], p) - camera.panMm.y) / camera.pixelMm;
                fullest = std::max(
                    {fullest, 2.0 * std::abs(u) / camera.width, 2.0 * std::abs(v) / camera.height});
            }
        }
        EXPECT_LE(fullest, 0.95);
        EXPECT_GE(fullest, 0.88); // it fills the largest picture
    }
}

// The window writes recipes that the command line reads.
TEST(Recipe, OfASceneMakesItsLookOfOtherStudies) {
    scene::Scene scene;
    scene.camera.orientation = scene::viewOrientation(scene::StandardView::left, {10, 5, 0});
    scene.camera.width = 300;
    scene.camera.height = 200;
    scene.camera.panMm = {10.0, 5.0};
    scene.tolerance = 1e-4;
    scene.tone.exposure = scene::Exposure();
    const auto library = presets::PresetLibrary({});
    const presets::Preset look = library.get("Bone over soft tissue").preset;
    const Recipe recipe = read(recipeOf(scene, look, Format::captureLoop, 36, true));
    ASSERT_EQ(recipe.outputs.size(), 1U);
    const Output &output = recipe.outputs.front();
    EXPECT_EQ(output.format, Format::captureLoop);
    EXPECT_EQ(output.views.size(), 36U);
    EXPECT_TRUE(output.isDeidentified);
    EXPECT_EQ(output.fit, Fit::body); // as the window does
    EXPECT_FALSE(read(recipeOf(scene, look, Format::png, 0, true)).outputs[0].isDeidentified);
    const scene::Scene made = sceneOf(output, volumeOf({20, 30, 40}, {1.0, 1.0, 2.0}));
    EXPECT_NEAR(std::abs(glm::dot(made.camera.orientation, scene.camera.orientation)), 1.0, 1e-12);
    EXPECT_EQ(made.look.classes, look.look.classes);
    EXPECT_EQ(made.tolerance, 1e-4);
    EXPECT_FALSE(made.tone.exposure);
    EXPECT_EQ(made.camera.panMm, glm::dvec2(0.0));
    EXPECT_EQ(made.camera.width, 300);
}

// Volumes without HU have no couch that could be found.
TEST(Recipe, WithoutTheCouchIsForCtInAnyLook) {
    const auto unitless =
        volume::Volume(volume::Lattice::centred({8, 8, 8}, {1.0, 1.0, 1.0}),
                       std::vector<std::int16_t>(512, 40), volume::ValueUnit::none);
    const auto ct = volumeOf({8, 8, 8}, {1.0, 1.0, 1.0});
    for (const std::string look : {"", R"("look": "Bone in relief",)"}) {
        const Output output =
            read(R"({"recipe": 1, "outputs": [{)" + look + R"("without_couch": true}]})")
                .outputs[0];
        EXPECT_TRUE(classify::isWithoutCouch(sceneOf(output, ct).look)) << look;
        EXPECT_FALSE(classify::isWithoutCouch(sceneOf(output, unitless).look)) << look;
        Output with = output;
        with.isWithoutCouch = false;
        EXPECT_FALSE(classify::isWithoutCouch(sceneOf(with, ct).look)) << look;
    }
}

// The schema that editors use knows the names that the reader knows.
TEST(Recipe, TheSchemaIsThatOfTheReader) {
    const nlohmann::json schema =
        nlohmann::json::parse(test::readText(PELLUCID_SOURCE "/resources/recipe.schema.json"));
    const auto namesOf = [](const nlohmann::json &object) {
        std::set<std::string> names;
        for (const auto &[name, value] : object["properties"].items())
            names.insert(name);
        return names;
    };
    // "...: unknown value 'x': use one of a, b, c".
    const auto namesIn = [](const std::string &fault) {
        const std::string start = "use one of ";
        std::istringstream list(fault.substr(fault.find(start) + start.size()));
        std::set<std::string> names;
        for (std::string name; std::getline(list >> std::ws, name, ',');)
            names.insert(name);
        return names;
    };
    EXPECT_EQ(namesIn(faultOf(R"({"recipe": 1, "x": 1, "outputs": [{}]})")), namesOf(schema));
    EXPECT_EQ(namesIn(faultOf(R"({"recipe": 1, "outputs": [{"x": 1}]})")),
              namesOf(schema["properties"]["outputs"]["items"]));
    EXPECT_EQ(namesIn(faultOf(R"({"recipe": 1, "series": {"x": 1}, "outputs": [{}]})")),
              namesOf(schema["properties"]["series"]));
    const auto formats = schema["properties"]["outputs"]["items"]["properties"]["format"]["enum"]
                             .get<std::set<std::string>>();
    EXPECT_EQ(namesIn(faultOf(R"({"recipe": 1, "outputs": [{"format": "x"}]})")), formats);
    const auto fits = schema["properties"]["outputs"]["items"]["properties"]["fit"]["enum"]
                          .get<std::set<std::string>>();
    EXPECT_EQ(namesIn(faultOf(R"({"recipe": 1, "outputs": [{"fit": "x"}]})")), fits);
}

TEST(Recipe, ChoosesTheSeriesThatItAsksFor) {
    dicom::Patient patient;
    dicom::Study study;
    const auto add = [&](const char *description, const char *modality, int slices, double mm) {
        dicom::Series series;
        series.uid = description;
        series.description = description;
        series.modality = modality;
        series.volumes = {stack(slices, mm)};
        study.series.push_back(series);
    };
    add("Scout", "CT", 3, 5.0);
    add("Thin chest", "CT", 300, 0.8);
    add("Thick chest", "CT", 60, 5.0);
    add("T1", "MR", 400, 1.0);
    const auto chosen = [&](const SeriesChoice &choice) {
        return choose(choice, patient, study).series->uid;
    };
    EXPECT_EQ(chosen({}), "T1");
    EXPECT_EQ(
        chosen(read(R"({"recipe": 1, "series": {"modality": "ct"}, "outputs": [{}]})").series),
        "Thin chest"); // codes are in capital letters
    EXPECT_EQ(chosen({.modalities = {"CT"}}), "Thin chest");
    EXPECT_EQ(chosen({.modalities = {"CT"}, .sliceMm = {{3.0, 6.0}}}), "Thick chest");
    EXPECT_EQ(chosen({.description = "*CHEST"}), "Thin chest");
    EXPECT_EQ(chosen({.description = "th?ck*"}), "Thick chest");
    add(std::string(60, 'a').c_str(), "CT", 5, 1.0);
    EXPECT_THROW(chosen({.description = "*a*a*a*a*a*a*a*a*a*b"}), task::Error); // at once
    EXPECT_THROW(chosen({.modalities = {"PT"}}), task::Error);
    EXPECT_THROW(chosen({.minSlices = 500}), task::Error);
    // The first of equals, whatever the order of the files: that with the smaller UID.
    add("Also thin chest", "CT", 300, 0.8);
    EXPECT_EQ(chosen({.modalities = {"CT"}}), "Also thin chest");
}

} // namespace pellucid::batch
