// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/plan/render_plan.h"

namespace pellucid::accuracy {

/// The fields of a plan as coarse blocks, with the amplitudes of each block's aliases under the
/// plan's kernels.
struct CoarseFields {
    struct Block { ///< one place; any field may have a part in it
        glm::dvec3 fromCentreMm{0.0};
        std::array<float, 6> aliases{};   ///< of the aliases along each axis, in periods -1 and 1
        std::array<float, 3> halfSteps{}; ///< from the middle to the outer samples, by axis
        float inverse = 1.0F;             ///< 1/h^2, the product over the axes
    };
    struct Part { ///< the part of a field in a block
        std::uint32_t block = 0;
        float mass = 0.0F, energy = 0.0F;
    };

    volume::Lattice lattice;
    std::array<glm::dvec3, 3> periodsMm{}; ///< offsets of the aliases
    /// The error of a linear cue's moment kernels, see plan::AxisError::moment.
    std::array<double, 3> moments{};
    std::vector<Block> blocks;             ///< of all fields, each block once
    std::vector<std::vector<Part>> fields; ///< the nonempty blocks of each field
    std::vector<std::shared_ptr<const plan::EnergySpread>> spreads; ///< by field
    double kernelEnergy = 1.0; ///< integral H^2, the product over the axes
    double rounding = 0.0;     ///< relative error of a stored cell
    /// How the energy of rounding is distributed along each axis: shares at even steps from one
    /// period before the middle of the box to one after it. They follow h^2, as all errors of cells
    /// do.
    std::array<std::vector<double>, 3> roundingShares;
    double depthRadiusMm = 1.0; ///< the R of a depth cue
    double blockMm = 1.0;       ///< the longest side of a block
};

/// *Shape*: one summary for each field of the plan.
CoarseFields coarseFields(const plan::RenderPlan &plan,
                          std::span<const plan::FieldSummary> summaries);

} // namespace pellucid::accuracy
