// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/projection_view.h"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

#include "core/task/error.h"
#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/language/reasons.h"
#include "ui/views/camera_moves.h"
#include "ui/views/projection_overlay.h"
#include "ui/views/projection_texts.h"
#include "ui/views/tools/orbit_tool.h"
#include "ui/views/tools/tone_tool.h"

namespace pellucid::ui {

ProjectionView::ProjectionView(Document &document, QWidget *parent)
    : VolumePane(document, PaneView::projection, parent), m_canvas(makeProjectionCanvas(this)),
      m_overlay(new ProjectionOverlay(document, m_tools, this)), m_frames(document) {
    m_tools.addTurning(std::make_unique<OrbitTool>(*this, *this));
    m_tools.addRight(std::make_unique<ToneTool>(document, *this));
    m_tools.choose(Tool::window);
    setObjectName("projectionView");
    setAccessibleName(tr("Projection"));
    setMinimumSize(200, 160);
    m_document.setProjectionSize(sizeInPixels());
    m_canvas->widget()->setAttribute(Qt::WA_TransparentForMouseEvents);
    m_overlay->raise();
    connect(&m_frames, &ProjectionFrames::bodyFound, this, &ProjectionView::fitToNewBody);
    connect(&m_frames, &ProjectionFrames::shown, this, &ProjectionView::showFrame);
    connect(&m_frames, &ProjectionFrames::errorMeasured, this, &ProjectionView::showTexts);
    connect(&m_frames, &ProjectionFrames::failed, this,
            [this](const task::Reason &reason) { setMessage(translated(reason)); });
    connect(&document, &Document::changed, this, &ProjectionView::follow);
}

ProjectionView::~ProjectionView() {
    // The canvas is also a child widget: destroy it before the base class deletes the children.
    m_canvas.reset();
}

void ProjectionView::follow(Changes changes) {
    if (changes & (Change::pose | Change::paneSize))
        m_overlay->setMapping(mapping());
    if (changes & (Change::measurements | Change::selection) ||
        (m_orbitsCrosshair && (changes & Change::crosshair)))
        m_overlay->update();
    const glm::dquat seenFrom = m_document.scene().camera.orientation;
    const bool isTurned = std::exchange(m_seenFrom, seenFrom) != seenFrom;
    if (changes & Change::volume) {
        if (!m_document.volume() || !m_document.isPreview())
            forgetVolume();
        m_frames.adoptExposure();
        updateTone();
        return;
    }
    // The points of a figure belong to one view.
    if (isTurned && m_tools.isMeasuring())
        m_tools.dropUnfinished();
    if (changes & Change::scene)
        updateTone();
    if (changes & (Change::scene | Change::pose | Change::paneSize))
        m_frames.request(bool(changes & Change::moving));
}

// Engine and picture belong to another volume.
void ProjectionView::forgetVolume() {
    m_tools.dropUnfinished();
    m_overlay->setComparison({}, {});
    if (!m_frames.forgetVolume())
        return;
    m_body = {};
    m_message.clear();
    m_waiting = m_document.volume() ? Waiting::underway : Waiting::no;
    m_canvas->setImage(nullptr);
    showTexts();
}

void ProjectionView::setEngine(const ShownEngine &shown, EngineStage stage) {
    if (!m_frames.setEngine(shown, stage))
        return;
    m_message.clear();
    m_waiting = Waiting::no;
}

void ProjectionView::jobEnded() {
    if (m_waiting == Waiting::underway)
        setWaiting(Waiting::cancelled);
}

void ProjectionView::jobStarted() {
    if (m_waiting == Waiting::cancelled)
        setWaiting(Waiting::underway);
}

void ProjectionView::adoptCamera(const scene::Camera &wanted,
                                 const std::optional<glm::dvec3> &pivotMm) {
    Pose pose = m_document.poseOf(wanted);
    pose.panMm = pannedTo(pose, pivotMm.value_or(this->pivotMm()), this->pivotMm());
    m_document.setPose(pose, true); // a linked view may be moving
}

void ProjectionView::setLookName(const QString &name) {
    m_frames.setLookName(name);
    showTexts();
}

void ProjectionView::setPlanState(PlanState state) {
    m_frames.setPlanState(state);
    showTexts();
}

void ProjectionView::jobFailed(const task::Reason &what) {
    if (m_document.volume() && !showsPicture())
        setMessage(translated(what));
}

void ProjectionView::setMessage(const QString &message) {
    m_message = message;
    setWaiting(Waiting::no);
}

void ProjectionView::setWaiting(Waiting waiting) {
    m_waiting = waiting;
    showTexts();
}

void ProjectionView::resetView() {
    m_body = m_frames.exposure();
    m_document.setPose(fittedToBody({}));
    editScene(m_document, tr("Reset window"), noDrag, [](scene::Scene &scene) {
        scene.tone.low.reset();
        scene.tone.high.reset();
    });
}

void ProjectionView::fitView() {
    m_body = m_frames.exposure();
    m_document.setPose(fittedToBody(m_document.pose()));
}

void ProjectionView::fitOrResetView() {
    m_body = m_frames.exposure();
    if (fittedToBody(m_document.pose()) == m_document.pose())
        resetView();
    else
        fitView();
}

void ProjectionView::setOrbitsCrosshair(bool isAboutCrosshair) {
    m_orbitsCrosshair = isAboutCrosshair;
    m_overlay->setShowsCrosshair(isAboutCrosshair);
}

glm::dvec3 ProjectionView::pivotMm() const {
    return m_orbitsCrosshair && m_document.volume()
               ? m_document.crosshair().mm - m_document.volume()->lattice().center().mm
               : 0.5 * (m_body.lowMm + m_body.highMm);
}

Pose ProjectionView::fittedToBody(const Pose &pose) const {
    return fitted(pose, m_body.lowMm, m_body.highMm, m_document.fittingPixelMm(), sizeInPixels());
}

void ProjectionView::showStandardView(scene::StandardView view) {
    showOrientation(scene::viewOrientation(view));
}

void ProjectionView::showOrientation(const glm::dquat &orientation) {
    const Pose turned = turnedTo(m_document.pose(), orientation, pivotMm());
    m_document.setPose(turned.isFitted ? fittedToBody(turned) : turned);
}

void ProjectionView::setComparing(bool isComparing) {
    m_frames.setComparing(isComparing);
    if (!m_frames.isComparing())
        m_overlay->setComparison({}, {});
}

void ProjectionView::showComparison() {
    try {
        if (const auto compared = m_frames.compared())
            m_overlay->setComparison(compared->picture, compared->name);
    } catch (const task::Error &error) { // the card that held the picture failed
        setComparing(false);
        setMessage(translated(error.reason()));
    }
}

void ProjectionView::fitToNewBody() {
    m_body = m_frames.exposure();
    const Pose now = m_document.pose();
    if (now.isFitted && now.zoom == 1.0 && now.panMm == glm::dvec2(0.0)) // the view is new
        m_document.setPose(fittedToBody(now));
}

void ProjectionView::showFrame() {
    const RenderedFrame &frame = *m_frames.frame();
    if (frame.onCard)
        m_canvas->setPicture(frame.onCard);
    else
        m_canvas->setImage({m_frames.frame(), &frame.image});
    updateTone();
    showTexts();
    emit frameShown(frame.times, frame.draft);
    emit engineDescribed(m_frames.engineText());
    showComparison();
}

void ProjectionView::updateTone() {
    m_canvas->setDisplay(m_frames.display());
}

bool ProjectionView::showsWhatIsAskedFor() const {
    return m_document.volume() && m_frames.showsFinalImage() &&
           m_frames.planState() == PlanState::holds;
}

scene::Scene ProjectionView::sceneOfPicture(int scale) const {
    scene::Scene scene = m_document.scene();
    scene.camera.width *= scale;
    scene.camera.height *= scale;
    scene.camera.pixelMm /= scale;
    scene.tone = m_frames.shownTone();
    scene.plannedFor = scene::PlannedFor::volume;
    scene.isOfDifference = m_document.volume() && m_document.volume()->notes().isDifference;
    return scene;
}

void ProjectionView::paintAnnotations(QPainter &painter, const scene::Camera &camera,
                                      Names names) const {
    m_overlay->paint(painter, mappingOf(camera),
                     names == Names::shown ? Marks::plain : Marks::nameless, names);
}

scene::Camera ProjectionView::turnedAroundPatient(const scene::Camera &camera,
                                                  double degrees) const {
    const Pose pose = ui::turnedAroundPatient(m_document.pose(), degrees, pivotMm());
    scene::Camera turned = camera;
    turned.orientation = pose.orientation;
    turned.panMm = pose.panMm;
    return turned;
}

QSizeF ProjectionView::sizeInPixels() const {
    return QSizeF(size()) * devicePixelRatioF();
}

void ProjectionView::resizeEvent(QResizeEvent *) {
    m_frames.resized();
    m_canvas->widget()->setGeometry(rect());
    m_overlay->setGeometry(rect());
    m_document.setProjectionSize(sizeInPixels());
    if (m_document.pose().isFitted && showsPicture())
        m_document.setPose(fittedToBody(m_document.pose()));
}

PaneMapping ProjectionView::mapping() const {
    return mappingOf(m_document.scene().camera);
}

PaneMapping ProjectionView::mappingOf(const scene::Camera &camera) const {
    PaneMapping mapping;
    mapping.pixelRatio = devicePixelRatioF();
    const glm::dmat3 axes = camera.axes();
    mapping.plane = {{}, {axes[0], axes[1]}, camera.pixelMm, camera.width, camera.height};
    if (m_document.volume())
        mapping.plane.center = {m_document.volume()->lattice().center().mm +
                                camera.panMm.x * axes[0] + camera.panMm.y * axes[1]};
    return mapping;
}

void ProjectionView::turnAroundPatient(double degrees) {
    m_document.setPose(ui::turnedAroundPatient(m_document.pose(), degrees, pivotMm()), true);
}

void ProjectionView::lookAlong(const glm::dvec3 &right, const glm::dvec3 &up) {
    const glm::dquat orientation = glm::quat_cast(glm::dmat3(right, up, glm::cross(right, up)));
    showOrientation(orientation);
}

void ProjectionView::showTexts() {
    const QString message = m_waiting == Waiting::underway ? tr("Preparing the projection")
                            : m_waiting == Waiting::cancelled
                                ? tr("Cancelled: there is no projection")
                                : m_message;
    ProjectionOverlay::Texts texts{m_frames.lookName(), message, {}};
    if (showsPicture())
        texts.figures = figuresText(m_frames.described());
    m_overlay->setTexts(texts);
}

} // namespace pellucid::ui
