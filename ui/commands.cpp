// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/commands.h"

#include <QCoreApplication>

#include "ui/document.h"

namespace pellucid::ui {

EditScene::EditScene(Document &document, const render::Scene &after, const QString &text,
                     DragId drag)
    : QUndoCommand(text), m_document(document), m_before(document.scene()), m_after(after),
      m_drag(drag) {}

void EditScene::apply(render::Scene scene) {
    scene.camera = m_document.scene().camera;
    m_document.setScene(scene);
}

void EditScene::undo() {
    apply(m_before);
}
void EditScene::redo() {
    apply(m_after);
}

bool EditScene::mergeWith(const QUndoCommand *other) {
    const auto *next = static_cast<const EditScene *>(other);
    if (m_drag == 0 || next->m_drag != m_drag)
        return false;
    m_after = next->m_after;
    return true;
}

EditDisplayWindow::EditDisplayWindow(Document &document, const volume::ValueWindow &after,
                                     DragId drag)
    : QUndoCommand(QCoreApplication::translate("Commands", "Window")), m_document(document),
      m_before(document.displayWindow()), m_after(after), m_drag(drag) {}

void EditDisplayWindow::undo() {
    m_document.setDisplayWindow(m_before);
}
void EditDisplayWindow::redo() {
    m_document.setDisplayWindow(m_after);
}

bool EditDisplayWindow::mergeWith(const QUndoCommand *other) {
    const auto *next = static_cast<const EditDisplayWindow *>(other);
    if (m_drag == 0 || next->m_drag != m_drag)
        return false;
    m_after = next->m_after;
    return true;
}

EditMeasurements::EditMeasurements(Document &document,
                                   const std::vector<measure::Measurement> &after,
                                   const QString &text, DragId drag)
    : QUndoCommand(text), m_document(document), m_before(document.measurements()), m_after(after),
      m_drag(drag) {}

void EditMeasurements::undo() {
    m_document.setMeasurements(m_before);
}
void EditMeasurements::redo() {
    m_document.setMeasurements(m_after);
}

bool EditMeasurements::mergeWith(const QUndoCommand *other) {
    const auto *next = static_cast<const EditMeasurements *>(other);
    if (m_drag == 0 || next->m_drag != m_drag)
        return false;
    m_after = next->m_after;
    return true;
}

DragId nextDragId() {
    static DragId last = 0;
    return ++last;
}

} // namespace pellucid::ui
