// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include <QTimer>
#include <QWidget>

#include "core/picture/automatic_tone.h"
#include "core/task/reason.h"
#include "ui/document/study_view.h"
#include "ui/engine/error_meter.h"
#include "ui/engine/look_preparer.h"
#include "ui/engine/reasons.h"
#include "ui/engine/render_worker.h"
#include "ui/engine/shown_engine.h"
#include "ui/views/look_comparison.h"
#include "ui/views/projection_canvas.h"
#include "ui/views/volume_pane.h"

namespace pellucid::ui {

class ProjectionOverlay;

/// The pane of the Fourier projection of the open volume: orbit, pan, zoom, brightness. It reports
/// its size to the document, and shows what the scene's camera sees. While the view moves it draws
/// drafts if full frames would lag, and a full frame when the view rests.
class ProjectionView : public VolumePane, public ProjectionPane {
    Q_OBJECT
public:
    explicit ProjectionView(Document &document, QWidget *parent = nullptr);
    ~ProjectionView() override;

    void setEngine(const ShownEngine &shown, EngineStage stage);
    /// Shows the name of the look below that of the pane.
    void setLookName(const QString &name);
    /// Whether the engine is made for what the scene asks for.
    void setPlanState(PlanState state);
    PlanState planState() const { return m_planState; }
    /// Measures the exposure again with the next frame.
    void retakeExposure();
    /// The next volume is another phase: exposure and picture stay until its own picture comes.
    void holdExposure();
    void setMessage(const QString &message);
    /// Looks the way another camera does, at the same pixel size, within the limits of the zoom.
    /// `pivotMm`: what that camera turns about, if it shows another volume; this view then shows
    /// its own pivot at the same place.
    void adoptCamera(const scene::Camera &wanted, const std::optional<glm::dvec3> &pivotMm = {});
    /// Turning leaves this point at its place in the picture. *Units*: mm, LPS, from the middle of
    /// the volume.
    glm::dvec3 pivotMm() const;
    /// A job has ended: nothing more will come from it.
    void jobEnded();
    void jobStarted();
    void showStandardView(scene::StandardView view);
    void showOrientation(const glm::dquat &orientation);
    /// The same view, fitted to the body.
    void fitView();
    /// Fits the view or, if it is fitted, resets it.
    void fitOrResetView();
    /// The front, fitted to the body, with automatic brightness.
    void resetView();
    /// Turns about the crosshair, or about the middle of the body.
    void setOrbitsCrosshair(bool isAboutCrosshair);
    bool orbitsCrosshair() const { return m_orbitsCrosshair; }
    /// Dragging turns the view as a trackball instead of a turntable, which keeps the patient
    /// upright.
    void setTurnsFreely(bool isFree) { m_turnsFreely = isFree; }
    bool turnsFreely() const { return m_turnsFreely; }
    void setOverlays(const Overlays &overlays) override;
    /// Shows the look before the last edit beside the present one.
    void setComparing(bool isComparing);
    bool isComparing() const { return m_isComparing; }
    /// Turns about the patient's long axis.
    void turnAroundPatient(double degrees);
    /// Looks with these image axes, for example those of a projected distance.
    void lookAlong(const glm::dvec3 &right, const glm::dvec3 &up);
    /// The picture on the screen, without annotations. *Throws* Error{noSuchDevice} if the graphics
    /// card that holds it has failed, Error{outOfMemory}.
    QImage picture() const;
    /// The scene that reproduces the picture of this pane anywhere, pixel for pixel: with the shown
    /// brightness, and planned for the volume. `scale`: pixels a side for one of the pane.
    scene::Scene sceneOfPicture(int scale = 1) const;
    /// A function that renders the present look with any camera, on the processor. It may be called
    /// on any thread while the view exists. It *throws* as the engine.
    std::function<picture::ProjectionImage(const scene::Camera &)> pictureRenderer();
    /// Paints the annotations of a picture of the pane's size. *Units*: logical pixels.
    void paintAnnotations(QPainter &painter, const scene::Camera &camera, Names names) const;
    /// A camera of this pane, at any scale, turned as `turnAroundPatient` turns the view.
    scene::Camera turnedAroundPatient(const scene::Camera &camera, double degrees) const;
    bool isFinal() const { return m_stage == EngineStage::full || m_stage == EngineStage::settled; }
    /// Whether the final image of what the scene asks for is on the screen.
    bool showsWhatIsAskedFor() const;
    /// What is known of the error of the frame on the screen, against the study.
    const std::optional<error::StatedError> &frameError() const { return m_frameError; }
    bool showsFinalImage() const { return m_frame && !m_frame->draft && isFinal() && !m_pending; }

signals:
    /// The angles beside the cube were clicked.
    void anglesRequested();
    /// Engine and reason for the status bar.
    void engineDescribed(const QString &text);
    void finalImageShown();
    /// The graphics card failed; the processor takes over.
    void cardFailed(const pellucid::task::Reason &reason,
                    const std::shared_ptr<pellucid::gpu::FramePasses> &passes);
    /// The error of the picture on the screen has been measured, or measured better.
    void errorMeasured(const pellucid::error::StatedError &error);
    /// A frame is on the screen. `times`: of rendering it.
    void frameShown(const pellucid::picture::FrameTimes &times, bool draft);

protected:
    void resizeEvent(QResizeEvent *event) override;
    void wheelEvent(QWheelEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    bool event(QEvent *event) override;

private:
    void follow(Changes changes);
    void forgetVolume();
    void requestFrame(bool moving);
    void takeFrame(const std::shared_ptr<const RenderedFrame> &frame);
    void measureError();
    void updateTone();
    /// The pose that fits the body's shadow into the pane.
    Pose fittedToBody(const Pose &pose) const;
    QSizeF sizeInPixels() const;
    PaneMapping mappingOf(const scene::Camera &camera) const;
    void showComparison();
    void showTexts();

    bool showsPicture() const override { return m_frame != nullptr; }
    void updateMarks() override;
    /// Cube and angles.
    std::function<void()> controlAt(const QPointF &at) override;
    QString helpAt(const QPoint &at) const override;
    PaneMapping mapping() const override;
    double reachMm() const override { return 0.0; } // a picture has no depth
    void panBy(const QPoint &delta) override;
    void zoomBy(double factor) override;
    void orbitBy(const QPoint &delta) override;
    void rollBy(double radians) override;
    picture::ToneRange automaticRange() const override;
    picture::ToneRange shownRange() const override;
    scene::Tone shownTone() const;
    /// Of the frame on the screen.
    picture::Display shownDisplay() const;

    std::unique_ptr<ProjectionCanvas> m_canvas;
    ProjectionOverlay *m_overlay;
    ErrorMeter m_meter; ///< outlives the worker, which makes its pictures
    RenderWorker m_worker;
    LookComparison m_comparison;
    QTimer m_rest;
    QTimer m_check; ///< a picture rests: its error is measured
    std::optional<prepare::PreparedEngine> m_prepared;
    std::shared_ptr<gpu::GpuEngine> m_onCard;
    task::Reason m_engineReason = task::because::processorChosen; ///< of the shown engine
    /// The frame on the screen. A new engine has not made it yet.
    std::shared_ptr<const RenderedFrame> m_frame;
    std::optional<error::StatedError> m_frameError; ///< against the study, if known
    EngineStage m_frameStage = EngineStage::coarse;
    picture::AutomaticTone m_tone;
    /// What the pane waits for while there is no picture.
    enum class Waiting { no, underway, cancelled };
    void setWaiting(Waiting waiting);
    Waiting m_waiting = Waiting::no;
    QString m_message, m_lookName;
    shading::Shading m_drawnShading; ///< of the last requested frame
    double m_fullFrameMs = 0.0;
    bool m_isFirstFrame = true; ///< of its size, or of an engine
    EngineStage m_stage = EngineStage::coarse;
    bool m_orbitsCrosshair = false, m_turnsFreely = false;
    bool m_fitsNext = true; ///< the next picture is the first of its volume
    /// Has the box of the body that the view was fitted to; other looks may show less of it.
    scene::Exposure m_body;
    bool m_pending = false;
    bool m_isComparing = false;
    glm::dquat m_seenFrom{1.0, 0.0, 0.0, 0.0}; ///< the present view
    PlanState m_planState = PlanState::holds;
    std::uint64_t m_requested = 0, m_generation = 0;
};

} // namespace pellucid::ui
