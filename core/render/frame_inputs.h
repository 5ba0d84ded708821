// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/render/frame_geometry.h"
#include "core/render/frame_mixing.h"

namespace pellucid::render {

/// What a frame starts from, on the processor and on the card alike.
struct FrameInputs {
    Mixing mixing;
    // Left out where nothing is shown.
    plan::SliceGrid grid;
    FrameGeometry geometry;
    FrameShading shading;
    bool isShaded = false; ///< whether cue or light make the slice another than the sums
    ZeroSums zero{};       ///< of the sums, at frequency 0

    /// Whether nothing is shown: the picture is zero.
    bool isEmpty() const { return mixing.sources.empty(); }
    /// 1 for a grey picture, else 3.
    int pictureChannels() const { return mixing.grey ? 1 : 3; }
    /// What the sums are multiplied by; a single grey image has its share at once.
    double unit() const;
    /// The color of the single image of a colored picture; three images have theirs.
    ChannelShares tint() const;
};

/// Works out what frames start from, and keeps what one view after another has in common: the slice
/// grid of a framing and the moment kernels. *Shape*: for spectra of one layout. Not safe to call
/// from two threads at once.
class FrameSetup {
public:
    explicit FrameSetup(plan::FieldOfView fieldOfView) : m_fieldOfView(std::move(fieldOfView)) {}

    const plan::FieldOfView &fieldOfView() const { return m_fieldOfView; }
    /// Without the spectra of gradients lights are off. *Shape*: the shares are one each field; the
    /// moment kernels that the shading refers to live as long as this. *Throws* Error{outOfMemory}
    /// as `plan::sliceGrid` does.
    FrameInputs inputsFor(const EngineSpectra &spectra, const std::vector<ChannelShares> &shares,
                          const scene::Camera &camera, const scene::ImageDefinition &image,
                          const shading::Shading &shading);

private:
    plan::FieldOfView m_fieldOfView;
    FramedGrid m_framed;
    std::optional<MomentKernels> m_moments; // made for the first frame with a linear cue, in ms
};

} // namespace pellucid::render
