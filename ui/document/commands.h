// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <typeinfo>
#include <utility>
#include <vector>

#include <QUndoCommand>

#include "core/measure/measurement.h"
#include "core/mpr/plane.h"
#include "core/scene/scene.h"
#include "core/volume/volume.h"
#include "ui/language/shown_text.h"
#include "ui/widgets/drag_id.h"

namespace pellucid::ui {

class Document;

/// Replaces a value of the document; edits of one drag merge. A kind of edit defines how the value
/// is set.
template <class Value> class EditValue : public QUndoCommand {
public:
    void undo() override { apply(m_before); }
    void redo() override { apply(m_after); }
    DragId drag() const { return m_drag; }
    int id() const override { return 0; } // one for all: `mergeWith` compares the types
    bool mergeWith(const QUndoCommand *other) override {
        if (m_drag == noDrag || typeid(*other) != typeid(*this))
            return false;
        const auto *next = static_cast<const EditValue *>(other);
        if (next->m_drag != m_drag)
            return false;
        m_after = next->m_after;
        return true;
    }

protected:
    EditValue(Document &document, Value before, Value after, const QString &text, DragId drag)
        : QUndoCommand(editText(text)), m_document(document), m_before(std::move(before)),
          m_after(std::move(after)), m_drag(drag) {}
    virtual void apply(const Value &value) = 0;

    Document &m_document;

private:
    Value m_before, m_after;
    DragId m_drag;
};

/// Replaces the scene, but not its camera. Pushed by `editScene`.
class EditScene : public EditValue<scene::Scene> {
public:
    EditScene(Document &document, const scene::Scene &after, const QString &text, DragId drag);

private:
    void apply(const scene::Scene &scene) override;
};

/// Replaces the display window of the panes.
class EditDisplayWindow : public EditValue<volume::ValueWindow> {
public:
    EditDisplayWindow(Document &document, const volume::ValueWindow &after, DragId drag = noDrag);

private:
    void apply(const volume::ValueWindow &window) override;
};

/// Replaces the measurements.
class EditMeasurements : public EditValue<std::vector<measure::Measurement>> {
public:
    EditMeasurements(Document &document, const std::vector<measure::Measurement> &after,
                     const QString &text, DragId drag = noDrag);

private:
    void apply(const std::vector<measure::Measurement> &measurements) override;
};

/// Turns the planes.
class EditPlaneAxes : public EditValue<mpr::PlaneAxes> {
public:
    EditPlaneAxes(Document &document, const mpr::PlaneAxes &after, const QString &text,
                  DragId drag = noDrag);

private:
    void apply(const mpr::PlaneAxes &axes) override;
};

/// Applies `edit` to a copy of the scene and pushes the result as an edit named `text`. Returns
/// false and pushes nothing if the scene stays the same. A change of the camera is ignored: looking
/// is not an edit.
bool editScene(Document &document, const QString &text, DragId drag,
               const std::function<void(scene::Scene &)> &edit);

/// The same for the look. A look that would be invalid is refused: `Document::editRefused` says
/// why.
bool editLook(Document &document, const QString &text, DragId drag,
              const std::function<void(classify::Look &)> &edit);

} // namespace pellucid::ui
