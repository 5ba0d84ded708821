// SPDX-License-Identifier: GPL-3.0-or-later
// Mouse, wheel and keys of the projection.
#include <QKeyEvent>
#include <QWheelEvent>

#include "core/scene/positioner_angles.h"
#include "ui/document/document.h"
#include "ui/views/camera_moves.h"
#include "ui/views/projection_overlay.h"
#include "ui/views/projection_texts.h"
#include "ui/views/projection_view.h"
#include "ui/views/view_keys.h"

namespace pellucid::ui {

void ProjectionView::updateMarks() {
    m_overlay->update();
}

std::function<void()> ProjectionView::controlAt(const QPointF &at) {
    if (m_overlay->isOnAngles(at))
        return [this] { emit anglesRequested(); };
    if (const auto side = m_overlay->cubeSideAt(at))
        return [this, side = *side] { showOrientation(scene::orientationFrom(side)); };
    return {};
}

QString ProjectionView::helpAt(const QPoint &at) const {
    if (m_overlay->isOnWarnings(at))
        return warnings();
    return m_frames.error() && m_overlay->isOnFigures(at) ? errorExplanation(*m_frames.error())
                                                          : QString();
}

void ProjectionView::setOverlays(const Overlays &overlays) {
    m_overlay->setOverlays(overlays);
    VolumePane::setOverlays(overlays);
}

void ProjectionView::orbitBy(const QPoint &delta) {
    m_document.setPose(
        (m_turnsFreely ? orbited : turnedByTable)(m_document.pose(), delta, pivotMm()), true);
}

void ProjectionView::rollBy(double radians) {
    m_document.setPose(rolled(m_document.pose(), radians, pivotMm()), true);
}

void ProjectionView::panBy(const QPoint &delta) {
    m_document.setPose(
        panned(m_document.pose(), delta, m_document.scene().camera.pixelMm * devicePixelRatioF()),
        true);
}

void ProjectionView::zoomBy(double factor) {
    m_document.setPose(zoomed(m_document.pose(), factor), true);
}

void ProjectionView::wheelEvent(QWheelEvent *event) {
    if (event->angleDelta().y() != 0)
        zoomBy(event->angleDelta().y() > 0 ? 1.15 : 1.0 / 1.15);
    event->accept();
}

bool ProjectionView::event(QEvent *event) {
    // The new screen may have another pixel ratio, which does not resize the pane.
    if (event->type() == QEvent::ScreenChangeInternal)
        m_document.setProjectionSize(sizeInPixels());
    // Here the digits of the keypad choose standard views, not window presets.
    if (event->type() == QEvent::ShortcutOverride &&
        (static_cast<QKeyEvent *>(event)->modifiers() & Qt::KeypadModifier) != 0) {
        event->accept();
        return true;
    }
    return VolumePane::event(event);
}

void ProjectionView::keyPressEvent(QKeyEvent *event) {
    const bool keypad = (event->modifiers() & Qt::KeypadModifier) != 0;
    if (const auto view = standardViewOf(*event))
        showStandardView(*view);
    else if (keypad && (event->key() == Qt::Key_0 || event->key() == Qt::Key_Insert))
        resetView();
    else if (event->key() == Qt::Key_R)
        fitOrResetView();
    else if (event->key() == Qt::Key_Left || event->key() == Qt::Key_Right)
        orbitBy({event->key() == Qt::Key_Left ? -11 : 11, 0}); // about five degrees
    else if (event->key() == Qt::Key_Up || event->key() == Qt::Key_Down)
        orbitBy({0, event->key() == Qt::Key_Up ? -11 : 11});
    else
        VolumePane::keyPressEvent(event);
}

} // namespace pellucid::ui
