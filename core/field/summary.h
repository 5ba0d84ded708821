// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/classify/density_field.h"
#include "core/field/energy_marginals.h"
#include "core/field/slab_products.h"

namespace pellucid::field {

/// What the planner needs to know about a field.
struct Summary {
    volume::Lattice lattice;
    volume::VoxelBox support;
    EnergyMarginals energy;
    /// For linear cues; without it the field is treated as noise.
    std::optional<std::array<SlabProducts, 3>> slabs;
    /// The R of a depth cue; the lattice's own radius if absent.
    std::optional<double> depthRadiusMm;
};

/// The box that encloses the fields.
volume::VoxelBox boxOf(std::span<const classify::DensityField> fields);

/// The summary of a field in the box of its support.
Summary summarise(const classify::DensityField &field);
/// Summaries of fields on one lattice that share a plan, each in the box that encloses all of them.
std::vector<Summary> summarise(std::span<const classify::DensityField> fields);

} // namespace pellucid::field
