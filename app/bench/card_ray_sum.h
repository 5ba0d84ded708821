// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "core/scene/camera.h"
#include "core/volume/volume.h"
#include "gpu/frame_passes.h"

namespace pellucid::bench {

/// The peer in space on the card: what a ray caster that only adds takes there, from a 3D texture
/// of 16-bit samples with the card's own trilinear filter, one sample a voxel.
class CardRaySum {
public:
    /// *Shape*: the field is float32, 0..1. *Throws* Error{outOfMemory}, Error{noSuchDevice}.
    CardRaySum(std::shared_ptr<gpu::FramePasses> passes, const volume::Volume &field);
    ~CardRaySum();

    struct Image {
        std::vector<float> samples; ///< *Units*: field times mm
        double cardMs = 0.0;        ///< by the card's clock
    };
    Image render(const scene::Camera &camera, double stepMm);

private:
    struct Place;
    std::shared_ptr<gpu::FramePasses> m_passes;
    volume::Lattice m_lattice;
    gpu::OnDevice<Place> m_place;
};

} // namespace pellucid::bench
