// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <QObject>

#include "ui/engine/look_preparer.h"
#include "ui/engine/shown_engine.h"

namespace pellucid::ui {

class Document;
class GraphicsCard;
class JobRunner;

/// Stands between those who make engines and those who show them: an engine is shown at once, on
/// the processor, and again when its spectra have been copied to the graphics card, which is a job
/// of its own while no other runs. What is on the card already serves at once: layers with other
/// weights, a look without its light.
class CardCopier : public QObject {
    Q_OBJECT
public:
    CardCopier(Document &document, JobRunner &jobs, GraphicsCard &card, QObject *parent = nullptr);

    void show(const prepare::PreparedEngine &engine, EngineStage stage);

signals:
    void engineReady(const pellucid::ui::ShownEngine &engine, pellucid::ui::EngineStage stage);

private:
    void forget();
    void cardChanged();
    void copyWhenIdle();
    void announce(EngineStage stage);
    /// Of the same picture, which keeps its brightness.
    void announceAgain();
    struct Copied;
    static Copied copyTo(const std::shared_ptr<gpu::FramePasses> &passes,
                         const render::ProjectionEngine &engine, gpu::Fetch fetch,
                         const task::Progress &progress);
    void take(const Copied &copied, const std::shared_ptr<render::ProjectionEngine> &engine,
              const std::shared_ptr<gpu::FramePasses> &passes);
    std::shared_ptr<gpu::GpuEngine> copyOf(const render::EngineParts &parts);

    Document &m_document;
    JobRunner &m_jobs;
    GraphicsCard &m_card;
    struct Current {
        prepare::PreparedEngine engine;
        EngineStage stage = EngineStage::coarse;
    };
    std::optional<Current> m_current;
    /// The last ones first: of a look, and of its layers.
    std::vector<std::shared_ptr<gpu::GpuEngine>> m_copies;
    /// A copy is being made; the current engine's was cancelled or did not fit, for this reason.
    bool m_isCopying = false, m_isGivenUp = false;
    task::Reason m_reason = task::because::copyWasCancelled;
};

} // namespace pellucid::ui
