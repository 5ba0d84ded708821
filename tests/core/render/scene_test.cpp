// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "core/render/scene.h"
#include "core/task/error.h"

namespace pellucid {

namespace {

TEST(Scene, JsonKeepsEverything) {
    render::Scene scene;
    scene.camera = {render::viewOrientation(render::StandardView::left, {3, 4, 5}),
                    0.731,
                    640,
                    480,
                    {1.5, -2.25}};
    scene.fieldWindow = classify::FieldWindow{-123.5, 1e4};
    scene.image = {render::Reconstruction::bandLimited, 0.125};
    scene.tolerance = 2e-3;
    scene.tone = {0.25, 17.0, true};
    scene.look.transferFunction.weights = {0.0, 0.5, 2.0};
    scene.look.classes = {{"bone", 250, 2500, 150, 1.25, classify::colorFromText("#fff0d0")},
                          {"soft", -100, 100, 20, 0.0, {}, classify::TransferFunction{{0.0, 1.0}}}};
    const render::Scene back = render::sceneFromJson(render::toJson(scene));
    // Reading normalises the orientation, which may move its last bit.
    EXPECT_NEAR(glm::dot(back.camera.orientation, scene.camera.orientation), 1.0, 1e-15);
    render::Scene same = back;
    same.camera.orientation = scene.camera.orientation;
    EXPECT_EQ(same, scene);
    scene.fieldWindow.reset();
    scene.tone = {};
    same = render::sceneFromJson(render::toJson(scene));
    same.camera.orientation = scene.camera.orientation;
    EXPECT_EQ(same, scene);
}

TEST(Scene, RefusesBadJsonWithTheReason) {
    const std::string good = render::toJson({});
    EXPECT_THROW(render::sceneFromJson("{"), task::Error);
    EXPECT_THROW(render::sceneFromJson("{}"), task::Error);
    const auto replaced = [&](const std::string &from, const std::string &to) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        return text;
    };
    EXPECT_THROW(render::sceneFromJson(replaced("\"cubic\"", "\"quintic\"")), task::Error);
    EXPECT_THROW(render::sceneFromJson(replaced("pellucid-scene/1", "other")), task::Error);
    for (const char *look :
         {R"("transfer_function": [1.0])", R"("transfer_function": [1.0, 9.0])",
          R"("transfer_function": "x")", R"("classes": [{"name": "a"}])",
          R"("classes": [{"name": "a", "range": [1, 0]}])",
          R"("classes": [{"name": "a", "range": [0, 1], "color": "red"}])", R"("classes": 3)"})
        EXPECT_THROW(
            render::sceneFromJson(replaced("\"tone\":", std::string(look) + ", \"tone\":")),
            task::Error)
            << look;
    EXPECT_THROW(render::sceneFromJson(replaced("\"pixel_mm\": 1.0", "\"pixel_mm\": -1.0")),
                 task::Error);
    EXPECT_THROW(render::sceneFromJson(replaced("\"pixel_mm\": 1.0", "\"pixel_mm\": \"x\"")),
                 task::Error);
}

TEST(Scene, ValidationNamesTheValue) {
    render::Scene scene;
    scene.camera.orientation = glm::dquat(0, 0, 0, 0);
    EXPECT_THROW(render::validate(scene), task::Error);
    scene = {};
    scene.fieldWindow = classify::FieldWindow{2, 1};
    EXPECT_THROW(render::validate(scene), task::Error);
    scene = {};
    scene.camera.width = 0;
    EXPECT_THROW(render::validate(scene), task::Error);
}

} // namespace
} // namespace pellucid
