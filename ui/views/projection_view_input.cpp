// SPDX-License-Identifier: GPL-3.0-or-later
// Mouse, wheel and keys of the projection.
#include <QApplication>
#include <QContextMenuEvent>
#include <QHelpEvent>
#include <QKeyEvent>
#include <QLineF>
#include <QMouseEvent>
#include <QToolTip>
#include <QWheelEvent>

#include "core/scene/positioner_angles.h"
#include "ui/document/document.h"
#include "ui/language/shown_text.h"
#include "ui/views/camera_moves.h"
#include "ui/views/projection_overlay.h"
#include "ui/views/projection_texts.h"
#include "ui/views/projection_view.h"
#include "ui/views/tools/text_field.h"
#include "ui/views/view_keys.h"

namespace pellucid::ui {

void ProjectionView::setTool(Tool tool) {
    m_tools.choose(tool);
    showCursor();
}

void ProjectionView::showCursor() {
    if (const auto cursor = m_tools.cursor())
        setCursor(*cursor);
    else
        unsetCursor();
}

void ProjectionView::mousePressEvent(QMouseEvent *event) {
    setFocus();
    m_menuPress.reset();
    if (event->button() == Qt::RightButton) {
        if (m_tools.finishFigure()) {
            m_overlay->update();
            return;
        }
        if (!m_tools.isMarking())
            m_menuPress = event->position();
    }
    if (event->button() == Qt::LeftButton && !m_tools.isMarking() && pressOnCube(event->position()))
        return;
    if (!m_tools.isMarking())
        m_measuredFrom = m_document.scene().camera.orientation;
    m_tools.press(event->button(), event->position());
    if (m_tools.isMarking())
        m_overlay->update();
    else
        setCursor(m_tools.heldCursor());
}

void ProjectionView::mouseMoveEvent(QMouseEvent *event) {
    m_tools.move(event->position());
    const bool isHovering = event->buttons() == Qt::NoButton && m_tools.hover(event->position());
    if (m_tools.isMarking() || isHovering)
        m_overlay->update();
    if (event->buttons() == Qt::NoButton && !m_tools.isMarking()) {
        if (m_overlay->isClickable(event->position()))
            setCursor(Qt::PointingHandCursor);
        else
            showCursor();
    }
}

bool ProjectionView::pressOnCube(const QPointF &at) {
    if (!m_frame)
        return false;
    if (m_overlay->isOnAngles(at)) {
        emit anglesRequested();
        return true;
    }
    const auto side = m_overlay->cubeSideAt(at);
    if (side)
        showOrientation(scene::orientationFrom(*side));
    return side.has_value();
}

void ProjectionView::mouseReleaseEvent(QMouseEvent *event) {
    m_tools.release(event->button(), event->position());
    showCursor();
    m_overlay->update();
    // A drag with the right button sets the brightness.
    if (event->button() == Qt::RightButton && m_menuPress &&
        QLineF(*m_menuPress, event->position()).length() < QApplication::startDragDistance())
        emit menuRequested(this, event->globalPosition().toPoint(),
                           m_tools.measurementAt(event->position()));
}

void ProjectionView::contextMenuEvent(QContextMenuEvent *event) {
    if (event->reason() == QContextMenuEvent::Keyboard)
        emit menuRequested(this, mapToGlobal(rect().center()), -1);
    event->accept();
}

void ProjectionView::setOverlays(const Overlays &overlays) {
    m_overlay->setOverlays(overlays);
    m_tools.setMeasurementsShown(overlays.texts);
}

void ProjectionView::mouseDoubleClickEvent(QMouseEvent *event) {
    if (event->button() == Qt::LeftButton && m_tools.doublePress(event->position())) {
        m_overlay->update();
        return;
    }
    // With a tool for regions, two fast clicks are two regions; on the cube they are two turns.
    if (event->button() == Qt::LeftButton && !m_tools.marksRegions() && !m_tools.isMarking() &&
        !m_overlay->isClickable(event->position()))
        emit maximizeRequested(this);
    else
        mousePressEvent(event);
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

void ProjectionView::askForText(const QPointF &at, const QString &text,
                                const std::function<void(const QString &)> &take) {
    new TextField(*this, at, text, take);
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
    if (event->type() == QEvent::ToolTip && m_document.volume()) {
        const auto *const help = static_cast<QHelpEvent *>(event);
        const volume::VolumeNotes &notes = m_document.volume()->notes();
        if (!notes.warnings.empty() && m_overlay->isOnWarnings(help->pos())) {
            QToolTip::showText(
                help->globalPos(),
                plainToolTip(warningLines(notes, Names::shown, notes.warnings.size()).join('\n')),
                this);
            return true;
        }
        if (m_frameError && m_overlay->isOnFigures(help->pos())) {
            QToolTip::showText(help->globalPos(), plainToolTip(errorExplanation(*m_frameError)),
                               this);
            return true;
        }
    }
    // Here the digits of the keypad choose standard views, not window presets.
    if (event->type() == QEvent::ShortcutOverride &&
        (static_cast<QKeyEvent *>(event)->modifiers() & Qt::KeypadModifier) != 0) {
        event->accept();
        return true;
    }
    return QWidget::event(event);
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
    else if ((event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) &&
             m_tools.finishFigure())
        m_overlay->update();
    else if (event->key() == Qt::Key_Escape && m_tools.isMarking()) {
        m_tools.cancel();
        m_overlay->update();
    } else
        QWidget::keyPressEvent(event);
}

void ProjectionView::leaveEvent(QEvent * /*event*/) {
    m_tools.leave();
    m_overlay->update();
}

} // namespace pellucid::ui
