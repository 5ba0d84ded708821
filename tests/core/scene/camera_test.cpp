// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "core/scene/camera.h"
#include "core/task/error.h"

namespace pellucid {

namespace {

using scene::StandardView;

void expectAxes(StandardView view, glm::dvec3 u, glm::dvec3 v, glm::dvec3 w) {
    const glm::dmat3 axes = glm::mat3_cast(scene::viewOrientation(view));
    EXPECT_LT(glm::distance(axes[0], u) + glm::distance(axes[1], v) + glm::distance(axes[2], w),
              1e-12);
}

// LPS: x to the patient's left, y to the back, z to the head.
TEST(Camera, StandardViewsLookAtThePatientAsNamed) {
    expectAxes(StandardView::front, {1, 0, 0}, {0, 0, 1}, {0, -1, 0});
    expectAxes(StandardView::back, {-1, 0, 0}, {0, 0, 1}, {0, 1, 0});
    expectAxes(StandardView::left, {0, 1, 0}, {0, 0, 1}, {1, 0, 0});
    expectAxes(StandardView::right, {0, -1, 0}, {0, 0, 1}, {-1, 0, 0});
    expectAxes(StandardView::top, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    expectAxes(StandardView::bottom, {1, 0, 0}, {0, -1, 0}, {0, 0, -1});
}

TEST(Camera, RollTurnsTheImageAboutTheLineOfSight) {
    const glm::dmat3 axes =
        glm::mat3_cast(scene::viewOrientation(StandardView::front, {.rollDeg = 90}));
    EXPECT_LT(glm::distance(axes[0], glm::dvec3(0, 0, 1)), 1e-12);
    EXPECT_LT(glm::distance(axes[2], glm::dvec3(0, -1, 0)), 1e-12);
}

TEST(Camera, LettersNameTheSideOfThePatient) {
    EXPECT_EQ(scene::patientLetters({1, 0, 0}), "L");
    EXPECT_EQ(scene::patientLetters({0, -1, 0}), "A");
    EXPECT_EQ(scene::patientLetters(glm::normalize(glm::dvec3(0, 0.5, -1))), "IP");
}

TEST(Camera, TheDefaultImageHoldsEveryView) {
    const auto camera = scene::defaultCamera(volume::Lattice::centred({3, 4, 12}, {2, 2, 2}));
    EXPECT_EQ(camera.pixelMm, 2.0);
    EXPECT_EQ(camera.width, 14); // the diagonal is exactly 13 pixels
    EXPECT_EQ(camera.height, 14);
    EXPECT_THROW(scene::defaultCamera(volume::Lattice::centred({2, 2, 2000}, {0.01, 0.01, 10})),
                 task::Error);
}

} // namespace
} // namespace pellucid
