// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/picture/projection_image.h"
#include "core/scene/camera.h"
#include "core/scene/image_definition.h"
#include "core/shading/shading.h"
#include "core/task/reason.h"

namespace pellucid::picture {

/// Makes projections of the fields that it was made for: an engine that slices their spectra
/// (`render::ProjectionEngine`), or the exact reference (`reference::ExactEngine`), which has none
/// to share.
class Projector {
public:
    virtual ~Projector() = default;
    /// What makes the projections and what it runs on, one line.
    virtual task::Reason description() const = 0;
    /// Not safe to call from two threads at once. Lights shine only on what was prepared for them.
    /// *Throws* Error{outOfMemory}; Cancelled, if it was made with a progress that is cancelled.
    virtual ProjectionImage render(const scene::Camera &camera, const scene::ImageDefinition &image,
                                   const shading::Shading &shading = {},
                                   FrameTimes *times = nullptr) = 0;
};

} // namespace pellucid::picture
