// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/accuracy/central_rounding.h"
#include "core/plan/render_plan.h"
#include "core/render/cpu_engine.h"

namespace pellucid::accuracy {

/// The predicted error of one picture.
struct PictureError {
    /// The relative L2 error. From 1 on the picture may be nothing but error, as of a part in which
    /// nothing is shown.
    double relative = 0.0;
    bool isWhole = true; ///< nothing of the fields lies beside the picture
};

/// Predicts the error of single pictures from a plan and its fields: it keeps coarse fields and the
/// aliases that the plan's kernels make of each of their blocks.
class ViewErrorModel {
public:
    /// *Shape*: one summary for each field of the plan.
    ViewErrorModel(const plan::RenderPlan &plan, std::span<const plan::FieldSummary> fields);

    /// The error of a picture that an engine of the plan made, with cue and light, with the
    /// energies and the ghosts as they are seen from there, in the window that it has. For a whole
    /// picture of one field a channel it is never more than the plan's bound, which is for whole
    /// pictures only.
    PictureError errorOf(const picture::ProjectionImage &picture, const scene::Camera &camera,
                         const scene::ImageDefinition &image, const render::EngineParts &engine,
                         const shading::Shading &shading) const;

private:
    struct Block {
        glm::dvec3 fromCentreMm{0.0};
        std::array<float, 6> ghosts{}; ///< amplitudes along each axis, of the periods -1 and 1
        float inverse = 1.0F;          ///< 1/h^2 of all axes
    };
    struct Part { ///< of a field in a block
        std::uint32_t block = 0;
        float mass = 0.0F, energy = 0.0F;
    };
    /// The weights of a field's mass and energy in a channel.
    struct Weight {
        double mass = 0.0, energy = 0.0;
        bool isGradient = false;
    };
    /// Energies of one channel, in the picture's units.
    struct Energies {
        double image = 0.0, error = 0.0;
        bool isWhole = true; ///< nothing of the field lies beside the picture
    };
    Energies channelEnergies(const picture::ProjectionImage &picture, int channel,
                             const scene::Camera &camera, const scene::ImageDefinition &image,
                             const plan::SliceGrid &grid, std::span<const Weight> weights,
                             const CentralEnergies &central, const shading::Shading &shading) const;

    volume::Lattice m_lattice;
    std::array<glm::dvec3, 3> m_periods{}; ///< of the ghosts, mm
    /// What the moment kernels of a linear cue leave, see plan::AxisError::moment.
    std::array<double, 3> m_moments{};
    std::vector<Block> m_blocks;
    std::vector<std::vector<Part>> m_fields;
    std::vector<std::shared_ptr<const plan::EnergySpread>> m_spreads;
    plan::SliceRoom m_room;
    double m_kernelEnergy = 1.0, m_rounding = 0.0, m_bound = 0.0, m_depthRadiusMm = 1.0,
           m_blockMm = 1.0;
};

} // namespace pellucid::accuracy
