// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/presets/slicer_preset.h"

#include <fstream>

#include <gtest/gtest.h>

#include "core/task/error.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {
namespace {

class SlicerPreset : public testing::Test {
protected:
    std::filesystem::path write(const std::string &name, const std::string &text) {
        std::ofstream(folder / name) << text;
        return folder / name;
    }
    std::string reasonOf(const std::filesystem::path &path) {
        try {
            presets::importSlicerPreset(path);
            return "accepted";
        } catch (const task::Error &error) {
            EXPECT_EQ(error.path(), path);
            return error.reason().english();
        }
    }
    test::TemporaryFolder folder;
};

const char *const head = "1\n1\n0.9\n0.1\n0.2\n10\n";
const char *const tail = "4 0 1 255 1\n8 -3024 0 0 0 3071 1 1 1\n";

TEST_F(SlicerPreset, ATextsRampIsMetExactly) {
    // An opacity that grows with the density is the density: every weight is 1 up to its end.
    const auto path =
        write("ramp.vp", std::string(head) + "8 -3024 0 100 0 1100 1 3071 1\n" + tail);
    const auto imported = presets::importSlicerPreset(path);
    EXPECT_EQ(imported.preset.name, "ramp");
    EXPECT_EQ(imported.preset.window, (classify::FieldWindow{100, 1100}));
    EXPECT_LT(imported.largestError, 1e-6);
    for (const double weight : imported.preset.look.transferFunction.weights)
        EXPECT_NEAR(weight, 1.0, 1e-4);
}

TEST_F(SlicerPreset, JsonAndTextAgreeAndTheErrorIsTheFits) {
    const auto text = write("bone.vp", std::string(head) +
                                           "10 -3024 0 143.556 0 166.222 0.686275 214.389 0.696078 "
                                           "3071 0.833333\n" +
                                           tail);
    const auto json = write("bone.vp.json", R"({"@schema": "volume-property-schema-v1.0.0.json#",
        "volumeProperties": [{"components": [{"scalarOpacity": {
        "type": "piecewiseLinearFunction", "points": [{"x": -3024, "y": 0}, {"x": 143.556, "y": 0},
        {"x": 166.222, "y": 0.686275}, {"x": 214.389, "y": 0.696078},
        {"x": 3071, "y": 0.833333}]}}]}]})");
    const auto a = presets::importSlicerPreset(text), b = presets::importSlicerPreset(json);
    EXPECT_EQ(a.preset.look, b.preset.look);
    EXPECT_EQ(a.largestError, b.largestError);
    EXPECT_EQ(b.preset.name, "bone");
    // A step of 0.69 is steeper than any curve of eight points; away from it the fit is near: the
    // window begins so far below that a weight of 2 reaches the opacity.
    EXPECT_GT(a.largestError, 0.1);
    EXPECT_LT(a.largestError, 0.6);
    const auto &window = *a.preset.window;
    EXPECT_LT(window.low, 0.0);
    for (const double value : {1000.0, 2000.0, 3000.0}) {
        const double f = (value - window.low) / (window.high - window.low);
        const double opacity =
            0.696078 + (0.833333 - 0.696078) * (value - 214.389) / (3071 - 214.389);
        EXPECT_NEAR(f * a.preset.look.transferFunction.at(f), opacity, 0.1);
    }
    EXPECT_LE(presets::importSlicerPreset(text, 16).largestError, a.largestError + 0.02);
}

TEST_F(SlicerPreset, OtherFilesAreRefusedWithTheReason) {
    EXPECT_EQ(reasonOf(write("a.vp", "1\n1\n")), "line 3: the file ends before its scalar opacity");
    EXPECT_EQ(reasonOf(write("b.vp", std::string(head) + "8 0 0 1\n")),
              "line 7: 8 values are declared, but only 2 are present");
    EXPECT_EQ(reasonOf(write("c.vp", std::string(head) + "999999999 0 0\n")).rfind("line 7: ", 0),
              0U);
    EXPECT_NE(reasonOf(write("d.vp", std::string(head) + "4 0 0 1 1e308\n")).find("not between"),
              std::string::npos);
    EXPECT_NE(reasonOf(write("e.vp", std::string(head) + "4 0 0 9 0\n")).find("0 everywhere"),
              std::string::npos);
    EXPECT_NE(reasonOf(write("f.vp.json", "{}")).find("not a 3D Slicer volume property"),
              std::string::npos);
    EXPECT_NE(reasonOf(write("g.vp.json", "[[[")).find("not a 3D Slicer volume property"),
              std::string::npos);
    EXPECT_NE(reasonOf(write("h.vp.json", R"({"volumeProperties": [{"components": [
        {"scalarOpacity": {"points": [{"x": "a", "y": 0}]}}]}]})"))
                  .find("not a 3D Slicer volume property"),
              std::string::npos);
    EXPECT_NE(reasonOf(write("i.vp", std::string(std::size_t(10) << 20, '1'))).find("larger"),
              std::string::npos);
    EXPECT_EQ(reasonOf(folder / "absent.vp"), "does not exist");
}

} // namespace
} // namespace pellucid
