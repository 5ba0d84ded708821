// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/projection_matrix.h"

#include <gtest/gtest.h>

#include <random>

#include "core/scene/positioner_angles.h"
#include "core/task/error.h"

namespace pellucid::scene {

namespace {

const volume::Lattice lattice =
    volume::Lattice::make({40, 50, 30}, {{-120.0, 35.0, 410.0}},
                          {glm::dvec3(0.8, 0.0, 0.0), {0.0, 0.7, 0.2}, {0.0, -0.3, 2.0}});

Camera oblique() {
    Camera camera;
    camera.orientation = viewOrientation(StandardView::left, {33.0, -12.0, 71.0});
    camera.pixelMm = 0.45;
    camera.width = 301;
    camera.height = 200;
    camera.panMm = {13.7, -4.2};
    return camera;
}

glm::dvec2 projected(const ProjectionMatrix &p, const glm::dvec3 &mm) {
    const auto row = [&](int n) {
        return p[n][0] * mm.x + p[n][1] * mm.y + p[n][2] * mm.z + p[n][3];
    };
    return glm::dvec2(row(0), row(1)) / row(2);
}

std::string faultOf(const std::string &text) {
    try {
        viewListFromJson(text);
    } catch (const task::Error &error) {
        return error.reason().english();
    }
    return "it is read";
}

} // namespace

TEST(ProjectionMatrix, TakesPointsToTheirPixels) {
    const Camera camera = oblique();
    const ProjectionMatrix matrix = projectionMatrix(camera, lattice);
    const glm::dmat3 axes = camera.axes();
    // What the camera looks at is in the middle of the picture.
    const glm::dvec3 middle =
        lattice.center().mm + camera.panMm.x * axes[0] + camera.panMm.y * axes[1];
    EXPECT_NEAR(projected(matrix, middle).x, 150.0, 1e-9);
    EXPECT_NEAR(projected(matrix, middle).y, 99.5, 1e-9);
    // To the right and down by pixels, and not at all along the line of sight.
    const glm::dvec3 moved =
        middle + camera.pixelMm * (3.0 * axes[0] - 5.0 * axes[1]) + 77.0 * axes[2];
    EXPECT_NEAR(projected(matrix, moved).x, 153.0, 1e-9);
    EXPECT_NEAR(projected(matrix, moved).y, 104.5, 1e-9);
}

TEST(ProjectionMatrix, GivesItsCameraBack) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int n = 0; n < 200; ++n) {
        Camera camera = oblique();
        camera.orientation =
            glm::normalize(glm::dquat(any(random), any(random), any(random), any(random)));
        camera.panMm = {100.0 * any(random), 100.0 * any(random)};
        ProjectionMatrix matrix = projectionMatrix(camera, lattice);
        const double scale = n % 2 == 0 ? 1.0 : -3.5; // homogeneous
        for (auto &row : matrix)
            for (double &value : row)
                value *= scale;
        const Camera back = cameraOf(matrix, camera.width, camera.height, lattice);
        EXPECT_NEAR(std::abs(glm::dot(back.orientation, camera.orientation)), 1.0, 1e-12);
        EXPECT_NEAR(back.pixelMm, camera.pixelMm, 1e-12);
        EXPECT_NEAR(back.panMm.x, camera.panMm.x, 1e-9);
        EXPECT_NEAR(back.panMm.y, camera.panMm.y, 1e-9);
    }
}

TEST(ProjectionMatrix, RefusesWhatIsNoParallelProjectionOnSquarePixels) {
    const ProjectionMatrix good = projectionMatrix(oblique(), lattice);
    const auto refuses = [&](const std::function<void(ProjectionMatrix &)> &spoil) {
        ProjectionMatrix bad = good;
        spoil(bad);
        EXPECT_THROW(cameraOf(bad, 10, 10, lattice), task::Error);
    };
    refuses([](ProjectionMatrix &m) { m[2][0] = 1e-3; }); // perspective
    refuses([](ProjectionMatrix &m) { m[2][3] = 0.0; });
    refuses([](ProjectionMatrix &m) { m[0] = m[1]; });
    refuses([](ProjectionMatrix &m) { m[0] = {}; });
    refuses([](ProjectionMatrix &m) {
        for (double &value : m[0])
            value *= 1.01; // pixels are not square
    });
    refuses([](ProjectionMatrix &m) {
        for (int n = 0; n < 4; ++n)
            m[0][n] += 0.01 * m[1][n]; // sheared
    });
    refuses([](ProjectionMatrix &m) { m[1][2] = std::nan(""); });
}

TEST(ViewList, ReadsMatricesAndAngles) {
    const ViewList list = viewListFromJson(R"({"size": [64, 48], "pixel_mm": 0.5, "views": [
        "RAO30,CRA20", {"primary_deg": -30, "secondary_deg": 20, "roll_deg": 0},
        {"matrix": [[2, 0, 0, 10], [0, 0, -2, 20], [0, 0, 0, 1]]}]})");
    ASSERT_EQ(list.views.size(), 3U);
    EXPECT_EQ(list.views[0].orientation, orientationOf({-30.0, 20.0}));
    EXPECT_NEAR(std::abs(glm::dot(*list.views[1].orientation, *list.views[0].orientation)), 1.0,
                1e-12);
    Camera base;
    base.width = (*list.size)[0];
    base.height = (*list.size)[1];
    const Camera front = cameraOf(list.views[2], base, lattice);
    EXPECT_NEAR(front.pixelMm, 0.5, 1e-12);
    EXPECT_NEAR(front.axes()[0].x, 1.0, 1e-12);
    EXPECT_NEAR(front.axes()[1].z, 1.0, 1e-12);
}

TEST(ViewList, FaultsAreNamedWithTheirLines) {
    const std::pair<const char *, const char *> faults[] = {
        {"{\"views\": [\n\"RAO\"]}", "line 2: /views/0"},
        {"{\"views\": [{\"primary\": 5}]}", "/views/0/primary"},
        {"{\"views\": [{\"secondary_deg\": 5}]}", "has no primary_deg"},
        {"{\"views\": [{\"primary_deg\": 5, \"secondary_deg\": 91}]}", "out of range"},
        {"{\"views\": []}", "must not be empty"},
        {"[]", "must be an object"},
        {"{\"size\": [4, 4], \"views\": [{\"matrix\": [[1,0,0,0],[0,1,0,0]]}]}", "three rows"},
        {"{\"size\": [4, 4], \"views\": [{\"matrix\": [[1,0,0,0],[0,1,0,0],[0,0,1,1]]}]}",
         "parallel projection"},
        {"{\"size\": [4, 4], \"views\": [{\"matrix\": [[1,0,0,0],[0,2,0,0],[0,0,0,1]]}]}",
         "square pixels"},
        {"{\"views\": [{\"matrix\": [[1,0,0,0],[0,1,0,0],[0,0,0,1]]}]}", "needs a size"},
        {"{\"size\": [4, 4], \"views\": [{\"matrix\": [[1,0,0,0],[0,1,0,0],[0,0,0,1]]},\n"
         "{\"matrix\": [[2,0,0,0],[0,2,0,0],[0,0,0,1]]}]}",
         "line 2: /views/1"}};
    for (const auto &[text, part] : faults)
        EXPECT_NE(faultOf(text).find(part), std::string::npos) << text << "\n" << faultOf(text);
}

} // namespace pellucid::scene
