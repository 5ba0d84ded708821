// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/scene.h"

#include <cmath>

#include "core/scene/reasons.h"
#include "core/task/error.h"

namespace pellucid::scene {

namespace {

namespace because = task::because;

void require(bool holds, const task::Reason &what) {
    if (!holds)
        throw task::Error(task::ErrorCode::usage, what);
}

} // namespace

void validate(const Exposure &exposure) {
    const auto isShare = [](double value) { return value >= 0.0 && value <= 1.0; };
    require(isShare(exposure.detail) && isShare(exposure.latitude), because::contrastOutOfRange);
    require(std::isfinite(exposure.fineMm) && exposure.fineMm > 0.0,
            because::exposureIsNotPlausible);
    for (const glm::dvec3 &corner : {exposure.lowMm, exposure.highMm})
        for (int n = 0; n < 3; ++n)
            require(std::abs(corner[n]) <= 1e6, because::exposureIsNotPlausible);
    for (const Exposure::Axis &axis : exposure.axes)
        require(std::isfinite(axis.air) && axis.bright > axis.dark && axis.bright > 0.0 &&
                    axis.air < axis.bright && axis.high > axis.low && axis.exponent >= 0.1 &&
                    axis.exponent <= 10.0,
                because::exposureIsNotPlausible);
}

void validate(const Scene &scene) {
    const Camera &camera = scene.camera;
    require(camera.width >= 1 && camera.height >= 1 && camera.width <= largestImageSize &&
                camera.height <= largestImageSize,
            because::imageSizeOutOfRange(largestImageSize));
    require(std::isfinite(camera.pixelMm) && camera.pixelMm > 0.0, because::pixelMustBePositive);
    require(std::isfinite(camera.panMm.x) && std::isfinite(camera.panMm.y),
            because::panMustBeFinite);
    const double norm = glm::dot(camera.orientation, camera.orientation);
    require(std::isfinite(norm) && norm > 1e-12, because::orientationIsZero);
    require(scene.image.rollOff >= 0.0 && scene.image.rollOff <= 1.0, because::rollOffOutOfRange);
    require(scene.image.detail >= 0.0 && scene.image.detail <= maxDetail &&
                scene.image.detailMm >= 0.01 && scene.image.detailMm <= 20.0,
            because::detailOutOfRange);
    require(std::isfinite(scene.tolerance) && scene.tolerance > 0.0,
            because::toleranceMustBePositive);
    const auto &padding = scene.interpolation.padding;
    require(!padding || (*padding >= 1.0 && *padding <= 4.0), because::paddingOutOfRange);
    if (scene.fieldWindow)
        require(std::isfinite(scene.fieldWindow->low) && std::isfinite(scene.fieldWindow->high) &&
                    scene.fieldWindow->low < scene.fieldWindow->high,
                because::windowIsEmpty);
    for (const auto &share : {scene.tone.detail, scene.tone.latitude})
        require(!share || (*share >= 0.0 && *share <= 1.0), because::contrastOutOfRange);
    if (scene.tone.exposure)
        validate(*scene.tone.exposure);
    classify::validate(scene.look);
    classify::validate(scene.crop);
    shading::validate(scene.shading);
}

} // namespace pellucid::scene
