// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/volume_pane.h"

#include <QApplication>
#include <QContextMenuEvent>
#include <QHelpEvent>
#include <QKeyEvent>
#include <QLineF>
#include <QMouseEvent>
#include <QToolTip>

#include "ui/document/document.h"
#include "ui/language/shown_text.h"
#include "ui/views/tools/text_field.h"

namespace pellucid::ui {

VolumePane::VolumePane(Document &document, PaneView view, QWidget *parent)
    : QWidget(parent), m_document(document), m_tools(document, *this, view) {
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true); // the brush is shown where it would paint
    // Typed texts belong to the former volume.
    document.whenever(Change::volume, this, [this] { dropTextFields(*this); });
}

void VolumePane::setTool(Tool tool) {
    m_tools.choose(tool);
    showCursor(mapFromGlobal(QCursor::pos()));
    updateMarks();
}

void VolumePane::setOverlays(const Overlays &overlays) {
    m_overlays = overlays;
    m_tools.setMeasurementsShown(overlays.texts);
    updateMarks();
}

void VolumePane::askForText(const QPointF &at, const QString &text,
                            const std::function<void(const QString &)> &take) {
    new TextField(*this, at, text, take);
}

void VolumePane::showCursor(const QPointF &at) {
    if (!showsPicture())
        unsetCursor();
    else
        setCursor(!m_tools.isBusy() && controlAt(at) ? Qt::PointingHandCursor
                                                     : m_tools.cursorAt(at));
}

void VolumePane::mousePressEvent(QMouseEvent *event) {
    setFocus();
    m_menuPress.reset();
    if (event->button() == Qt::RightButton) {
        if (m_tools.finishFigure()) {
            updateMarks();
            return;
        }
        if (!m_tools.isBusy())
            m_menuPress = event->position();
    }
    if (!showsPicture())
        return;
    if (event->button() == Qt::LeftButton && !m_tools.isBusy())
        if (const auto click = controlAt(event->position())) {
            click();
            return;
        }
    m_tools.press(event->button(), event->position());
    setCursor(m_tools.cursorAt(event->position()));
    updateMarks();
}

void VolumePane::mouseMoveEvent(QMouseEvent *event) {
    if (!showsPicture())
        return;
    if (m_tools.move(event->position()))
        updateMarks();
    else
        hover(*event);
    if (event->buttons() == Qt::NoButton)
        showCursor(event->position());
}

void VolumePane::mouseReleaseEvent(QMouseEvent *event) {
    if (showsPicture())
        m_tools.release(event->button(), event->position());
    else
        m_tools.cancel();
    showCursor(event->position());
    updateMarks();
    // A drag with the right button opens no menu.
    if (event->button() == Qt::RightButton && m_menuPress &&
        QLineF(*m_menuPress, event->position()).length() < QApplication::startDragDistance())
        emit menuRequested(this, event->globalPosition().toPoint(),
                           showsPicture() ? m_tools.measurementAt(event->position()) : -1);
}

void VolumePane::mouseDoubleClickEvent(QMouseEvent *event) {
    const bool isLeft = event->button() == Qt::LeftButton;
    if (isLeft && showsPicture() && m_tools.doublePress(event->position()))
        updateMarks();
    // A fast click for an angle's third point may arrive as a double-click; with a tool for
    // regions, two fast clicks are two regions; on a control they are two clicks.
    else if (isLeft && !m_tools.isBusy() && !m_tools.marksRegions() &&
             !controlAt(event->position()))
        emit maximizeRequested(this);
    else
        mousePressEvent(event);
}

void VolumePane::contextMenuEvent(QContextMenuEvent *event) {
    if (event->reason() == QContextMenuEvent::Keyboard)
        emit menuRequested(this, mapToGlobal(rect().center()), -1);
    event->accept();
}

void VolumePane::keyPressEvent(QKeyEvent *event) {
    const bool isEnter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    const bool isDropped = event->key() == Qt::Key_Escape && m_tools.isBusy();
    if (isDropped)
        m_tools.cancel();
    if (isDropped || (isEnter && m_tools.finishFigure()))
        updateMarks();
    else
        QWidget::keyPressEvent(event);
}

void VolumePane::leaveEvent(QEvent * /*event*/) {
    m_tools.leave();
    updateMarks();
}

QString VolumePane::warnings() const {
    const volume::VolumeNotes &notes = m_document.volume()->notes();
    return warningLines(notes, Names::shown, notes.warnings.size()).join('\n');
}

bool VolumePane::event(QEvent *event) {
    if (event->type() == QEvent::ToolTip && m_document.volume()) {
        const auto *const help = static_cast<QHelpEvent *>(event);
        if (const QString text = helpAt(help->pos()); !text.isEmpty()) {
            QToolTip::showText(help->globalPos(), plainToolTip(text), this);
            return true;
        }
    }
    return QWidget::event(event);
}

} // namespace pellucid::ui
