// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <glm/gtc/constants.hpp>

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

Camera defaultCamera(const volume::Lattice &lattice) {
    Camera camera;
    camera.orientation = viewOrientation(StandardView::front);
    camera.pixelMm = lattice.shortestStepMm();
    const double pixels = 2.0 * lattice.radiusMm() / camera.pixelMm;
    if (pixels > largestImageSize)
        throw task::Error(task::ErrorCode::usage,
                          task::because::volumeNeedsALargerImage(largestImageSize));
    // Without this margin, rounding could push an exact integer to the next even size.
    const int size = int(std::ceil(pixels - 1e-6));
    camera.width = camera.height = std::max(2, size + size % 2);
    return camera;
}

} // namespace pellucid::scene
