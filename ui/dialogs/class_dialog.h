// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>

#include "core/classify/tissue_class.h"

class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLineEdit;
class QPushButton;

namespace pellucid::ui {

class ClassSteps;
class Document;
class LimitBox;
class PlainLabel;

/// Edits one class: its source, its steps and its edge. While the dialog is open, the planes are
/// tinted where values belong to the class.
class ClassDialog : public QDialog {
    Q_OBJECT
public:
    /// `index`: of the class in the document's look.
    ClassDialog(Document &document, std::size_t index, QWidget *parent = nullptr);
    /// Applies the dialog's values to `now`. *Throws* task::Error if the result is not a valid
    /// class.
    classify::TissueClass typed(const classify::TissueClass &now) const;

    /// The class as it was when the dialog opened.
    const classify::TissueClass &original() const { return m_original; }

    void accept() override;
    void done(int result) override;

protected:
    void keyPressEvent(QKeyEvent *event) override;
    void showEvent(QShowEvent *event) override;

private:
    void addSource(QFormLayout &form);
    void showTint();
    void chooseColor();
    void showColor();

    Document &m_document;
    const std::size_t m_index;
    const classify::TissueClass m_original;
    classify::TissueClass m_tissue;
    QLineEdit *m_name;
    QComboBox *m_source;
    LimitBox *m_low, *m_high, *m_softness;
    QDoubleSpinBox *m_edge;
    QPushButton *m_color;
    ClassSteps *m_steps;
    PlainLabel *m_message;
};

} // namespace pellucid::ui
