// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/cli/card_choice.h"
#include "app/cli/commands.h"
#include "core/classify/shown_fields.h"
#include "core/picture/exposure.h"
#include "core/prepare/prepared_engine.h"
#include "core/scene/scene.h"
#include "core/segment/segment_set.h"

namespace pellucid::cli {

/// A volume, for its pictures, and where it came from, for errors.
struct Subject {
    volume::Volume volume;
    std::shared_ptr<const segment::SegmentSet> segments; ///< null if none are loaded
    std::filesystem::path path;
};

/// The memory that pictures may take.
struct MemoryLimit {
    /// Bytes, the volume included; none: what the system has.
    std::optional<std::uint64_t> bytes;
    /// Whether the user has given them, so that errors name them.
    bool isGiven = false;
    /// Whether what is planned depends on them. If not, a plan that needs more is refused.
    /// *Requires*: `bytes`, if not.
    bool decides = true;
};

/// Makes pictures of one scene from any direction, within its tolerance: by an engine on the
/// processor or on the card; a single one from sums along its view; where no plan keeps the
/// tolerance, by the exact reference. Plans again if a part of the volume misses it.
class SceneRenderer {
public:
    /// `pictures`: how many will be made. *Throws* Error{outOfMemory}, naming the path;
    /// Error{noSuchDevice}; Cancelled.
    SceneRenderer(const scene::Scene &scene, Subject subject, int pictures,
                  const MemoryLimit &memory, const CardChoice &card, const Context &context);

    /// *Throws* Error{outOfMemory} if the pictures of a camera need more than the limit, although
    /// those of the scene's camera do not.
    void requireRoomFor(const scene::Camera &camera) const;
    /// Whether the error of a picture is measured, or only bounded.
    enum class Check { none, measure };
    /// If the measured error (of a part, its upper limit) exceeds the tolerance, plans the picture
    /// again, unless the scene sets its plan; if that is not enough, renders it with one kernel for
    /// every frequency. The error is always measured if the fields were reduced to fit the memory.
    /// *Throws* Error{outOfMemory}, Cancelled.
    picture::ProjectionImage image(const scene::Camera &camera, Check check = Check::none);
    /// The scene's own exposure or, measured once, that of the study.
    const scene::Exposure &exposure();

    /// Describes the engine that makes the images, one line.
    std::string description() const;
    /// Why this engine was chosen, one line.
    const std::string &engineReason() const { return m_engineReason; }
    bool isOnCard() const { return m_onCard != nullptr; }
    /// Bytes of the spectra on the card; 0 without a card.
    std::size_t cardBytes() const { return m_onCard ? m_onCard->textures().bytes() : 0; }
    /// Bytes that the plan needs.
    std::size_t bytes() const { return m_prepared->plan.bytes; }
    /// The plan, and the model of the last frame.
    nlohmann::json planJson() const;
    classify::FieldWindow window() const { return m_window; }
    /// Warnings about the whole volume, a line each.
    std::vector<std::string> warnings() const;
    /// Why the pictures show nothing; empty if they do. One of the warnings.
    const std::string &whyEmpty() const { return m_whyEmpty; }
    /// A warning about the last picture; empty if it keeps the tolerance.
    std::string warningOfView() const;
    /// A warning about the pictures so far; empty if they keep the tolerance.
    std::string warningOfViews() const;

    double fieldMs() const { return m_fieldMs; }
    double prepareMs() const { return m_prepareMs; }
    /// Of the last picture.
    const picture::FrameTimes &times() const { return m_times; }

    /// An upper bound on the error of any view of the whole volume, see `prepare::boundOf`.
    std::optional<error::StatedError> bound() const;
    /// The error of the last picture as measured, or the bound.
    const error::StatedError &lastError() const { return m_lastError; }

    /// For all pictures together: the largest measured error, and whether each showed the whole
    /// volume.
    const std::optional<error::StatedError> &largestMeasured() const { return m_measured; }
    bool wereWhole() const { return m_allShown == error::Shown::whole; }

private:
    void makeFields(const MemoryLimit &memory);
    void prepare();
    void useCard();
    int images() const; ///< transforms in a frame
    bool isExact() const { return m_prepared->exact != nullptr; }
    bool boundMeetsTolerance() const;
    std::size_t bytesForLight() const;
    double judgedError() const { return m_lastError.judged(m_shown); }
    bool missesTolerance() const;
    bool mayPlanCloser() const;
    bool planCloser();
    /// An engine, and the same on the card or null.
    struct Makers {
        const prepare::PreparedEngine &prepared;
        std::shared_ptr<gpu::GpuEngine> onCard;
    };
    picture::ProjectionImage make(const scene::Camera &camera, Check check, Makers by);
    picture::ProjectionImage make(const scene::Camera &camera, Check check) {
        return make(camera, check, {*m_prepared, m_onCard});
    }
    picture::ProjectionImage imageOfOneWidth(const scene::Camera &camera, Check check);
    std::optional<picture::ProjectionImage> imageOfCard(const scene::Camera &camera,
                                                        gpu::GpuEngine &card);
    void measure(const scene::Camera &camera, picture::PeriodProjector &maker);
    void takeErrors();
    std::string missedText(double error, error::Shown shown) const;
    const classify::ShownFields &studyFields();

    scene::Scene m_scene;
    scene::Scene m_planned; ///< with a smaller tolerance, if a part of the volume needs one
    Subject m_subject;
    int m_pictures;
    std::optional<std::uint64_t> m_given; ///< bytes
    CardChoice m_card;
    std::string m_engineReason;
    Context m_context;
    task::Progress m_progress;
    classify::FieldWindow m_window;
    std::size_t m_held = 0; ///< bytes of the volume, its fields and their preparation
    classify::ShownFields
        m_fields;           ///< of the study; empty from when an engine takes them until a check
    std::string m_whyEmpty; ///< a warning, or empty
    plan::Budget m_budget;
    std::optional<prepare::PreparedEngine> m_prepared; ///< on the processor
    std::shared_ptr<gpu::GpuEngine> m_onCard;          ///< the same on the card, if used
    double m_fieldMs = 0.0, m_prepareMs = 0.0;
    picture::FrameTimes m_times;
    error::StatedError m_lastError;
    error::Shown m_shown = error::Shown::whole; ///< by the last picture
    double m_viewError = 0.0;
    std::optional<error::StatedError> m_measured;
    error::Shown m_allShown = error::Shown::whole; ///< by each picture
};

} // namespace pellucid::cli
