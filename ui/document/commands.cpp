// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/document/commands.h"

#include <utility>

#include <QCoreApplication>

#include "core/task/error.h"
#include "ui/document/document.h"

namespace pellucid::ui {

EditScene::EditScene(Document &document, const scene::Scene &after, const QString &text,
                     DragId drag)
    : EditValue(document, document.scene(), after, text, drag) {}

void EditScene::apply(const scene::Scene &scene) {
    m_document.setScene(scene);
}

EditDisplayWindow::EditDisplayWindow(Document &document, const volume::ValueWindow &after,
                                     DragId drag)
    : EditValue(document, document.displayWindow(), after,
                QCoreApplication::translate("Commands", "Window"), drag) {}

void EditDisplayWindow::apply(const volume::ValueWindow &window) {
    m_document.setDisplayWindow(window);
}

EditMeasurements::EditMeasurements(Document &document,
                                   const std::vector<measure::Measurement> &after,
                                   const QString &text, DragId drag)
    : EditValue(document, document.measurements(), after, text, drag) {}

void EditMeasurements::apply(const std::vector<measure::Measurement> &measurements) {
    m_document.setMeasurements(measurements);
}

EditPlaneAxes::EditPlaneAxes(Document &document, const mpr::PlaneAxes &after, const QString &text,
                             DragId drag)
    : EditValue(document, document.cut().axes, after, text, drag) {}

void EditPlaneAxes::apply(const mpr::PlaneAxes &axes) {
    Cut cut = m_document.cut();
    cut.axes = axes;
    m_document.setCut(cut);
}

bool editScene(Document &document, const QString &text, DragId drag,
               const std::function<void(scene::Scene &)> &edit) {
    scene::Scene scene = document.scene();
    edit(scene);
    scene.camera = document.scene().camera;
    if (scene == document.scene())
        return false;
    document.undoStack()->push(new EditScene(document, scene, text, drag));
    return true;
}

bool editLook(Document &document, const QString &text, DragId drag,
              const std::function<void(classify::Look &)> &edit) {
    classify::Look look = document.scene().look;
    edit(look);
    try {
        classify::validate(look);
    } catch (const task::Error &error) {
        emit document.editRefused(error.reason());
        return false;
    }
    return editScene(document, text, drag,
                     [&](scene::Scene &scene) { scene.look = std::move(look); });
}

} // namespace pellucid::ui
