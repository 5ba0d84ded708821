// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/cli/commands.h"
#include "core/classify/shown_fields.h"
#include "core/picture/exposure.h"
#include "core/prepare/prepared_engine.h"
#include "gpu/gpu_engine.h"

namespace pellucid::cli {

/// Whether to make the images on a graphics card, and on which one.
struct CardChoice {
    bool isRequired = false;                  ///< the user requires the card
    std::shared_ptr<gpu::FramePasses> passes; ///< null: the processor makes the images
    std::string reason;                       ///< why this engine was chosen, one line
};
/// Chooses between processor and graphics card. `engine`: "auto", "cpu" or "gpu". "auto" takes the
/// card if it is not a software renderer and there is more than one image to make: the processor
/// finishes a single image before the spectra have reached the card. *Throws* Error{noSuchDevice}
/// with the reason if "gpu" is requested and there is no card.
CardChoice chooseCard(const std::string &engine, int frames);

/// Renders images of one scene within its tolerance. The engine makes them; where no plan keeps the
/// tolerance, the exact reference does, unless memory is short, the scene fixes the interpolation,
/// or the plan is for the whole volume.
class Renderer {
public:
    /// The scene must outlive it. The fields are released as soon as they are transformed. `limit`:
    /// the most bytes that the plan may need, other than the budget, which decides what is planned.
    /// *Throws* Error{outOfMemory}, Cancelled.
    Renderer(const scene::Scene &scene, classify::ShownFields &&fields, const plan::Budget &budget,
             const Context &context, std::size_t limit = std::numeric_limits<std::size_t>::max());

    /// Makes the images on the card from now on. *Throws* Error{noSuchDevice}, Error{outOfMemory}
    /// with the reason if the user requires the card and it cannot be used.
    void use(const CardChoice &card);
    /// Why this engine was chosen, one line.
    const std::string &engineReason() const { return m_choice.reason; }
    bool isOnCard() const { return m_card != nullptr; }
    /// Bytes of the spectra on the card; 0 without a card.
    std::size_t cardBytes() const { return m_card ? m_card->textures().bytes() : 0; }

    /// *Throws* Error{outOfMemory} if the pictures of a camera need more than the limit, although
    /// those of the scene's camera do not.
    void requireRoomFor(const scene::Camera &camera) const;

    /// `times` receives the times of this image, all channels together.
    picture::ProjectionImage image(const scene::Camera &camera, picture::FrameTimes &times);
    /// Measures the error of the image of a camera against the fields of the study; not of the
    /// exact reference, which nothing here is more exact than. *Throws* Error{outOfMemory},
    /// Cancelled.
    void measure(const scene::Camera &camera, const classify::ShownFields &study);

    /// The exposure of the scene's study, for its contrast.
    scene::Exposure exposure(picture::Background background) const {
        return picture::measureExposure(*m_engine, m_lattice, m_scene.image, m_scene.shading,
                                        m_scene.tone, background);
    }

    /// Describes the engine that makes the images, one line.
    std::string description() const;
    /// `last`: the times of the last image.
    nlohmann::json planJson(const picture::FrameTimes &last) const;
    std::size_t bytes() const { return m_bytes; }
    bool isReduced() const { return m_fitting.reduction > 1; }
    /// Whether the exact reference makes the pictures.
    bool isExact() const { return m_planned == nullptr; }
    std::string reason() const { return m_fitting.plan.reason.english(); }
    /// An upper bound on the error of any view of the whole volume.
    double predictedError() const { return m_predictedError; }
    /// The error of the last image as measured, or the bound until `measure` has run.
    const error::StatedError &lastError() const { return m_lastError; }
    /// Whether the last image showed all of the fields.
    bool wasWhole() const { return m_wasWhole; }

private:
    // The fields, and what is made from them for cue and light.
    struct Sources {
        classify::ShownFields fields;
        prepare::ShadedFields shaded;
        std::vector<plan::FieldSummary> summaries;
    };
    static Sources sourcesOf(const scene::Scene &scene, classify::ShownFields fields,
                             const task::Progress &progress);
    Renderer(const scene::Scene &scene, Sources sources, const plan::Budget &budget,
             const Context &context, std::size_t limit);
    void prepareExact(Sources sources, std::size_t bytes);
    void preparePlanned(Sources sources);
    std::optional<picture::ProjectionImage> imageOfCard(const scene::Camera &camera,
                                                        picture::FrameTimes &times);

    const scene::Scene &m_scene;
    task::Progress m_progress;
    std::size_t m_images, m_bytes = 0, m_limit;
    prepare::FittingPlan m_fitting;
    volume::Lattice m_lattice; ///< of the rendered fields
    volume::VoxelBox m_box;    ///< of their samples that a whole picture shows
    double m_predictedError = 0.0;
    error::StatedError m_lastError;
    bool m_wasWhole = true;
    std::shared_ptr<picture::Projector> m_engine;        ///< on the processor
    std::shared_ptr<render::ProjectionEngine> m_planned; ///< the same, unless it is exact
    std::shared_ptr<gpu::GpuEngine> m_card;              ///< the same on the card, if used
    CardChoice m_choice;
};

} // namespace pellucid::cli
