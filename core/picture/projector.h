// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "core/picture/projection_image.h"
#include "core/scene/camera.h"
#include "core/scene/image_definition.h"
#include "core/shading/shading.h"
#include "core/task/reason.h"

namespace pellucid::picture {

/// A picture on the whole period of its slice's grid: what `Projector::render` shows a part of.
struct PeriodPicture {
    ProjectionImage image;
    scene::Camera camera; ///< whose picture it is
    /// The first column and row that `Projector::render` shows, and their numbers.
    int left = 0, top = 0, width = 0, height = 0;
    /// The size of the picture of `Projector::render`. Pixels beyond a period repeat others.
    int pictureWidth = width, pictureHeight = height;

    /// The camera of the picture of `Projector::render`.
    scene::Camera shownCamera() const {
        scene::Camera shown = camera;
        shown.width = pictureWidth;
        shown.height = pictureHeight;
        return shown;
    }
};

/// Makes projections of its fields: an engine that slices their spectra
/// (`render::ProjectionEngine`), that sums their samples along the view (`render::SumEngine`),
/// or the exact reference (`reference::ExactEngine`).
class Projector {
public:
    virtual ~Projector() = default;
    /// One line: the method, and the device it runs on.
    virtual task::Reason description() const = 0;
    /// Not thread-safe. Lights are drawn only if the fields were prepared for them. *Throws*
    /// Error{outOfMemory}; Cancelled, if the progress that it was made with is cancelled.
    virtual ProjectionImage render(const scene::Camera &camera, const scene::ImageDefinition &image,
                                   const shading::Shading &shading = {},
                                   FrameTimes *times = nullptr) = 0;
};

/// A projector that can also render the whole period of a picture, which measuring the error needs.
class PeriodProjector : public Projector {
public:
    /// The whole period of the picture of a camera: the same slice, and the same pixels where both
    /// have them. *Throws*, not thread-safe: as `render`.
    PeriodPicture renderPeriod(const scene::Camera &camera, const scene::ImageDefinition &image,
                               const shading::Shading &shading = {}) {
        const scene::Camera whole = periodOf(camera, image);
        const int width = std::min(camera.width, whole.width),
                  height = std::min(camera.height, whole.height);
        return {render(whole, image, shading),
                whole,
                (whole.width - width) / 2,
                (whole.height - height) / 2,
                width,
                height,
                camera.width,
                camera.height};
    }

protected:
    /// The camera of the whole period. The next picture, if it is of that camera, has the same
    /// grid.
    virtual scene::Camera periodOf(const scene::Camera &camera,
                                   const scene::ImageDefinition &image) = 0;
};

} // namespace pellucid::picture
