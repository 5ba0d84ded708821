// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/positioner_angles.h"

#include <gtest/gtest.h>

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "core/scene/camera.h"
#include "core/task/error.h"

namespace pellucid::scene {

namespace {

double degrees(double radians) {
    return radians * 180.0 / 3.14159265358979323846;
}

} // namespace

// DICOM's definition: the detector in front of the patient at 0, at the left at +90, above at +90.
TEST(PositionerAngles, AreThoseOfTheStandardViews) {
    const struct {
        StandardView view;
        PositionerAngles angles;
    } views[] = {{StandardView::front, {0, 0}}, {StandardView::back, {180, 0}},
                 {StandardView::left, {90, 0}}, {StandardView::right, {-90, 0}},
                 {StandardView::top, {0, 90}},  {StandardView::bottom, {0, -90}}};
    for (const auto &[view, angles] : views) {
        const PositionerAngles found = positionerAngles(viewOrientation(view));
        EXPECT_NEAR(found.primaryDeg, angles.primaryDeg, 1e-6);
        EXPECT_NEAR(found.secondaryDeg, angles.secondaryDeg, 1e-6);
    }
}

// The detector is where the definition puts it: turned to the patient's left (+x), then up (+z).
TEST(PositionerAngles, PlaceTheDetector) {
    for (double primary = -175.0; primary <= 180.0; primary += 17.0)
        for (double secondary = -85.0; secondary <= 85.0; secondary += 17.0) {
            const glm::dmat3 axes = glm::mat3_cast(orientationOf({primary, secondary}));
            const glm::dvec3 toDetector = axes[2];
            EXPECT_NEAR(degrees(std::asin(toDetector.z)), secondary, 1e-9);
            EXPECT_NEAR(degrees(std::atan2(toDetector.x, -toDetector.y)), primary, 1e-9);
            EXPECT_NEAR(axes[0].z, 0.0, 1e-12); // upright
            EXPECT_GE(axes[1].z, 0.0);
            const PositionerAngles found = positionerAngles(orientationOf({primary, secondary}));
            EXPECT_NEAR(found.primaryDeg, primary, 1e-6);
            EXPECT_NEAR(found.secondaryDeg, secondary, 1e-6);
            // A roll changes neither.
            const glm::dquat rolled =
                orientationOf({primary, secondary}) * glm::angleAxis(0.7, glm::dvec3(0, 0, 1));
            EXPECT_NEAR(positionerAngles(rolled).primaryDeg, primary, 1e-6);
        }
}

TEST(PositionerAngles, AreReadAndWritten) {
    const struct {
        const char *text;
        PositionerAngles angles;
        const char *written;
    } cases[] = {{"LAO30,CRA20", {30, 20}, "LAO 30 CRA 20"},
                 {"rao 12.4 cau 5", {-12.4, -5}, "RAO 12 CAU 5"},
                 {"CRA30", {0, 30}, "CRA 30"},
                 {"caudal 30; LAO=45", {45, -30}, "LAO 45 CAU 30"},
                 {"AP", {0, 0}, "AP"},
                 {"PA", {180, 0}, "PA"},
                 {"PA CRA 20", {180, 20}, "PA CRA 20"},
                 {"RAO180", {180, 0}, "PA"}};
    for (const auto &c : cases) {
        const PositionerAngles found = positionerAnglesFromText(c.text);
        EXPECT_EQ(found, c.angles) << c.text;
        EXPECT_EQ(positionerText(found), c.written);
    }
    for (const char *const bad : {"", "30", "LAO", "LAO 30 RAO 20", "LAO 200", "CRA 91", "LAO -5",
                                  "LAO nan", "LAO 30 XYZ 2", "AP LAO 3"})
        EXPECT_THROW(positionerAnglesFromText(bad), task::Error) << bad;
    for (const NamedAngles &named : commonAngles)
        EXPECT_EQ(positionerAnglesFromText(positionerText(named.angles)), named.angles);
}

} // namespace pellucid::scene
