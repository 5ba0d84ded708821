// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <QObject>

#include "ui/engine/look_preparer.h"
#include "ui/engine/reasons.h"
#include "ui/engine/shown_engine.h"

namespace pellucid::ui {

class Document;
class GraphicsCard;
class JobRunner;
struct Outcome;

/// Passes engines on to be shown: at once on the processor, and again when their spectra have been
/// copied to the graphics card. Copying is a job that waits until no other runs. Spectra that are
/// on the card already are used at once: layers with other weights, a look without its light.
class CardCopier : public QObject {
    Q_OBJECT
public:
    CardCopier(Document &document, JobRunner &jobs, GraphicsCard &card, QObject *parent = nullptr);
    ~CardCopier() override;

    void show(const prepare::PreparedEngine &engine, EngineStage stage);

signals:
    void engineReady(const pellucid::ui::ShownEngine &engine, pellucid::ui::EngineStage stage);

private:
    void forget();
    void cardChanged();
    void copyWhenIdle();
    void copyEnded(const Outcome &outcome);
    /// Leaves the engine on the processor until another is shown or the card changes.
    void giveUp(const task::Reason &reason);
    void announce(EngineStage stage);
    /// Announces an engine of the same picture, which keeps its brightness.
    void announceAgain();
    struct Copied;
    static Copied copyTo(const std::shared_ptr<gpu::FramePasses> &passes,
                         const render::ProjectionEngine &engine, const task::Progress &progress);
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
    /// The latest first: a look and its layers.
    std::vector<std::shared_ptr<gpu::GpuEngine>> m_copies;
    enum class Copying { no, underway, wasCancelled } m_copying = Copying::no;
    bool m_isGivenUp = false; ///< the current engine is not copied, for `m_reason`
    task::Reason m_reason = task::because::copyWasCancelled;
};

} // namespace pellucid::ui
