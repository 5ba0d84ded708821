// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QDialog>

#include "ui/document/commands.h"
#include "ui/studies/window_presets.h"

class QDoubleSpinBox;
class QPushButton;
class QTableWidget;

namespace pellucid::ui {

/// Width and center of the planes as numbers, and the list of window presets. Changes apply at
/// once; it stays open beside the picture.
class DisplayWindowDialog : public QDialog {
    Q_OBJECT
public:
    /// The document must outlive it.
    DisplayWindowDialog(Document &document, QWidget *parent);
    ~DisplayWindowDialog() override;

    const Document &document() const { return m_document; }

signals:
    /// The stored list has changed.
    void presetsChanged();

private:
    void showWindow();
    void showPresets(int selected);
    void apply();
    void changeCell(int row, int column);
    void addPreset();
    void removePreset();
    void movePreset(int by);
    void store(int selected);
    void showButtons();

    Document &m_document;
    QDoubleSpinBox *m_width, *m_center;
    QTableWidget *m_table;
    QPushButton *m_add, *m_remove, *m_up, *m_down;
    std::vector<WindowPreset> m_presets;
    DragId m_drag = noDrag; ///< all numbers typed in one opening are one edit
};

} // namespace pellucid::ui
