// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/cli/commands.h"
#include "core/classify/shown_fields.h"
#include "core/reference/wide_kernel.h"
#include "core/render/prepared_engine.h"
#include "core/render/view_error.h"
#include "gpu/gpu_engine.h"

namespace pellucid::cli {

/// The graphics card that images are to be made on, if it is one.
struct CardChoice {
    bool isAsked = false;
    std::shared_ptr<gpu::FramePasses> passes; ///< none: the processor makes them
    std::string reason;                       ///< why it is that one, a line
};
/// `engine`: "auto", "cpu" or "gpu". Left to itself the card is taken if it is none of software and
/// there is more than one image to make: a single one is over on the processor before a card has
/// its spectra. *Throws* Error{noSuchDevice} with the reason if the card is asked for and there is
/// none.
CardChoice chooseCard(const std::string &engine, int frames);

/// Images of one scene within a tolerance: by the engine, or by the exact reference where no plan
/// keeps the tolerance, unless the memory is short or the scene fixes the interpolation.
class Renderer {
public:
    /// The scene and the fields must outlive it. *Throws* Error{outOfMemory}, Cancelled.
    Renderer(const render::Scene &scene, const classify::ShownFields &fields,
             const render::Budget &budget, const Context &context);

    /// Makes the images on the card. *Throws* Error{noSuchDevice}, Error{outOfMemory} with the
    /// reason if it was asked for and cannot be used.
    void use(const CardChoice &card);
    /// Why it is that engine, a line.
    const std::string &engineReason() const { return m_choice.reason; }
    bool isOnCard() const { return m_card != nullptr; }
    /// Of the spectra on the card.
    std::size_t cardBytes() const { return m_card ? m_card->textures().bytes() : 0; }

    /// `times`: of this image, all channels.
    render::ProjectionImage image(const render::Camera &camera, render::FrameTimes &times);

    /// What makes the images, one line.
    std::string description() const;
    nlohmann::json planJson() const;
    std::size_t channelCount() const { return m_channels; }
    std::size_t bytes() const { return m_bytes; }
    bool isReduced() const { return m_fitting.reduction > 1; }
    const std::string &reason() const { return m_fitting.plan.reason; }
    /// Of every view of the whole, at most: the worst channel's; the picture's, all channels taken
    /// together, is no larger.
    double predictedError() const { return m_predictedError; }
    /// Of the last picture, as it is seen and cropped.
    double lastViewError() const { return m_viewError.value_or(m_predictedError); }
    /// Of the engine only: the reference's lies below what a float image holds.
    std::optional<double> predictedMaximum() const;

private:
    Renderer(const render::Scene &scene, const classify::ShownFields &fields,
             const render::ShadedFields &shaded, const render::Budget &budget,
             const Context &context);
    Renderer(const render::Scene &scene, const classify::ShownFields &fields,
             const render::ShadedFields &shaded, const std::vector<render::FieldSummary> &summaries,
             const render::Budget &budget, const Context &context);
    render::ProjectionImage exactImage(const render::Camera &camera) const;
    void judge(const render::ProjectionImage &image, const render::Camera &camera);

    const render::Scene &m_scene;
    const classify::ShownFields &m_fields;
    task::Progress m_progress;
    std::size_t m_channels, m_bytes = 0;
    bool m_isGrey;
    render::FittingPlan m_fitting;
    volume::Lattice m_lattice; ///< of what is rendered
    double m_predictedError = 0.0;
    std::optional<double> m_viewError;
    std::optional<render::ViewErrorModel> m_viewModel; ///< of the engine
    std::shared_ptr<render::CpuEngine> m_engine;
    std::shared_ptr<gpu::GpuEngine> m_card; ///< its twin, if that is used
    CardChoice m_choice;
    /// One each channel, in place of an engine; made for every image where each is shaded anew.
    std::vector<reference::WideKernel> m_references;
};

} // namespace pellucid::cli
