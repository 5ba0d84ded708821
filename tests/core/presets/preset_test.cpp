// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/presets/preset.h"

#include <fstream>

#include <gtest/gtest.h>

#include "core/files/reasons.h"
#include "core/phantom/phantom.h"
#include "core/presets/reasons.h"
#include "core/task/error.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {
namespace {

using presets::Preset;

const char *const full = R"({
  "schema": "pellucid-preset/2",
  "name": "Test",
  "modality": "CT",
  "window": [-900, 2000],
  "laboratory": {"room": 3},
  "classes": [
    {
      "name": "Bone",
      "range": [250, 2500],
      "softness": 150,
      "weight": 1.25,
      "color": "#fff0d0",
      "author": "someone",
      "steps": [
        {"kind": "median", "radius_mm": 1.5},
        {"kind": "largest"}
      ]
    }
  ],
  "transfer_function": {"weights": [0, 0.5, 2], "range": [0, 1]}
}
)";

std::string reasonOf(const std::string &text) {
    try {
        presets::presetFromJson(text);
        return "accepted";
    } catch (const task::Error &error) {
        EXPECT_EQ(error.code(), task::ErrorCode::unusable);
        return error.reason().english();
    }
}

std::string with(const std::string &from, const std::string &to) {
    std::string text = full;
    text.replace(text.find(from), from.size(), to);
    return text;
}

TEST(Preset, JsonKeepsEverythingAndWhatItDoesNotKnow) {
    const Preset preset = presets::presetFromJson(full);
    EXPECT_EQ(preset.name, "Test");
    EXPECT_EQ(preset.window, (classify::FieldWindow{-900, 2000}));
    ASSERT_EQ(preset.look.classes.size(), 1U);
    EXPECT_EQ(preset.look.classes[0].steps.size(), 2U);
    EXPECT_EQ(preset.look.classes[0].steps[0].at("radius_mm"), 1.5);
    const std::string written = presets::toJson(preset);
    EXPECT_NE(written.find("\"room\": 3"), std::string::npos);
    EXPECT_NE(written.find("\"author\": \"someone\""), std::string::npos);
    const Preset back = presets::presetFromJson(written);
    EXPECT_EQ(back.look, preset.look);
    EXPECT_EQ(back.window, preset.window);
    EXPECT_EQ(presets::toJson(back), written);
    // Removed parts do not come back.
    Preset less = preset;
    less.look.classes[0].steps.clear();
    less.window.reset();
    EXPECT_EQ(presets::presetFromJson(presets::toJson(less)).look, less.look);
    EXPECT_FALSE(presets::presetFromJson(presets::toJson(less)).window);
}

TEST(Preset, RefusesWithLineAndReason) {
    EXPECT_EQ(reasonOf(full), "accepted");
    EXPECT_EQ(reasonOf(with("[250, 2500]", "[250]")),
              "line 10: /classes/0/range: must be two numbers");
    EXPECT_EQ(reasonOf(with("\"weight\": 1.25", "\"weight\": \"x\"")),
              "line 12: /classes/0/weight: must be a number");
    EXPECT_EQ(reasonOf(with("1.25", "1e308")), "line 12: /classes/0/weight: is out of range");
    EXPECT_EQ(reasonOf(with("[0, 0.5, 2]", "[\n0, 0.5,\n 1e999]")),
              "line 23: not JSON: number overflow parsing '1e999'");
    EXPECT_EQ(
        reasonOf(with("\"kind\": \"largest\"", "\"kind\": \"biggest\"")).rfind("line 17: ", 0), 0U);
    EXPECT_EQ(reasonOf(with("\"radius_mm\": 1.5", "\"radius_mm\": -1")).rfind("line 16: ", 0), 0U);
    EXPECT_EQ(reasonOf(with("\"radius_mm\": 1.5", "\"method\": \"ITK\"")),
              "line 16: /classes/0/steps/0: the step 'median' has no parameter 'method'; "
              "it has radius_mm");
    EXPECT_EQ(reasonOf(with("preset/2", "preset/9")), "line 2: /schema: is not pellucid-preset/2");
    EXPECT_EQ(reasonOf(with("\"Test\"", "\"\"")).rfind("line 3: /name: ", 0), 0U);
    EXPECT_EQ(reasonOf(with("[-900, 2000]", "[2000, -900]")).rfind("line 5: /window: ", 0), 0U);
    EXPECT_EQ(reasonOf(with("[-900, 2000]", "[-1e308, 1e308]")),
              "line 5: /window/0: is out of range");
    EXPECT_EQ(reasonOf(with("[-900, 2000]", "[-900, \"x\"]")),
              "line 5: /window/1: must be a number");
    EXPECT_EQ(reasonOf(with("[-900, 2000]", "3")), "line 5: /window: must be two numbers");
    EXPECT_EQ(reasonOf(with("\"#fff0d0\"", "7")), "line 13: /classes/0/color: must be text");
    EXPECT_EQ(reasonOf(with("\"#fff0d0\"", "\"red\"")),
              "line 13: /classes/0/color: 'red' is not a color of the form #rrggbb");
    EXPECT_EQ(reasonOf(with("\"Test\"", "\"   \"")).rfind("line 3: /name: ", 0), 0U);
    EXPECT_EQ(reasonOf("[]"), "line 1: must be an object");
    EXPECT_EQ(reasonOf("").rfind("line 1: ", 0), 0U);
    // A file that is cut off anywhere is refused, and the line is named.
    const std::string text = full;
    for (std::size_t n = 0; n + 2 < text.size(); n += 7)
        EXPECT_EQ(reasonOf(text.substr(0, n)).rfind("line ", 0), 0U) << n;
    EXPECT_NE(reasonOf(std::string(100000, '[')).find("nested"), std::string::npos);
}

