// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <string>

#include "core/fourier/spectrum.h"
#include "core/render/error_prediction.h"
#include "core/render/scene.h"

namespace pellucid::render {

/// What the planner needs to know of a field.
struct FieldSummary {
    volume::Lattice lattice;
    volume::VoxelBox support;
    EnergyMarginals energy;
};

FieldSummary summarise(const classify::DensityField &field);

/// The memory that a plan may ask for, bytes.
struct Budget {
    std::size_t bytes = std::numeric_limits<std::size_t>::max();
};

/// The frequency grid of one image: columns x rows frequencies, 1/(columns pixel) apart, so that
/// the periodic image they make holds the whole projection beside the asked-for part.
struct SliceGrid {
    int columns = 2, rows = 2;
    bool operator==(const SliceGrid &) const = default;
};

/// What the slice grid makes room for.
struct SliceRoom {
    /// How far the field reaches from the centre of the lattice: what lies beyond is zero.
    double radiusMm = 0.0;
    /// Room for the tails of the roll-off, in units of what a tolerance of 1e-3 needs.
    double tails = 1.0;
};

/// The room that any field within a box needs.
SliceRoom roomOfBox(const volume::Lattice &lattice, const volume::VoxelBox &box);

/// Says how an image of a scene is computed, what it costs and how far from the exact integral it
/// will be. Pure: made and tested without rendering.
struct RenderPlan {
    fourier::SpectrumLayout spectrum;
    ImageDefinition image;
    SliceRoom room;
    /// Relative L2 error of the image, predicted from the field.
    double predictedError = 0.0;
    /// Largest error of a pixel over the largest pixel, predicted, see predictMaximum.
    double predictedMaximum = 0.0;
    /// Most bytes held at once by the spectrum, its preparation and the frames of the planned
    /// camera.
    std::size_t bytes = 0;
    /// Why it is this one, a line for the user.
    std::string reason;
};

/// The cheapest kernel, padding of each axis, storage and slice grid whose predicted error is
/// within the scene's tolerance; if none is, or none of those fits the budget, the most accurate
/// that fits. What the scene's `interpolation` fixes stays fixed.
/// *Throws* Error{outOfMemory} if nothing fits the budget, Error{usage} if the scene is invalid.
RenderPlan planRender(const Scene &scene, const FieldSummary &field, const Budget &budget = {});

/// The slice grid for a camera: wide enough that no part of the projection, seen from any
/// direction, wraps into the image.
SliceGrid sliceGrid(const Camera &camera, const SliceRoom &room, const volume::Lattice &lattice,
                    const ImageDefinition &image);

} // namespace pellucid::render
