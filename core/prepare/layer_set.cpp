// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/prepare/layer_set.h"

#include <algorithm>
#include <cmath>
#include <new>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/classify/coarse_field.h"
#include "core/prepare/reasons.h"
#include "core/render/frame_job.h"
#include "core/scene/planning_scene.h"
#include "core/task/error.h"

namespace pellucid::prepare {

namespace {

constexpr std::size_t maxSamples = std::size_t(1) << 25;
constexpr render::ChannelWeights none{0.0, 0.0, 0.0};

// The least reduction of so many fields to `maxSamples` and to this many bytes.
int minReduction(const volume::GridSize &size, std::size_t count, std::size_t bytes) {
    const std::size_t most = std::min(maxSamples, bytes / sizeof(float) / count);
    int reduction = 1;
    while (classify::coarseSide(size, reduction + 1) > 0 &&
           classify::coarseSize(size, classify::coarseSide(size, reduction)).count() > most)
        ++reduction;
    return reduction;
}

} // namespace

LayerSet::LayerSet(std::shared_ptr<render::CpuEngine> engine, plan::RenderPlan plan, int reduction)
    : m_engine(std::move(engine)), m_plan(std::move(plan)), m_reduction(reduction) {}

std::shared_ptr<LayerSet> LayerSet::prepare(const scene::Scene &scene, std::size_t count,
                                            const FieldOf &fieldOf, const plan::Budget &budget,
                                            const task::Progress &progress,
                                            const std::optional<shading::ShadingScale> &given) {
    ShadedFields layers;
    scene::Scene uniform;
    int reduction = 1;
    std::size_t taken = 0;
    for (std::size_t n = 0; n < count; ++n) {
        classify::DensityField field = fieldOf(
            n, progress.part(0.5 * double(n) / double(count), 0.5 * double(n + 1) / double(count)));
        const volume::GridSize size = field.values.lattice().size();
        if (n == 0) {
            layers.scale = given.value_or(shading::shadingScale(field.values.lattice()));
            uniform = scene::planningScene(scene, field.values.lattice());
            // Projections of layers are kept and summed: they must not depend on the weights.
            uniform.interpolation.isUniform = true;
            uniform.shading.lights.clear();
            taken = count * sizeof(float) * std::size_t(uniform.camera.width) *
                    std::size_t(uniform.camera.height);
            // The fields leave as much memory for their spectra.
            reduction =
                minReduction(size, count, (budget.bytes - std::min(budget.bytes, taken)) / 2);
        }
        if (reduction > 1)
            field = classify::coarseField(field, classify::coarseSide(size, reduction));
        taken += field.values.samples().bytes();
        layers.fields.push_back(std::move(field));
    }
    FittingPlan fitting =
        planWithin(uniform, std::move(layers), {render::FrameJob::maxImages, 1},
                   {budget.bytes - std::min(budget.bytes, taken)}, progress.part(0.5, 1.0));
    auto engine = std::make_shared<render::CpuEngine>(
        spectraOf(std::move(fitting.fields), fitting.plan, progress.part(0.5, 1.0)),
        fitting.plan.fieldOfView);
    return std::shared_ptr<LayerSet>(
        new LayerSet(std::move(engine), std::move(fitting.plan), reduction * fitting.reduction));
}

void LayerSet::keep(std::size_t layer) {
    std::vector<render::ChannelWeights> alone(count(), none);
    alone[layer] = {1.0, 1.0, 1.0};
    m_engine->setChannelWeights(std::move(alone));
    m_kept->projections[layer] =
        std::move(m_engine->render(m_kept->camera, m_kept->image, m_kept->shading).samples);
}

picture::ProjectionImage
LayerSet::sumKept(const std::vector<render::ChannelWeights> &channelWeights) const {
    const scene::Camera &camera = m_kept->camera;
    picture::ProjectionImage image{
        camera.width, camera.height, camera.pixelMm, {}, render::areGrey(channelWeights) ? 1 : 3};
    const auto channels = std::size_t(image.channels);
    const std::size_t pixels = std::size_t(camera.width) * camera.height;
    image.samples.resize(pixels * channels);
    // A block of sums fits in the first-level cache.
    constexpr std::size_t block = 1024;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, (pixels + block - 1) / block, 16),
                      [&](const tbb::blocked_range<std::size_t> &range) {
                          std::array<std::array<float, block>, render::FrameJob::maxImages> sums;
                          for (std::size_t b = range.begin(); b != range.end(); ++b) {
                              const std::size_t first = b * block,
                                                size = std::min(block, pixels - first);
                              for (std::size_t c = 0; c < channels; ++c)
                                  sums[c].fill(0.0F);
                              for (std::size_t n = 0; n < channelWeights.size(); ++n)
                                  for (std::size_t c = 0; c < channels; ++c) {
                                      const auto share = float(channelWeights[n][c]);
                                      if (share == 0.0F)
                                          continue;
                                      const float *const from =
                                          m_kept->projections[n].data() + first;
                                      float *const to = sums[c].data();
                                      for (std::size_t p = 0; p < size; ++p)
                                          to[p] += share * from[p];
                                  }
                              float *const to = image.samples.data() + first * channels;
                              for (std::size_t p = 0; p < size; ++p)
                                  for (std::size_t c = 0; c < channels; ++c)
                                      to[p * channels + c] = sums[c][p];
                          }
                      });
    return image;
}

picture::ProjectionImage LayerSet::render(const scene::Camera &camera,
                                          const scene::ImageDefinition &image,
                                          const shading::Shading &shading,
                                          const std::vector<render::ChannelWeights> &channelWeights,
                                          picture::FrameTimes *times) {
    const bool sameView =
        m_kept && m_kept->camera == camera && m_kept->image == image && m_kept->shading == shading;
    if (!sameView) {
        // While the view moves, kept projections would not be reused.
        m_kept = Kept{camera, image, shading, std::vector<picture::Samples>(count())};
        m_engine->setChannelWeights(channelWeights);
        return m_engine->render(camera, image, shading, times);
    }
    const double start = render::frameClockSeconds();
    try {
        for (std::size_t n = 0; n < channelWeights.size(); ++n)
            if (channelWeights[n] != none && m_kept->projections[n].empty())
                keep(n);
        picture::ProjectionImage sum = sumKept(channelWeights);
        if (times != nullptr)
            *times = {1e3 * (render::frameClockSeconds() - start), 0.0};
        return sum;
    } catch (const std::bad_alloc &) {
        m_kept.reset();
        throw task::Error(task::ErrorCode::outOfMemory, task::because::noMemoryToKeepLayers);
    }
}

render::EngineParts
LayerSet::parts(const std::vector<render::ChannelWeights> &channelWeights) const {
    return {m_engine->spectra(), channelWeights, m_engine->fieldOfView()};
}

MixtureEngine::MixtureEngine(std::shared_ptr<LayerSet> layers,
                             std::vector<render::ChannelWeights> channelWeights)
    : m_layers(std::move(layers)), m_channelWeights(std::move(channelWeights)) {}

task::Reason MixtureEngine::description() const {
    return m_layers->description();
}

picture::ProjectionImage MixtureEngine::render(const scene::Camera &camera,
                                               const scene::ImageDefinition &image,
                                               const shading::Shading &shading,
                                               picture::FrameTimes *times) {
    return m_layers->render(camera, image, shading, m_channelWeights, times);
}

} // namespace pellucid::prepare
