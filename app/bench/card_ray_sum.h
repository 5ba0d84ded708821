// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "core/picture/projection_image.h"
#include "core/scene/camera.h"
#include "core/volume/field.h"
#include "gpu/frame_passes.h"

namespace pellucid::bench {

/// A ray sum on the card, for comparison: it reads a 3D texture of 16-bit samples through the
/// card's trilinear filter, every `stepMm`, and only adds.
class CardRaySum {
public:
    /// *Units*: the field is 0..1. *Throws* Error{outOfMemory}, Error{noSuchDevice}.
    CardRaySum(std::shared_ptr<gpu::FramePasses> passes, const volume::Field &field);
    ~CardRaySum();

    struct Image {
        picture::Samples samples; ///< *Units*: field times mm
        double cardMs = 0.0;      ///< card time
    };
    Image render(const scene::Camera &camera, double stepMm);

private:
    struct Resources;
    std::shared_ptr<gpu::FramePasses> m_passes;
    volume::Lattice m_lattice;
    gpu::OnDevice<Resources> m_resources;
};

} // namespace pellucid::bench
