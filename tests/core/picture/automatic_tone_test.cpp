// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/picture/automatic_tone.h"

#include <gtest/gtest.h>

#include <functional>

namespace pellucid::picture {

namespace {

scene::Exposure exposed(double high) {
    scene::Exposure exposure;
    for (scene::Exposure::Axis &axis : exposure.axes)
        axis.high = axis.bright = high;
    return exposure;
}
const scene::Exposure bright = exposed(300.0), dark = exposed(200.0);

scene::Scene litScene() {
    scene::Scene scene;
    scene.look.transferFunction.weights = {0.0, 0.5, 1.0};
    scene.fieldWindow = {-500.0, 1500.0};
    scene.shading.lights.emplace_back();
    return scene;
}

AutomaticTone taken(const scene::Exposure &exposure) {
    AutomaticTone tone;
    tone.take(exposure);
    return tone;
}

AutomaticTone adopted(const scene::Scene &scene) {
    AutomaticTone tone;
    tone.adopt(bright, scene);
    return tone;
}

} // namespace

TEST(AutomaticTone, IsTakenFromTheFirstFrameAndKeptUntilOtherFieldsCome) {
    AutomaticTone tone;
    EXPECT_TRUE(tone.isWanted());
    tone.take(bright);
    EXPECT_FALSE(tone.isWanted());
    EXPECT_EQ(tone.completed({}).exposure, bright);
    EXPECT_EQ(tone.completed({.high = 80.0}).high, 80.0); // the user's own end
    tone.beginFields({});
    EXPECT_TRUE(tone.isWanted());
    EXPECT_EQ(tone.exposure(), bright); // until a new one is taken
}

TEST(AutomaticTone, IsRetakenForNewLightsAndCuesAndKeptDuringDrags) {
    const std::pair<std::function<void(shading::Shading &)>, bool> changes[] = {
        {[](auto &s) { s.lights.emplace_back(); }, true},
        {[](auto &s) { s.lights.clear(); }, true},
        {[](auto &s) { s.cue.kind = shading::CueKind::sine; }, true},
        {[](auto &s) { s.cue.strength = 0.3; }, false},
        {[](auto &s) {
             s.lights[0].direction = {0.0, 1.0, 0.0};
         },
         false}};
    for (const auto &[change, isAnother] : changes) {
        shading::Shading shading = litScene().shading;
        shading.cue.kind = shading::CueKind::linear;
        AutomaticTone tone = taken(bright);
        tone.follow(shading, {});
        tone.take(bright);
        tone.follow(shading, {});
        EXPECT_FALSE(tone.isWanted());
        change(shading);
        tone.follow(shading, {});
        EXPECT_EQ(tone.isWanted(), isAnother);
    }
}

TEST(AutomaticTone, OtherContrastIsMeasuredAgain) {
    AutomaticTone tone = taken(bright);
    tone.follow({}, {});
    EXPECT_FALSE(tone.isWanted());
    scene::Scene scene;
    for (const auto &change : {std::function<void()>([&] { scene.tone.detail = 0.2; }),
                               {[&] { scene.tone.latitude = 0.7; }},
                               {[&] { scene.image.detail = 1.0; }}}) {
        change();
        tone.follow({}, scene);
        EXPECT_TRUE(tone.isWanted());
        tone.take(dark);
        tone.follow({}, scene);
        EXPECT_FALSE(tone.isWanted());
    }
}

TEST(AutomaticTone, ASceneSeenAgainKeepsItsTone) {
    const scene::Scene scene = litScene();
    AutomaticTone tone = adopted(scene);
    tone.beginFields(scene); // fields of the coarse picture
    tone.follow(scene.shading, scene);
    tone.beginFields(scene);
    tone.follow(scene.shading, scene);
    EXPECT_FALSE(tone.isWanted());
    EXPECT_EQ(tone.exposure(), bright);
    tone.retake();
    tone.take(dark);
    tone.beginFields(scene); // the kept tone is gone
    EXPECT_TRUE(tone.isWanted());
}

TEST(AutomaticTone, ADifferentSceneDoesNotTakeTheKeptTone) {
    const std::function<void(scene::Scene &)> changes[] = {
        [](auto &s) { s.look.transferFunction.weights[1] = 1.0; },
        [](auto &s) { s.fieldWindow.reset(); }, [](auto &s) { s.crop.low.x += 0.25; },
        [](auto &s) { s.shading.lights.clear(); },
        [](auto &s) { s.shading.cue.kind = shading::CueKind::sine; }};
    for (const auto &change : changes) {
        scene::Scene other = litScene();
        AutomaticTone tone = adopted(other);
        change(other);
        tone.beginFields(other);
        EXPECT_TRUE(tone.isWanted());
    }
}

TEST(AutomaticTone, IsDroppedWithItsVolumeUnlessAPhaseFollows) {
    AutomaticTone tone = taken(bright);
    tone.hold();
    EXPECT_TRUE(tone.outlivesVolume(false)); // the former phase is closed
    EXPECT_TRUE(tone.outlivesVolume(true));
    EXPECT_EQ(tone.exposure(), bright);
    EXPECT_FALSE(tone.outlivesVolume(true)); // another study
    EXPECT_TRUE(tone.isWanted());
    EXPECT_EQ(tone.exposure(), scene::Exposure());
}

} // namespace pellucid::picture
