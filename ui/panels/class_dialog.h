// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>

#include "core/classify/tissue_class.h"

class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QListWidget;
class QPushButton;

namespace pellucid::ui {

class Document;

/// Edits one class. While the dialog is open, the planes are tinted where values belong to the
/// class.
class ClassDialog : public QDialog {
    Q_OBJECT
public:
    ClassDialog(Document &document, const classify::TissueClass &tissue, QWidget *parent = nullptr);
    /// Applies the dialog's values to `now`. *Throws* task::Error if the result is not a valid
    /// class.
    classify::TissueClass typed(const classify::TissueClass &now) const;

    void accept() override;
    void done(int result) override;

private:
    double valueOf(const QDoubleSpinBox &box, double shown, double former) const;
    void showTint();
    void chooseColor();
    void showColor();
    void addStep();

    Document &m_document;
    classify::TissueClass m_tissue;
    QLineEdit *m_name, *m_step;
    QDoubleSpinBox *m_low, *m_high, *m_softness;
    double m_shownLow, m_shownHigh, m_shownSoftness; ///< as rounded by the boxes
    QPushButton *m_color;
    QListWidget *m_steps;
    QLabel *m_message;
};

} // namespace pellucid::ui