TEST(Preset, FilesThatArePresetsOnly) {
    test::TemporaryFolder folder;
    EXPECT_THROW(presets::readPreset(folder / "absent.json"), task::Error);
    EXPECT_THROW(presets::readPreset(folder / "."), task::Error);
    std::ofstream(folder / "large.json") << std::string(10 << 20, ' ');
    try {
        presets::readPreset(folder / "large.json");
        FAIL();
    } catch (const task::Error &error) {
        EXPECT_TRUE(error.reason().is(task::because::isTooLargeForItsKind)) << error.what();
        EXPECT_EQ(error.path(), folder / "large.json");
    }
}

TEST(Preset, SharesOfTheWindowBecomeValuesAndBack) {
    Preset preset = presets::presetFromJson(R"({"schema": "pellucid-preset/2", "name": "MR",
        "units": "window", "classes": [
        {"name": "Brain", "range": [0.25, 0.75], "softness": 0.1},
        {"name": "Edges", "range": [0, 1], "steps": [{"kind": "edges", "low": 0.01, "high": 0.04}]},
        {"name": "Slope", "range": [0.1, 0.2], "steps": [{"kind": "gradient"}]},
        {"name": "Above", "range": [0, 1], "steps": [{"kind": "binarise", "from": 0.5}]}]})");
    const classify::FieldWindow window{100.0, 500.0};
    const auto look = presets::lookFor(preset, window);
    EXPECT_EQ(look.classes[0].low, 200.0);
    EXPECT_EQ(look.classes[0].high, 400.0);
    EXPECT_EQ(look.classes[0].softness, 40.0);
    EXPECT_EQ(look.classes[1].steps[0].at("low"), 4.0); // a slope has no offset
    EXPECT_EQ(look.classes[1].steps[0].at("high"), 16.0);
    EXPECT_EQ(look.classes[2].low, 40.0);
    EXPECT_EQ(look.classes[3].steps[0].at("from"), 300.0);
    // Saved from a volume without a scale, the values are shares again and unchanged.
    const volume::Volume volume(volume::Lattice(), std::vector<float>{0.0F},
                                volume::ValueUnit::none);
    const Preset kept = presets::presetOf("MR", look, {}, window, volume);
    EXPECT_EQ(kept.unit, presets::RangeUnit::window);
    EXPECT_FALSE(kept.window);
    const auto again = presets::lookFor(kept, window);
    EXPECT_NEAR(again.classes[3].steps[0].at("from"), 300.0, 1e-9);
    for (std::size_t n = 0; n < 3; ++n) {
        EXPECT_NEAR(again.classes[n].low, look.classes[n].low, 1e-9);
        EXPECT_NEAR(again.classes[n].high, look.classes[n].high, 1e-9);
    }
    EXPECT_NEAR(again.classes[1].steps[0].at("low"), 4.0, 1e-9);
}

TEST(Preset, ReportsVolumesThatItIsNotMadeFor) {
    const Preset preset = presets::presetFromJson(full);
    const volume::Volume ct(volume::Lattice(), std::vector<float>{0.0F},
                            volume::ValueUnit::hounsfield, {.modality = "CT"});
    const volume::Volume mr(volume::Lattice(), std::vector<float>{0.0F}, volume::ValueUnit::none,
                            {.modality = "MR"});
    const volume::Volume file(volume::Lattice(), std::vector<float>{0.0F}, volume::ValueUnit::none);
    EXPECT_FALSE(presets::mismatch(preset, ct));
    EXPECT_EQ(presets::mismatch(preset, mr),
              task::because::presetIsForOther(preset.name, "CT", "MR"));
    EXPECT_EQ(presets::mismatch(preset, file), task::because::presetIsForHounsfield(preset.name));
}

} // namespace
} // namespace pellucid
