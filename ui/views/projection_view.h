// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include <QTimer>
#include <QWidget>

#include "core/picture/automatic_tone.h"
#include "core/task/reason.h"
#include "ui/document/commands.h"
#include "ui/engine/look_preparer.h"
#include "ui/engine/render_worker.h"
#include "ui/engine/shown_engine.h"
#include "ui/views/look_comparison.h"
#include "ui/views/measure_tool.h"
#include "ui/views/overlay.h"
#include "ui/views/projection_canvas.h"
#include "ui/views/tools.h"

namespace pellucid::ui {

class Document;
class ProjectionOverlay;

/// The Fourier projection of the open volume: orbit, pan, zoom, window and level. Draws a draft
/// while the mouse moves if a full frame would lag, and the full frame when it rests.
class ProjectionView : public QWidget {
    Q_OBJECT
public:
    explicit ProjectionView(Document &document, QWidget *parent = nullptr);
    ~ProjectionView() override;

    void setEngine(const ShownEngine &shown, EngineStage stage);
    /// The name of the look, shown below the pane's.
    void setLookName(const QString &name);
    /// Whether the engine's predicted error is that of what is shown.
    void setPlanState(PlanState state);
    PlanState planState() const { return m_planState; }
    /// Takes the brightness anew from the next frame.
    void retakeTone();
    /// What is shown next has this brightness.
    void adoptTone(const picture::ToneRange &range);
    /// The next volume is another phase: brightness and picture stay till its own is there.
    void holdTone();
    void setMessage(const QString &message);
    /// Looks the way another camera does, as far as the pane allows. One of another volume turns
    /// about a place of that, *units*: as `pivotMm()`; this view's own pivot is there then.
    void adoptCamera(const scene::Camera &wanted, const std::optional<glm::dvec3> &pivotMm = {});
    /// What turning leaves where it is in the picture, from the middle of the volume.
    glm::dvec3 pivotMm() const;
    /// A job is over; whatever it should have delivered is there or will not come.
    void jobEnded();
    void jobStarted();
    void showStandardView(scene::StandardView view);
    void resetView();
    /// Of the tools only that of distances matters here; else the left button orbits.
    void setTool(Tool tool);
    /// Turning keeps the crosshair, or the middle of the volume, where it is in the picture.
    void setOrbitsCrosshair(bool isAboutCrosshair);
    bool orbitsCrosshair() const { return m_orbitsCrosshair; }
    /// While it is held: the look before the last edit beside the one of now.
    void setComparing(bool isComparing);
    bool isComparing() const { return m_isComparing; }
    /// About the patient's long axis.
    void turnAroundPatient(double degrees);
    /// With these image axes, as a distance in the plane of a picture was measured.
    void lookAlong(const glm::dvec3 &right, const glm::dvec3 &up);
    /// The picture as it is seen, without annotations. *Throws* Error{noSuchDevice} if the graphics
    /// card that holds it is gone, Error{outOfMemory}.
    QImage picture() const;
    /// The scene that makes the picture of this pane again anywhere, pixel for pixel: with the
    /// brightness that is shown, planned as it was. `scale`: pixels for one of the pane, a side.
    scene::Scene sceneOfPicture(int scale = 1) const;
    /// Makes the picture of any camera as it looks now, by the processor; to be called from any
    /// thread as long as the view is there. It *throws* as the engine.
    std::function<picture::ProjectionImage(const scene::Camera &)> pictureRenderer();
    /// What stands over the picture of a camera of the pane's size. *Units*: logical pixels.
    void paintAnnotations(QPainter &painter, const scene::Camera &camera, Names names) const;
    /// As the cine turns it.
    scene::Camera turnedAroundPatient(const scene::Camera &camera, double degrees) const;
    bool isFinal() const { return m_stage == EngineStage::full || m_stage == EngineStage::settled; }
    /// The final image of what the scene asks for.
    bool showsWhatIsAskedFor() const;
    bool showsFinalImage() const { return m_frame && !m_frame->draft && isFinal() && !m_pending; }

signals:
    void maximizeRequested(QWidget *pane);
    /// Engine and reason for the status bar.
    void engineDescribed(const QString &text);
    void finalImageShown();
    /// The graphics card failed; the processor goes on.
    void cardFailed(const pellucid::task::Reason &reason,
                    const std::shared_ptr<pellucid::gpu::FramePasses> &passes);
    /// A frame is on the screen; what it took to make.
    void frameShown(const pellucid::picture::FrameTimes &times, bool draft);

protected:
    void resizeEvent(QResizeEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    void mouseMoveEvent(QMouseEvent *event) override;
    void mouseReleaseEvent(QMouseEvent *event) override;
    void mouseDoubleClickEvent(QMouseEvent *event) override;
    void wheelEvent(QWheelEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    bool event(QEvent *event) override;

private:
    void fitCamera();
    void requestFrame(bool moving);
    void takeFrame(const std::shared_ptr<const RenderedFrame> &frame);
    scene::Tone shownTone() const;
    void updateTone();
    void moveCamera(const scene::Camera &camera, bool moving);
    void orbit(const QPoint &delta);
    void showComparison();
    void windowBy(const QPoint &delta);
    void zoomBy(double factor);
    double fittingPixelMm() const;
    void showTexts();
    void showCursor();
    PaneMapping mapping() const;
    PaneMapping mapping(const scene::Camera &camera) const;

    Document &m_document;
    std::unique_ptr<ProjectionCanvas> m_canvas;
    MeasureTool m_measure;
    ProjectionOverlay *m_overlay;
    RenderWorker m_worker;
    LookComparison m_comparison;
    QTimer m_rest;
    std::optional<prepare::PreparedEngine> m_prepared;
    std::shared_ptr<gpu::GpuEngine> m_onCard;
    task::Reason m_engineReason = task::because::processorChosen; ///< of the shown engine
    /// What is shown, and what made it: a new engine has to make its first picture yet.
    std::shared_ptr<const RenderedFrame> m_frame;
    std::optional<double> m_frameError; ///< against the study, if anyone knows
    EngineStage m_frameStage = EngineStage::coarse;
    picture::AutomaticTone m_tone;
    QString m_message, m_lookName;
    shading::Shading m_drawnShading; ///< of the last frame that was asked for
    double m_predictedError = 0.0, m_fullFrameMs = 0.0, m_zoom = 1.0;
    EngineStage m_stage = EngineStage::coarse;
    bool m_pending = false;
    bool m_orbitsCrosshair = false, m_isComparing = false;
    PlanState m_planState = PlanState::holds;
    std::uint64_t m_requested = 0, m_generation = 0;
    Tool m_tool = Tool::window;
    Qt::MouseButton m_button = Qt::NoButton;
    DragId m_drag = 0;
    QPoint m_last;
};

} // namespace pellucid::ui
