// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "core/scene/planning_scene.h"
#include "core/scene/scene.h"
#include "core/task/error.h"

namespace pellucid {

namespace {

TEST(Scene, JsonKeepsEverything) {
    scene::Scene scene;
    scene.camera = {scene::viewOrientation(scene::StandardView::left, {3, 4, 5}),
                    0.731,
                    640,
                    480,
                    {1.5, -2.25}};
    scene.fieldWindow = classify::FieldWindow{-123.5, 1e4};
    scene.image = {scene::Reconstruction::bandLimited, 0.125};
    scene.tolerance = 2e-3;
    scene.plannedFor = scene::PlannedFor::volume;
    scene.tone = {0.25, 17.0, true};
    scene.crop = {{0.1, 0.0, 0.25}, {0.9, 1.0, 0.5}};
    scene.look.transferFunction.weights = {0.0, 0.5, 2.0};
    scene.look.classes = {{"bone", 250, 2500, 150, 1.25, classify::colorFromText("#fff0d0")},
                          {"soft", -100, 100, 20, 0.0, {}, classify::TransferFunction{{0.0, 1.0}}}};
    const scene::Scene back = scene::sceneFromJson(scene::toJson(scene));
    // Reading normalises the orientation, which may move its last bit.
    EXPECT_NEAR(glm::dot(back.camera.orientation, scene.camera.orientation), 1.0, 1e-15);
    scene::Scene same = back;
    same.camera.orientation = scene.camera.orientation;
    EXPECT_EQ(same, scene);
    scene.fieldWindow.reset();
    scene.tone = {};
    same = scene::sceneFromJson(scene::toJson(scene));
    same.camera.orientation = scene.camera.orientation;
    EXPECT_EQ(same, scene);
}

// The scene planned for the whole volume does not depend on the view, nor on settings that cost
// nothing.
TEST(Scene, PlanningForTheVolumeForgetsTheView) {
    const auto lattice = volume::Lattice::centred({40, 30, 20}, {1, 1, 2});
    scene::Scene scene;
    scene.tolerance = 1e-4;
    scene.camera.panMm = {3, 4};
    EXPECT_EQ(scene::planningScene(scene, lattice), scene); // planned for the picture: unchanged
    scene.plannedFor = scene::PlannedFor::volume;
    scene.shading = {.cue = {shading::CueKind::linear, 0.6}, .lights = {{{1, 1, 1}}, {{0, 0, 1}}}};
    scene::Scene other = scene;
    other.camera.orientation = scene::viewOrientation(scene::StandardView::top);
    other.camera.pixelMm = 0.2;
    other.tone.high = 7.0;
    other.shading.cue.strength = 0.9;
    other.shading.lights.pop_back();
    EXPECT_EQ(scene::planningScene(other, lattice), scene::planningScene(scene, lattice));
    EXPECT_EQ(scene::planningScene(scene, lattice).tolerance, 1e-4);
    EXPECT_EQ(scene::planningScene(scene, lattice).shading.cue.strength, 1.0);
    // The picture holds the whole volume.
    const scene::Camera camera = scene::planningScene(scene, lattice).camera;
    EXPECT_GE(camera.width * camera.pixelMm, 2.0 * lattice.radiusMm() - camera.pixelMm);
}

// "cubic" meant the spline in the first version of the format, where it was also the default.
TEST(Scene, ScenesOfTheFirstVersionKeepTheirReconstruction) {
    const auto first = [](const std::string &reconstruction) {
        std::string text = scene::toJson({});
        text.replace(text.find("pellucid-scene/2"), 16, "pellucid-scene/1");
        const std::string line = "\"reconstruction\": \"cubic\",";
        text.replace(text.find(line), line.size(), reconstruction);
        return scene::sceneFromJson(text).image.reconstruction;
    };
    EXPECT_EQ(first(""), scene::Reconstruction::spline);
    EXPECT_EQ(first("\"reconstruction\": \"cubic\","), scene::Reconstruction::spline);
    EXPECT_EQ(first("\"reconstruction\": \"linear\","), scene::Reconstruction::linear);
    EXPECT_EQ(scene::sceneFromJson(scene::toJson({})).image.reconstruction,
              scene::Reconstruction::cubic);
}

TEST(Scene, RefusesBadJsonWithTheReason) {
    const std::string good = scene::toJson({});
    EXPECT_THROW(scene::sceneFromJson("{"), task::Error);
    EXPECT_THROW(scene::sceneFromJson("{}"), task::Error);
    const auto replaced = [&](const std::string &from, const std::string &to) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        return text;
    };
    EXPECT_THROW(scene::sceneFromJson(replaced("\"cubic\"", "\"quintic\"")), task::Error);
    EXPECT_THROW(scene::sceneFromJson(replaced("pellucid-scene/2", "other")), task::Error);
    for (const char *look :
         {R"("transfer_function": [1.0])", R"("transfer_function": [1.0, 9.0])",
          R"("transfer_function": "x")", R"("classes": [{"name": "a"}])",
          R"("classes": [{"name": "a", "range": [1, 0]}])",
          R"("classes": [{"name": "a", "range": [0, 1], "color": "red"}])", R"("classes": 3)"})
        EXPECT_THROW(scene::sceneFromJson(replaced("\"tone\":", std::string(look) + ", \"tone\":")),
                     task::Error)
            << look;
    EXPECT_THROW(scene::sceneFromJson(replaced("\"pixel_mm\": 1.0", "\"pixel_mm\": -1.0")),
                 task::Error);
    EXPECT_THROW(scene::sceneFromJson(replaced("\"pixel_mm\": 1.0", "\"pixel_mm\": \"x\"")),
                 task::Error);
}

TEST(Scene, ValidationNamesTheValue) {
    scene::Scene scene;
    scene.camera.orientation = glm::dquat(0, 0, 0, 0);
    EXPECT_THROW(scene::validate(scene), task::Error);
    scene = {};
    scene.fieldWindow = classify::FieldWindow{2, 1};
    EXPECT_THROW(scene::validate(scene), task::Error);
    scene = {};
    scene.camera.width = 0;
    EXPECT_THROW(scene::validate(scene), task::Error);
}

} // namespace
} // namespace pellucid
