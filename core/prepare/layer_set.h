// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/prepare/prepared_engine.h"

namespace pellucid::prepare {

/// The layers of a look with a spectrum each, shown with any weights and colours at once.
/// Projecting is linear, which is used in two ways: while the view stands still the projections of
/// the layers are kept, and a change of weights costs a sum over the pixels, no slice and no
/// transform; while both move, one slice is the sum of the layers' slices and each channel is
/// transformed once. The third, one spectrum of the sum while the weights stand still, is a
/// PreparedEngine.
class LayerSet {
public:
    /// What makes the field of a layer.
    using FieldOf = std::function<classify::DensityField(std::size_t, const task::Progress &)>;

    /// Fields of more than 2^25 samples are halved until they are smaller, and further until all
    /// spectra fit the budget: the layers serve the moving hand. `scale`: of the volume, if the
    /// fields are of a coarser one. *Throws* Error{outOfMemory} if 32
    /// samples a side do not fit, Cancelled.
    static std::shared_ptr<LayerSet>
    prepare(const scene::Scene &scene, std::size_t count, const FieldOf &fieldOf,
            const plan::Budget &budget, const task::Progress &progress = {},
            const std::optional<shading::ShadingScale> &scale = std::nullopt);

    /// What holds for each layer alone, without what joining samples lost: the error is that of the
    /// worst.
    const plan::RenderPlan &plan() const { return m_plan; }
    /// How many samples an axis are one here; 1: none were joined.
    int reduction() const { return m_reduction; }
    /// Tells the error of pictures of the layers that are held, and what joining samples lost, if
    /// any were joined.
    const std::shared_ptr<const accuracy::ViewErrorModel> &viewError() const { return m_viewError; }
    const std::shared_ptr<const accuracy::DetailLoss> &detailLoss() const { return m_detailLoss; }
    std::size_t count() const { return m_engine->fieldCount(); }
    std::size_t bytes() const { return m_engine->bytes(); }

    /// Not safe to call from two threads at once. Lights do not shine on layers, which light is not
    /// linear in: the gradient of a sum is not as long as the sum of the gradients. *Shape*:
    /// shares, one each layer. *Throws* Error{outOfMemory}.
    picture::ProjectionImage render(const scene::Camera &camera,
                                    const scene::ImageDefinition &image,
                                    const shading::Shading &shading,
                                    const std::vector<render::ChannelShares> &shares,
                                    picture::FrameTimes *times = nullptr);

    task::Reason description() const { return m_engine->description(); }
    /// With these shares; from any thread.
    render::EngineParts parts(const std::vector<render::ChannelShares> &shares) const;

private:
    LayerSet(std::shared_ptr<render::CpuEngine> engine, plan::RenderPlan plan, int reduction,
             std::shared_ptr<const accuracy::ViewErrorModel> viewError,
             std::shared_ptr<const accuracy::DetailLoss> detailLoss);
    void keep(std::size_t layer);
    picture::ProjectionImage sumOfKept(const std::vector<render::ChannelShares> &shares) const;

    std::shared_ptr<render::CpuEngine> m_engine;
    plan::RenderPlan m_plan;
    int m_reduction;
    std::shared_ptr<const accuracy::ViewErrorModel> m_viewError;
    std::shared_ptr<const accuracy::DetailLoss> m_detailLoss;
    /// The view of the last frame, and the projections of the layers in it, those that were needed.
    struct Kept {
        scene::Camera camera;
        scene::ImageDefinition image;
        shading::Shading shading;
        std::vector<std::vector<float>> projections;
    };
    std::optional<Kept> m_kept;
};

/// Layers with their shares, as an engine.
class MixtureEngine final : public render::ProjectionEngine {
public:
    MixtureEngine(std::shared_ptr<LayerSet> layers, std::vector<render::ChannelShares> shares);
    task::Reason description() const override;
    picture::ProjectionImage render(const scene::Camera &camera,
                                    const scene::ImageDefinition &image,
                                    const shading::Shading &shading = {},
                                    picture::FrameTimes *times = nullptr) override;
    render::EngineParts parts() const override { return m_layers->parts(m_shares); }

private:
    std::shared_ptr<LayerSet> m_layers;
    std::vector<render::ChannelShares> m_shares;
};

} // namespace pellucid::prepare
