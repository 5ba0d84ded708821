// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/scene.h"

#include <cmath>

#include <fmt/format.h>

#include "core/task/error.h"

namespace pellucid::scene {

namespace {

void require(bool holds, const std::string &what) {
    if (!holds)
        throw task::Error(task::ErrorCode::usage, what);
}

} // namespace

void validate(const Scene &scene) {
    const Camera &camera = scene.camera;
    require(camera.width >= 1 && camera.height >= 1 && camera.width <= largestImageSize &&
                camera.height <= largestImageSize,
            fmt::format("the image size must be 1 to {} pixels a side", largestImageSize));
    require(std::isfinite(camera.pixelMm) && camera.pixelMm > 0.0,
            "the pixel must be a positive length");
    require(std::isfinite(camera.panMm.x) && std::isfinite(camera.panMm.y),
            "the pan must be finite");
    const double norm = glm::dot(camera.orientation, camera.orientation);
    require(std::isfinite(norm) && norm > 1e-12, "the orientation must not be zero");
    require(scene.image.rollOff >= 0.0 && scene.image.rollOff <= 1.0,
            "the roll-off must be within 0 to 1");
    require(std::isfinite(scene.tolerance) && scene.tolerance > 0.0,
            "the tolerance must be positive");
    const auto &padding = scene.interpolation.padding;
    require(!padding || (*padding >= 1.0 && *padding <= 4.0), "the padding must be within 1 to 4");
    if (scene.fieldWindow)
        require(std::isfinite(scene.fieldWindow->low) && std::isfinite(scene.fieldWindow->high) &&
                    scene.fieldWindow->low < scene.fieldWindow->high,
                "the window's low end must lie below its high end");
    classify::validate(scene.look);
    classify::validate(scene.crop);
    shading::validate(scene.shading);
}

} // namespace pellucid::scene
