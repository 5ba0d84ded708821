// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/scene/image_definition.h"
#include "core/widths/block_energies.h"
#include "core/widths/width_map.h"

namespace pellucid::widths {

/// A spectrum that a slice is read from, and how it enters the picture: a slice at an offset, whose
/// energy is multiplied by roughly factor + sum_d perSine[d] sin^2 2 pi q_d, q in cycles per
/// sample.
struct SliceSource {
    const BlockEnergies *energies = nullptr;
    std::array<double, 3> offset{};  ///< *Units*: cells
    double factor = 0.0;             ///< *Units*: squared weight
    std::array<double, 3> perSine{}; ///< by axis
};

/// A bound on the squared reconstruction factor along one axis, at a frequency and beyond.
class FactorBounds {
public:
    explicit FactorBounds(const scene::ImageDefinition &image);
    /// *Units*: cycles per sample.
    double beyond(double cycles) const;

private:
    std::vector<float> m_bounds;
};

/// The approximate mean energy of the picture's frequencies in each tile, without roll-off, detail
/// and linear cue; the energies of sources add up as if their phases were independent. *Shape*: as
/// `SliceTiles::at`; 0 beyond the band. *Units*: of the spectrum squared.
std::vector<float> tileEnergies(const SlicePlane &plane, const SliceTiles &tiles,
                                std::span<const SliceSource> sources, const FactorBounds &factors,
                                const ForEach &forEach);

} // namespace pellucid::widths
