// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/classify/reasons.h"
#include "core/files/reasons.h"
#include "core/fourier/kernels/reasons.h"
#include "core/scene/planning_scene.h"
#include "core/scene/scene.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

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

// A scene that is planned for the whole volume depends neither on the view nor on settings that
// cost nothing.
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
    // The picture contains the whole volume.
    const scene::Camera camera = scene::planningScene(scene, lattice).camera;
    EXPECT_GE(camera.width * camera.pixelMm, 2.0 * lattice.radiusMm() - camera.pixelMm);
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
    EXPECT_THROW(scene::sceneFromJson(replaced("pellucid-scene/3", "other")), task::Error);
    for (const char *look :
         {R"("transfer_function": {"weights": [1.0], "range": [0, 1]})",
          R"("transfer_function": {"weights": [1.0, 9.0], "range": [0, 1]})",
          R"("transfer_function": {"weights": [1.0, 1.0], "range": [0, 1], "of": 1})",
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

TEST(Scene, RefusalsNameThePlaceAndTheFault) {
    namespace because = task::because;
    const auto at = [](const char *pointer, const task::Reason &fault) {
        return because::at(pointer, fault);
    };
    struct Case {
        const char *from, *to;
        task::Reason reason;
    };
    const std::string good = scene::toJson({});
    for (const Case &c : std::vector<Case>{
             {"pellucid-scene/3", "other", at("/schema", because::isNot("pellucid-scene/3"))},
             {"\"camera\"", "\"camera_\"", because::hasNo("camera")},
             {"\"pixel_mm\": 1.0", "\"pixel_mm\": \"x\"",
              at("/camera/pixel_mm", because::mustBeANumber)},
             {"\"orientation\": [", "\"orientation\": [0.5,",
              at("/camera/orientation", because::mustBeFourNumbers)},
             {"\"cubic\"", "\"quintic\"",
              at("/reconstruction",
                 because::isNoneOf("quintic", "cubic, linear, band-limited, spline"))},
             {"\"roll_off\":", "\"planned_for\": \"me\", \"roll_off\":",
              at("/planned_for", because::isNoneOf("me", "picture, volume"))},
             {"\"roll_off\":", "\"kernel\": \"ES9\", \"roll_off\":",
              at("/kernel", because::isNoKernel("ES9"))},
             {"\"roll_off\":", "\"crop\": {\"low\": [0, 0, 0]}, \"roll_off\":",
              at("/crop", because::hasNo("high"))},
             {"\"inverted\": false", "\"inverted\": 0",
              at("/tone/inverted", because::mustBeTrueOrFalse)},
             {"\"tone\":", "\"tone\": 3, \"tone_\":", at("/tone", because::mustBeAnObject)}}) {
        std::string text = good;
        text.replace(text.find(c.from), std::string(c.from).size(), c.to);
        try {
            scene::sceneFromJson(text);
            ADD_FAILURE() << c.to << " is accepted";
        } catch (const task::Error &error) {
            EXPECT_EQ(error.reason(), c.reason) << error.reason().english();
        }
    }
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
