// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include <QObject>
#include <QTimer>

#include "core/classify/layers.h"
#include "core/prepare/layer_set.h"

namespace pellucid::preprocess {
class StepCache;
}

namespace pellucid::ui {

class Document;
class Job;
class JobRunner;

/// How far an engine is from what is wanted: a first, small picture; the parts of a look summed
/// while its weights move; the sum itself, after they came to rest; or another thing altogether.
enum class EngineStage { coarse, live, settled, full };

/// Whether the engine in use is made for what the scene asks for: it is, that one is being made, it
/// was cancelled, or it could not be made.
enum class PlanState { holds, underway, cancelled, failed };

/// What of a scene an engine is made for; the rest changes from frame to frame.
struct PreparedFor {
    PreparedFor() = default;
    explicit PreparedFor(const Document &document);
    /// Of a volume that is not open yet: the window only if the scene names one.
    explicit PreparedFor(const scene::Scene &scene);
    std::optional<classify::FieldWindow> window; ///< none: the volume's own
    classify::Look look;
    classify::CropBox crop;
    double tolerance = 0.0;
    scene::Interpolation interpolation;
    scene::ImageDefinition image;
    /// The cue that the error is planned for: as strong as it is, or a little stronger, so that not
    /// every touch asks for a new plan.
    shading::DepthCue cue;
    bool isLit = false;
    bool operator==(const PreparedFor &) const = default;

    /// Whether only weights, colours and control points differ: the layers are the same.
    bool hasLayersOf(const PreparedFor &other) const;
    /// Whether only cue, light and what lies between samples differ, which are seen with any
    /// engine.
    bool showsSameAs(const PreparedFor &other) const;
};

/// Makes the engines of the projection, as jobs, and follows the scene with them. While weights and
/// colours move, the layers of the look are summed; when they rest, one engine is made of the sum.
class LookPreparer : public QObject {
    Q_OBJECT
public:
    LookPreparer(Document &document, JobRunner &jobs, QObject *parent = nullptr);
    ~LookPreparer() override;

    /// Prepares the projection that the document's scene asks for, unless it is there or on its
    /// way, even if that was cancelled or failed before.
    void prepareAgain();
    /// Nothing is prepared while the studies are scanned.
    void setHeld(bool held) { m_held = held; }
    bool isHeld() const { return m_held; }

    /// A new volume comes: what was made is forgotten. What its engine will be made for.
    PreparedFor forgetVolume();
    /// What the last full engine was made for, and the engine, if there is one.
    const std::optional<PreparedFor> &preparedFor() const { return m_prepared; }
    const std::optional<prepare::PreparedEngine> &fullEngine() const { return m_full; }
    /// Shows an engine that was made before.
    void adopt(const PreparedFor &preparedFor, const prepare::PreparedEngine &engine);
    /// Tells everything anew, to a window that has just been made.
    void announce();
    /// The job that was just started, if it could be, makes an engine for it.
    void expect(const PreparedFor &wanted);
    /// What makes engines within a job and hands them over, in the part of its progress beyond
    /// `from`. It needs the preparer itself only where it delivers.
    using Preparation = std::function<void(const Job &job, const volume::Volume &volume)>;
    Preparation preparation(const PreparedFor &wanted, double from, bool coarseFirst);

signals:
    void engineReady(const pellucid::prepare::PreparedEngine &engine,
                     pellucid::ui::EngineStage stage);
    void planChanged(pellucid::ui::PlanState state);

private:
    /// Follows, but what was given up stays so.
    void followScene();
    void settle();
    void stopOwnJob();
    void giveUp();
    void showFull();
    void followWeights(const PreparedFor &wanted);
    void followCueAndLight(const PreparedFor &wanted);
    void startPreparing(bool coarseFirst);
    void startLayers(const PreparedFor &wanted);
    void showLayers();

    Document &m_document;
    JobRunner &m_jobs;
    std::shared_ptr<preprocess::StepCache> m_steps;
    QTimer m_rest;
    bool m_held = false;
    bool m_hasFailed = false; ///< the job that ends now
    /// What was handed over last; none since the volume came.
    std::optional<EngineStage> m_shown;
    /// What the last full engine was made for, what the next one is being made for, and what was
    /// cancelled or failed.
    std::optional<PreparedFor> m_prepared, m_underway, m_givenUp;
    /// The one underway has not shown its first picture yet.
    bool m_coarseToCome = false;
    std::optional<prepare::PreparedEngine> m_full;
    /// The layers that are there, of which look; and those on their way or given up.
    std::shared_ptr<prepare::LayerSet> m_layers;
    bool m_layersAreCoarse = false; ///< of a small volume
    std::optional<PreparedFor> m_layersOf, m_layersUnderway, m_layersGivenUp;
};

} // namespace pellucid::ui
