// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/presets/study_traits.h"

#include <gtest/gtest.h>

#include "core/presets/preset.h"
#include "core/task/error.h"

namespace pellucid::presets {

using Regions = std::set<BodyRegion>;

TEST(StudyTraits, RegionsAreReadFromHeaders) {
    using enum BodyRegion;
    const std::pair<const char *, Regions> cases[] = {
        {"CHEST", {chest}},
        {"Thorax  5.0  B30f", {chest}},
        {"SKULL Head 2.0", {head}},
        {"L-SPINE", {spine}},
        {"CT TAP with contrast", {chest, abdomen, pelvis}},
        {"CORONARY", {chest}},
        {"Hip left", {pelvis}},
        {"tape, ship and chip", {}},
        {"", {}},
        {"Abd. portal venous", {abdomen}},
        {"AX T1", {}},
        {"surface ahead", {}},
        {"Head first supine", {}}};
    for (const auto &[text, regions] : cases)
        EXPECT_EQ(regionsNamed("", text), regions) << text;
    EXPECT_EQ(regionsNamed("CHESTABDPELVIS", ""), (Regions{chest, abdomen, pelvis}));
    EXPECT_EQ(regionsNamed("LSPINE", "Lung"), (Regions{spine, chest}));
}

TEST(StudyTraits, PresetsAreOfferedForTheirRegion) {
    Preset any, ofHead, ofVessels;
    ofHead.regions = {BodyRegion::head};
    ofVessels.needsContrast = true;
    const StudyTraits unknown, chest{{BodyRegion::chest}, false},
        headAngiography{{BodyRegion::head, BodyRegion::neck}, true};
    EXPECT_TRUE(isFor(any, chest));
    EXPECT_TRUE(isFor(ofHead, unknown));
    EXPECT_FALSE(isFor(ofHead, chest));
    EXPECT_TRUE(isFor(ofHead, headAngiography));
    EXPECT_FALSE(isFor(ofVessels, chest));
    EXPECT_TRUE(isFor(ofVessels, headAngiography));
}

TEST(StudyTraits, RegionsOfPresetsAreKeptAndChecked) {
    Preset preset;
    preset.name = "Vessels";
    preset.regions = {BodyRegion::neck, BodyRegion::head};
    preset.needsContrast = true;
    const Preset read = presetFromJson(toJson(preset));
    EXPECT_EQ(read.regions, preset.regions);
    EXPECT_TRUE(read.needsContrast);
    EXPECT_THROW(
        presetFromJson(R"({"schema": "pellucid-preset/2", "name": "a", "regions": ["toe"]})"),
        task::Error);
    EXPECT_THROW(presetFromJson(R"({"schema": "pellucid-preset/2", "name": "a", "regions": 3})"),
                 task::Error);
    EXPECT_THROW(presetFromJson(R"({"schema": "pellucid-preset/2", "name": "a", "contrast": 1})"),
                 task::Error);
}

} // namespace pellucid::presets
