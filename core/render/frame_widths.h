// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <utility>
#include <vector>

#include "core/fourier/spectrum.h"
#include "core/fourier/transforms/strip_transform.h"
#include "core/scene/image_definition.h"
#include "core/widths/adaptive_widths.h"
#include "core/widths/tile_energies.h"

namespace pellucid::render {

struct FrameInputs;

/// Chooses the widths that read a frame. It reads a few lines of the slice by every width, as
/// frames do, with cue and light. It keeps what successive frames share. Not thread-safe.
class FrameWidths {
public:
    /// *Requires*: everything in `inputs` but `widthMap` is set. `spectrum`: any of the frame's.
    /// *Throws* std::bad_alloc.
    widths::WidthMap choose(const widths::AdaptiveWidths &adaptive, const FrameInputs &inputs,
                            const fourier::Spectrum &spectrum, const scene::ImageDefinition &image,
                            const widths::ForEach &forEach);

private:
    std::optional<std::pair<scene::ImageDefinition, widths::FactorBounds>> m_factors;
    struct alignas(64) Strip {
        std::array<float, fourier::stripLanes> columns;
    };
    std::vector<Strip> m_columnPhase;
    std::vector<std::complex<float>> m_rowPhase;
};

} // namespace pellucid::render
