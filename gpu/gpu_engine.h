// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/render/frame_geometry.h"
#include "gpu/spectrum_textures.h"

namespace pellucid::gpu {

/// How the cells of a plan are read, and what that leaves of its error.
struct FetchPlan {
    Fetch fetch = Fetch::exact;
    double predictedError = 0.0;
};

/// The filtered fetches where a plan has room for what their coarse weights leave, else exact ones.
/// Cards weigh with 8 fraction bits, which are wrong by 2^-8/sqrt(12) on average, times the
/// difference of two neighbouring cells: relative to the image by the root of the mean of 4
/// sin^2(pi x), x the distance from the wrap voxel in periods, for each axis and each pair of taps
/// by its weight. Kernels with negative taps cannot be paired; with cue or light all fetches are
/// exact.
FetchPlan planFetch(const render::RenderPlan &plan, double tolerance,
                    const shading::Shading &shading = {});

class GpuEngine;

/// The engine's twin on the card. *Throws* as SpectrumTextures::upload.
std::shared_ptr<GpuEngine> copyToCard(std::shared_ptr<FramePasses> passes,
                                      const render::ProjectionEngine &engine,
                                      Fetch fetch = Fetch::exact,
                                      const task::Progress &progress = {});

/// What `CpuEngine` does, on the card: the same plan, the same cells, the same picture within 2e-5
/// (relative L2, exact fetches), and it stays there. Cheap to make: spectra are shared.
class GpuEngine final : public render::ProjectionEngine {
public:
    /// *Shape*: shares as of CpuEngine::setShares.
    GpuEngine(std::shared_ptr<const SpectrumTextures> textures,
              std::vector<render::ChannelShares> shares, const render::SliceRoom &room,
              Fetch fetch = Fetch::exact);

    const SpectrumTextures &textures() const { return *m_textures; }
    std::shared_ptr<GpuEngine> withShares(std::vector<render::ChannelShares> shares) const;
    std::shared_ptr<GpuEngine> withoutLight() const;

    std::string description() const override;
    render::EngineParts parts() const override;
    /// Reads the picture back. *Throws* Error{outOfMemory}, Error{noSuchDevice}.
    render::ProjectionImage render(const render::Camera &camera,
                                   const render::ImageDefinition &image,
                                   const shading::Shading &shading = {},
                                   render::FrameTimes *times = nullptr) override;
    /// Leaves it on the card. Cue and light take exact fetches. *Throws* as render.
    std::shared_ptr<const CardPicture> renderOnCard(const render::Camera &camera,
                                                    const render::ImageDefinition &image,
                                                    const shading::Shading &shading = {},
                                                    CardTimes *times = nullptr);

private:
    std::shared_ptr<const SpectrumTextures> m_textures;
    std::vector<render::ChannelShares> m_shares;
    render::SliceRoom m_room;
    Fetch m_fetch;
    render::FramedGrid m_framed;
    std::optional<render::MomentKernels> m_moments;
};

} // namespace pellucid::gpu
