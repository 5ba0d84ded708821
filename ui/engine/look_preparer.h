// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include <QObject>
#include <QTimer>

#include "core/prepare/layer_set.h"
#include "core/prepare/next_step.h"
#include "ui/jobs/job_runner.h"

namespace pellucid::preprocess {
class StepCache;
}

namespace pellucid::ui {

class Document;

using prepare::EngineStage;
using prepare::PreparedFor;

/// Whether the engine in use is made for what the scene asks for: it is, that engine is being made,
/// was cancelled, or could not be made.
enum class PlanState { holds, underway, cancelled, failed };

/// What an engine has to be made for, for the document's scene.
PreparedFor wantedOf(const Document &document);

/// Makes the engines of the projection, as jobs, whenever the scene changes. While weights and
/// colors move, the layers of the look are summed; when they rest, one engine is made of the sum.
/// `prepare::next` decides what to do and when.
class LookPreparer : public QObject {
    Q_OBJECT
public:
    LookPreparer(Document &document, JobRunner &jobs, QObject *parent = nullptr);
    ~LookPreparer() override;

    /// Prepares the projection that the document's scene asks for, unless it is ready or underway,
    /// even if that was cancelled or failed before.
    void prepareAgain();
    /// Prepares nothing while the job that runs now, such as a scan of studies, or one that follows
    /// it at once is running, and prepares again afterwards: that job may have stopped it.
    void awaitJob();

    /// The results of classes' steps.
    const std::shared_ptr<preprocess::StepCache> &steps() const { return m_steps; }

    /// Forgets the engines, as a new volume comes. Returns what the engine of that is made for.
    PreparedFor forgetVolume();
    /// The last full engine and what it was made for, if there is one.
    const std::optional<PreparedFor> &preparedFor() const { return m_have.full; }
    const std::optional<prepare::PreparedEngine> &fullEngine() const { return m_full; }
    /// Cancels the running job. If it prepared the projection of another look, the scene returns to
    /// the look that is shown, as an edit that can be undone: no picture stays on the screen under
    /// the name of another look.
    void cancel();
    /// Takes over and shows an engine that was made before.
    void adopt(const PreparedFor &preparedFor, const prepare::PreparedEngine &engine);
    /// A function that makes engines within another job and delivers them, in the part of the job's
    /// progress beyond `from`. It refers to the preparer only where it delivers.
    using Preparation = std::function<void(const Job &job, const volume::Volume &volume)>;
    Preparation preparation(const PreparedFor &wanted, double from, prepare::Detail first);
    /// A function that makes and delivers a coarse engine of a part of the volume, of at most
    /// `side` samples along each axis.
    using PartialPreparation = std::function<void(const Job &job, const volume::Volume &volume,
                                                  int side, const task::Progress &progress)>;
    PartialPreparation partialPreparation(const PreparedFor &wanted);
    /// Announces that another job, which runs or is about to start, uses `preparation` to make this
    /// engine. Its `onEnd` has to call `jobEnded`.
    void expect(const PreparedFor &wanted);
    /// An expected job has ended: an engine that it did not deliver counts as given up.
    void jobEnded(const Outcome &outcome);

signals:
    void engineReady(const pellucid::prepare::PreparedEngine &engine,
                     pellucid::ui::EngineStage stage);
    void planChanged(pellucid::ui::PlanState state);

private:
    bool canProject() const;
    /// Decides and acts until there is nothing to do but wait.
    void act(prepare::Occasion occasion);
    void take(prepare::Step step, const PreparedFor &look);
    void start(prepare::Step step, const PreparedFor &wanted);
    void start(prepare::Step step, const PreparedFor &wanted, const QString &title,
               JobRunner::Work work);
    JobRunner::Work layersWork(const PreparedFor &wanted);
    void returnToShown();
    void takeEngine(const PreparedFor &of, const prepare::PreparedEngine &engine,
                    prepare::Detail detail);
    void takeLayers(const PreparedFor &of, const std::shared_ptr<prepare::LayerSet> &layers,
                    prepare::Detail detail);
    void showFull();
    void showLayers();

    Document &m_document;
    JobRunner &m_jobs;
    std::shared_ptr<preprocess::StepCache> m_steps;
    QTimer m_rest; ///< runs while the weights move
    prepare::Have m_have;
    std::optional<prepare::PreparedEngine> m_full;
    shading::Shading m_fullShading; ///< the last one of the look of the full engine
    std::shared_ptr<prepare::LayerSet> m_layers;
    bool m_layersAreCoarse = false; ///< of a small volume
};

} // namespace pellucid::ui
