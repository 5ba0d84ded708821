// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QUndoCommand>

#include "core/measure/measurement.h"
#include "core/render/scene.h"
#include "core/volume/volume.h"

namespace pellucid::ui {

class Document;

/// Commands of one drag carry the same number and merge; 0 never merges.
using DragId = int;

/// Replaces what the scene shows; the camera stays where it is looking.
class EditScene : public QUndoCommand {
public:
    EditScene(Document &document, const render::Scene &after, const QString &text, DragId drag = 0);
    void undo() override;
    void redo() override;
    int id() const override { return 1; }
    bool mergeWith(const QUndoCommand *other) override;

private:
    void apply(render::Scene scene);
    Document &m_document;
    render::Scene m_before, m_after;
    DragId m_drag;
};

/// Replaces the display window of the panes.
class EditDisplayWindow : public QUndoCommand {
public:
    EditDisplayWindow(Document &document, const volume::ValueWindow &after, DragId drag = 0);
    void undo() override;
    void redo() override;
    int id() const override { return 2; }
    bool mergeWith(const QUndoCommand *other) override;

private:
    Document &m_document;
    volume::ValueWindow m_before, m_after;
    DragId m_drag;
};

/// Replaces the measurements.
class EditMeasurements : public QUndoCommand {
public:
    EditMeasurements(Document &document, const std::vector<measure::Measurement> &after,
                     const QString &text, DragId drag = 0);
    void undo() override;
    void redo() override;
    int id() const override { return 3; }
    bool mergeWith(const QUndoCommand *other) override;

private:
    Document &m_document;
    std::vector<measure::Measurement> m_before, m_after;
    DragId m_drag;
};

/// A number no other drag has.
DragId nextDragId();

} // namespace pellucid::ui
