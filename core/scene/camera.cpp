// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vector_relational.hpp>

#include "core/scene/reasons.h"
#include "core/task/error.h"

namespace pellucid::scene {

glm::dquat viewOrientation(StandardView view, const ViewAngles &angles) {
    ViewAngles total = angles;
    switch (view) {
    case StandardView::front:
        break;
    case StandardView::back:
        total.azimuthDeg += 180.0;
        break;
    case StandardView::left:
        total.azimuthDeg += 90.0;
        break;
    case StandardView::right:
        total.azimuthDeg -= 90.0;
        break;
    case StandardView::top:
        total.elevationDeg += 90.0;
        break;
    case StandardView::bottom:
        total.elevationDeg -= 90.0;
        break;
    }
    const glm::dvec3 x(1, 0, 0), z(0, 0, 1);
    return glm::angleAxis(glm::radians(total.azimuthDeg), z) *
           glm::angleAxis(glm::radians(90.0 - total.elevationDeg), x) *
           glm::angleAxis(glm::radians(total.rollDeg), z);
}

std::string patientLetters(const glm::dvec3 &direction) {
    struct Side {
        double strength;
        char letter;
    };
    std::array<Side, 3> sides{Side{std::abs(direction.x), direction.x > 0 ? 'L' : 'R'},
                              Side{std::abs(direction.y), direction.y > 0 ? 'P' : 'A'},
                              Side{std::abs(direction.z), direction.z > 0 ? 'S' : 'I'}};
    std::stable_sort(sides.begin(), sides.end(),
                     [](const Side &a, const Side &b) { return a.strength > b.strength; });
    std::string letters(1, sides[0].letter);
    // Scanners print a second letter from 15 degrees on.
    if (sides[1].strength > 0.26)
        letters += sides[1].letter;
    return letters;
}

std::string dicomOrientation(const glm::dvec3 &right, const glm::dvec3 &up) {
    std::string letters = patientLetters(right) + "\\" + patientLetters(-up);
    std::replace(letters.begin(), letters.end(), 'S', 'H');
    std::replace(letters.begin(), letters.end(), 'I', 'F');
    return letters;
}

ProjectedBox projectBox(const glm::dvec3 &lowMm, const glm::dvec3 &highMm,
                        const glm::dquat &orientation) {
    const glm::dmat3 axes = glm::mat3_cast(orientation);
    const glm::dvec3 half = 0.5 * (highMm - lowMm), middle = 0.5 * (highMm + lowMm);
    const auto along = [&](int axis) -> glm::dvec2 {
        return {glm::dot(axes[axis], middle), glm::dot(glm::abs(axes[axis]), half)};
    };
    const glm::dvec2 u = along(0), v = along(1);
    return {{u.x, v.x}, {u.y, v.y}};
}

glm::dquat turnedAboutLongAxis(const glm::dquat &orientation, double degrees) {
    return glm::angleAxis(glm::radians(degrees), glm::dvec3(0, 0, 1)) * orientation;
}

Camera defaultCamera(const volume::Lattice &lattice) {
    Camera camera;
    camera.orientation = viewOrientation(StandardView::front);
    camera.pixelMm = lattice.shortestStepMm();
    const double pixels = 2.0 * lattice.radiusMm() / camera.pixelMm;
    if (pixels > largestImageSize)
        throw task::Error(task::ErrorCode::usage,
                          task::because::volumeNeedsALargerImage(
                              largestImageSize, fmt::format("{:.3g}", camera.pixelMm)));
    camera.width = camera.height = evenPixels(pixels);
    return camera;
}

Camera withPixelsAtLeast(Camera camera, double pixelMm) {
    const double factor = std::max(1.0, pixelMm / camera.pixelMm);
    camera.width = std::max(1, int(std::lround(camera.width / factor)));
    camera.height = std::max(1, int(std::lround(camera.height / factor)));
    camera.pixelMm *= factor;
    return camera;
}

int evenPixels(double pixels) {
    // Without this margin, rounding could push an exact integer to the next even size.
    const int size = int(std::ceil(pixels - 1e-6));
    return std::max(2, size + size % 2);
}

void fitToBox(std::span<Camera> cameras, const glm::dvec3 &lowMm, const glm::dvec3 &highMm,
              FitBy by) {
    constexpr double shareOfPicture = 0.93, maxZoom = 8.0; // frames grow with its square
    if (!glm::all(glm::lessThan(lowMm, highMm)))
        return;
    glm::dvec2 halfMm(0.0);
    for (Camera &camera : cameras) {
        const ProjectedBox box = projectBox(lowMm, highMm, camera.orientation);
        camera.panMm = box.middleMm;
        halfMm = glm::max(halfMm, box.halfMm);
    }
    const glm::dvec2 roomMm = 2.0 / shareOfPicture * halfMm;
    for (Camera &camera : cameras) {
        if (by == FitBy::pixel) {
            camera.pixelMm = std::max(
                {roomMm.x / camera.width, roomMm.y / camera.height, camera.pixelMm / maxZoom});
        } else {
            camera.width = std::min(camera.width, evenPixels(roomMm.x / camera.pixelMm));
            camera.height = std::min(camera.height, evenPixels(roomMm.y / camera.pixelMm));
        }
    }
}

} // namespace pellucid::scene
