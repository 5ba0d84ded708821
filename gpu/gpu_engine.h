// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/plan/render_plan.h"
#include "core/render/frame_inputs.h"
#include "gpu/spectrum_textures.h"

namespace pellucid::gpu {

class GpuEngine;

/// Copies an engine to the card. *Throws* as SpectrumTextures::upload.
std::shared_ptr<GpuEngine> copyToCard(std::shared_ptr<FramePasses> passes,
                                      const render::ProjectionEngine &engine,
                                      const task::Progress &progress = {});

/// `CpuEngine` on the card: the same plan, the same cells, and the same picture within 2e-5
/// (relative L2), which stays on the card. Engines that differ only in channel
/// weights share spectra and tables and are cheap to create; only one of them may render at a time.
class GpuEngine final : public render::ProjectionEngine {
public:
    /// *Shape*: `channelWeights` as for CpuEngine::setChannelWeights.
    GpuEngine(std::shared_ptr<const SpectrumTextures> textures,
              std::vector<render::ChannelWeights> channelWeights,
              const plan::FieldOfView &fieldOfView,
              std::shared_ptr<const widths::AdaptiveWidths> widths = nullptr);

    const SpectrumTextures &textures() const { return *m_textures; }
    std::shared_ptr<GpuEngine>
    withChannelWeights(std::vector<render::ChannelWeights> channelWeights) const;
    std::shared_ptr<GpuEngine> withoutLight() const;
    /// With one kernel for every frequency.
    std::shared_ptr<GpuEngine> withOneWidth() const;

    task::Reason description() const override;
    render::EngineParts parts() const override;
    /// Reads the picture back. *Throws* Error{outOfMemory}, Error{noSuchDevice}.
    picture::ProjectionImage render(const scene::Camera &camera,
                                    const scene::ImageDefinition &image,
                                    const shading::Shading &shading = {},
                                    picture::FrameTimes *times = nullptr) override;
    scene::Camera periodOf(const scene::Camera &camera,
                           const scene::ImageDefinition &image) override;
    /// Leaves the picture on the card. *Throws* as render.
    std::shared_ptr<const CardPicture> renderOnCard(const scene::Camera &camera,
                                                    const scene::ImageDefinition &image,
                                                    const shading::Shading &shading = {},
                                                    CardTimes *times = nullptr);

private:
    std::shared_ptr<const SpectrumTextures> m_textures;
    std::vector<render::ChannelWeights> m_channelWeights;
    std::shared_ptr<render::FrameSetup> m_setup; ///< for these spectra with any channel weights
};

} // namespace pellucid::gpu
