// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include <QImage>
#include <QObject>
#include <QString>
#include <QTimer>

#include "core/picture/automatic_tone.h"
#include "core/picture/display.h"
#include "core/task/reason.h"
#include "ui/engine/error_meter.h"
#include "ui/engine/look_preparer.h"
#include "ui/engine/reasons.h"
#include "ui/engine/render_worker.h"
#include "ui/engine/shown_engine.h"
#include "ui/views/look_comparison.h"
#include "ui/views/projection_texts.h"

namespace pellucid::ui {

class Document;

/// The frames of a document's projection, which an engine makes in the background: drafts while the
/// view moves and full frames would lag, and a full frame when it rests, whose error is then
/// measured. Keeps their exposure, and the look before the last edit to compare with.
class ProjectionFrames : public QObject {
    Q_OBJECT
public:
    explicit ProjectionFrames(Document &document);

    /// Returns false if this engine already makes the frames.
    bool setEngine(const ShownEngine &shown, EngineStage stage);
    /// Whether the engine is made for what the scene asks for.
    void setPlanState(PlanState state);
    PlanState planState() const { return m_planState; }
    /// The name of the shown look.
    void setLookName(const QString &name) { m_lookName = name; }
    const QString &lookName() const { return m_lookName; }

    /// Asks for a frame of the scene. `moving`: more moves may follow.
    void request(bool moving);
    /// The next frame has another size.
    void resized() { m_isFirstOfKind = true; }
    /// The document has another volume. Returns false if the frame stays on the screen until the
    /// new volume has its own.
    bool forgetVolume();

    /// Adopts the exposure of a study that comes back.
    void adoptExposure();
    /// The next volume is another phase: exposure and frame stay until its own frame comes.
    void holdExposure();
    /// Measures the exposure again with the next frame.
    void retakeExposure();
    const scene::Exposure &exposure() const { return m_tone.exposure(); }
    /// The scene's tone with the exposure.
    scene::Tone shownTone() const;
    /// How the frame is displayed.
    picture::Display display() const;
    /// The range that the exposure gives.
    picture::ToneRange automaticRange() const;

    /// The frame on the screen; null: none.
    const std::shared_ptr<const RenderedFrame> &frame() const { return m_frame; }
    /// What its figures report. There must be a frame.
    DescribedFrame described() const;
    /// What is known of its error, against the study.
    const std::optional<error::StatedError> &error() const { return m_error; }
    /// Whether no better engine is expected.
    bool isFinal() const { return m_stage == EngineStage::full || m_stage == EngineStage::settled; }
    bool showsFinalImage() const { return m_frame && !m_frame->draft && isFinal() && !m_pending; }
    /// Engine and reason, for the status bar.
    QString engineText() const;
    /// The frame as it is displayed; null if there is none. *Throws* Error{noSuchDevice} if the
    /// graphics card that holds it has failed, Error{outOfMemory}.
    QImage picture() const;
    /// A function that renders the present look with any camera, on the processor. It may be called
    /// on any thread while this object exists. It *throws* as the engine.
    std::function<picture::ProjectionImage(const scene::Camera &)> renderer();

    /// Whether each frame also shows the look before the last edit.
    void setComparing(bool isComparing);
    bool isComparing() const { return m_isComparing; }
    struct Compared {
        QImage picture; ///< the middle halves of both, side by side
        QString name;   ///< of the look before
    };
    /// Nothing if the frame has nothing to compare with. *Throws* as `picture`.
    std::optional<Compared> compared() const;

signals:
    /// Of the first frame of a volume the exposure is known, and with it the box of the body. If a
    /// slot moves the view, the frame is dropped.
    void bodyFound();
    /// There is a frame to show.
    void shown();
    void finalShown();
    void errorMeasured(const pellucid::error::StatedError &error);
    void failed(const pellucid::task::Reason &reason);
    /// The graphics card failed; the processor takes over.
    void cardFailed(const pellucid::task::Reason &reason,
                    const std::shared_ptr<pellucid::gpu::FramePasses> &passes);

private:
    /// The engine of the frame that was requested last.
    const ShownEngine &used() const { return m_uniform ? *m_uniform : *m_engine; }
    void giveToWorker();
    void requestFrame(bool moving);
    void take(const std::shared_ptr<const RenderedFrame> &frame);
    void measureError();
    bool needsOneWidth() const;
    void useOneWidth();

    Document &m_document;
    ErrorMeter m_meter; ///< outlives the worker, which makes its pictures
    RenderWorker m_worker;
    LookComparison m_comparison;
    QTimer m_rest;
    QTimer m_check; ///< a picture rests: its error is measured
    std::optional<ShownEngine> m_engine;
    /// The same with one kernel for every frequency, for a picture at rest that misses the
    /// tolerance.
    std::optional<ShownEngine> m_uniform;
    EngineStage m_stage = EngineStage::coarse;
    PlanState m_planState = PlanState::holds;
    /// The frame on the screen. A new engine has not made it yet.
    std::shared_ptr<const RenderedFrame> m_frame;
    std::optional<error::StatedError> m_error; ///< against the study, if known
    EngineStage m_frameStage = EngineStage::coarse;
    picture::AutomaticTone m_tone;
    QString m_lookName;
    shading::Shading m_drawnShading; ///< of the last requested frame
    double m_fullFrameMs = 0.0;
    bool m_isFirstOfKind = true;   ///< of its size, or of an engine
    bool m_isFirstOfVolume = true; ///< the next frame
    bool m_pending = false;
    bool m_isComparing = false;
    std::uint64_t m_requested = 0, m_generation = 0;
    std::uint64_t m_uniformFrame = 0; ///< the last request with one kernel
};

} // namespace pellucid::ui
