// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/plan/render_plan.h"

namespace pellucid::accuracy {

/// The fields of a plan as coarse blocks, and the aliases that the plan's kernels make
/// of each block.
struct CoarseFields {
    struct Block { ///< a place, whichever fields have a part of it
        glm::dvec3 fromCentreMm{0.0};
        std::array<float, 6> aliases{}; ///< amplitudes along each axis, of the periods -1 and 1
        float inverse = 1.0F;           ///< 1/h^2 of all axes
    };
    struct Part { ///< of a field in a block
        std::uint32_t block = 0;
        float mass = 0.0F, energy = 0.0F;
    };

    volume::Lattice lattice;
    std::array<glm::dvec3, 3> periodsMm{}; ///< of the aliases
    /// What the moment kernels of a linear cue leave, see plan::AxisError::moment.
    std::array<double, 3> moments{};
    std::vector<Block> blocks;             ///< of all fields, each once
    std::vector<std::vector<Part>> fields; ///< of each field, the blocks that are not empty
    std::vector<std::shared_ptr<const plan::EnergySpread>> spreads; ///< by field
    double kernelEnergy = 1.0;                                      ///< integral H^2 of all axes
    double rounding = 0.0;      ///< of a cell as it is stored, relative
    double depthRadiusMm = 1.0; ///< the R of a depth cue
    double blockMm = 1.0;       ///< the longest side of a block
};

/// *Shape*: one summary for each field of the plan.
CoarseFields coarseFields(const plan::RenderPlan &plan,
                          std::span<const plan::FieldSummary> summaries);

} // namespace pellucid::accuracy
