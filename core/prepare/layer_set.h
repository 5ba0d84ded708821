// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/prepare/prepared_engine.h"

namespace pellucid::prepare {

/// The layers of a look, each with its own spectrum, shown with any weights and colors at once.
/// Projection is linear, which is used in two ways. While the view does not move, the projections
/// of the layers are kept: a change of weights costs a sum over the pixels, but no slice and no
/// transform. While both change, one slice is the sum of the layers' slices, and each channel is
/// transformed once. If the weights do not change, one spectrum of the sum is enough: that is a
/// PreparedEngine.
class LayerSet {
public:
    /// Makes the field of a layer.
    using FieldOf = std::function<classify::DensityField(std::size_t, const task::Progress &)>;

    /// Fields of more than 2^25 samples are reduced until they are smaller, and further until all
    /// spectra fit the budget, because layers must render at interactive speed. `scale`: that of
    /// the volume, if the fields come from a coarser one. *Throws* Error{outOfMemory} if 32 samples
    /// a side do not fit, Cancelled.
    static std::shared_ptr<LayerSet>
    prepare(const scene::Scene &scene, std::size_t count, const FieldOf &fieldOf,
            const plan::Budget &budget, const task::Progress &progress = {},
            const std::optional<shading::ShadingScale> &scale = std::nullopt);

    /// The plan of every layer, without the loss of detail from reduction; its error is that of the
    /// worst layer.
    const plan::RenderPlan &plan() const { return m_plan; }
    /// The number of original samples per sample along each axis; 1: not reduced.
    int reduction() const { return m_reduction; }
    std::size_t count() const { return m_engine->fieldCount(); }
    std::size_t bytes() const { return m_engine->bytes(); }

    /// Not thread-safe. Layers are not lit, because light is not linear in them: the length of the
    /// gradient of a sum is not the sum of the gradients' lengths. *Shape*: `channelWeights` has
    /// one entry per layer. *Throws* Error{outOfMemory}.
    picture::ProjectionImage render(const scene::Camera &camera,
                                    const scene::ImageDefinition &image,
                                    const shading::Shading &shading,
                                    const std::vector<render::ChannelWeights> &channelWeights,
                                    picture::FrameTimes *times = nullptr);

    task::Reason description() const { return m_engine->description(); }
    /// See `render::CpuEngine::periodOf`.
    scene::Camera periodOf(const scene::Camera &camera, const scene::ImageDefinition &image) {
        return m_engine->periodOf(camera, image);
    }
    /// The engine parts with these channel weights. Thread-safe.
    render::EngineParts parts(const std::vector<render::ChannelWeights> &channelWeights) const;

private:
    LayerSet(std::shared_ptr<render::CpuEngine> engine, plan::RenderPlan plan, int reduction);
    void keep(std::size_t layer);
    picture::ProjectionImage
    sumKept(const std::vector<render::ChannelWeights> &channelWeights) const;

    std::shared_ptr<render::CpuEngine> m_engine;
    plan::RenderPlan m_plan;
    int m_reduction;
    /// The view of the last frame, and the projections of the layers that it needed.
    struct Kept {
        scene::Camera camera;
        scene::ImageDefinition image;
        shading::Shading shading;
        std::vector<picture::Samples> projections;
    };
    std::optional<Kept> m_kept;
};

/// Layers with fixed channel weights, as an engine.
class MixtureEngine final : public render::ProjectionEngine {
public:
    MixtureEngine(std::shared_ptr<LayerSet> layers,
                  std::vector<render::ChannelWeights> channelWeights);
    task::Reason description() const override;
    picture::ProjectionImage render(const scene::Camera &camera,
                                    const scene::ImageDefinition &image,
                                    const shading::Shading &shading = {},
                                    picture::FrameTimes *times = nullptr) override;
    render::EngineParts parts() const override { return m_layers->parts(m_channelWeights); }

protected:
    scene::Camera periodOf(const scene::Camera &camera,
                           const scene::ImageDefinition &image) override {
        return m_layers->periodOf(camera, image);
    }

private:
    std::shared_ptr<LayerSet> m_layers;
    std::vector<render::ChannelWeights> m_channelWeights;
};

} // namespace pellucid::prepare
