// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include <QWidget>

#include "ui/document/study_view.h"
#include "ui/views/projection_canvas.h"
#include "ui/views/projection_frames.h"
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

    /// What is shown. Engine and state of its plan come through the functions below, because the
    /// figures show them.
    ProjectionFrames &frames() { return m_frames; }
    const ProjectionFrames &frames() const { return m_frames; }
    void setEngine(const ShownEngine &shown, EngineStage stage);
    void setPlanState(PlanState state);
    /// Shows the name of the look below that of the pane.
    void setLookName(const QString &name);
    void setMessage(const QString &message);
    /// Says why there is no picture. One that is shown stays clear: what failed is not in it.
    void jobFailed(const task::Reason &what);
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
    bool isComparing() const { return m_frames.isComparing(); }
    /// Turns about the patient's long axis.
    void turnAroundPatient(double degrees);
    /// Looks with these image axes, for example those of a projected distance.
    void lookAlong(const glm::dvec3 &right, const glm::dvec3 &up);
    QImage picture() const { return m_frames.picture(); }
    /// The scene that reproduces the picture of this pane anywhere, pixel for pixel: with the shown
    /// brightness, and planned for the volume. `scale`: pixels a side for one of the pane.
    scene::Scene sceneOfPicture(int scale = 1) const;
    /// Paints the annotations of a picture of the pane's size. *Units*: logical pixels.
    void paintAnnotations(QPainter &painter, const scene::Camera &camera, Names names) const;
    /// A camera of this pane, at any scale, turned as `turnAroundPatient` turns the view.
    scene::Camera turnedAroundPatient(const scene::Camera &camera, double degrees) const;
    /// Whether the final image of what the scene asks for is on the screen.
    bool showsWhatIsAskedFor() const;

signals:
    /// The angles beside the cube were clicked.
    void anglesRequested();
    /// Engine and reason for the status bar.
    void engineDescribed(const QString &text);
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
    void showFrame();
    void fitToNewBody();
    void updateTone();
    /// The pose that fits the body's shadow into the pane.
    Pose fittedToBody(const Pose &pose) const;
    QSizeF sizeInPixels() const;
    PaneMapping mappingOf(const scene::Camera &camera) const;
    void showComparison();
    void showTexts();

    bool showsPicture() const override { return m_frames.frame() != nullptr; }
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
    picture::ToneRange automaticRange() const override { return m_frames.automaticRange(); }
    picture::ToneRange shownRange() const override { return m_frames.display().range; }

    std::unique_ptr<ProjectionCanvas> m_canvas;
    ProjectionOverlay *m_overlay;
    ProjectionFrames m_frames;
    /// What the pane waits for while there is no picture.
    enum class Waiting { no, underway, cancelled };
    void setWaiting(Waiting waiting);
    Waiting m_waiting = Waiting::no;
    QString m_message;
    bool m_orbitsCrosshair = false, m_turnsFreely = false;
    /// Has the box of the body that the view was fitted to; other looks may show less of it.
    scene::Exposure m_body;
    glm::dquat m_seenFrom{1.0, 0.0, 0.0, 0.0}; ///< the present view
};

} // namespace pellucid::ui
