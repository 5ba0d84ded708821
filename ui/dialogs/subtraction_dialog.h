// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QDialog>

#include "ui/studies/difference_source.h"

class QCheckBox;
class QComboBox;
class QListWidget;
class QPushButton;

namespace pellucid::ui {

class Document;
class StudyLibrary;

/// The volumes of the open volume's patient that can be subtracted from it: those that are open,
/// phases included, then those of the library.
std::vector<StudySource> subtrahends(const Document &document, StudyLibrary &library);

/// The study beside a difference.
enum class BesideDifference { nothing, minuend, alignedSubtrahend };

/// Selects the volume to subtract, whether it is aligned first, and what is shown beside the
/// difference.
class SubtractionDialog : public QDialog {
    Q_OBJECT
public:
    SubtractionDialog(const StudySource &minuend, std::vector<StudySource> subtrahends,
                      QWidget *parent = nullptr);

signals:
    void chosen(const pellucid::ui::StudySource &subtrahend,
                const std::shared_ptr<pellucid::ui::Alignment> &alignment,
                pellucid::ui::BesideDifference beside);

private:
    void accept() override;
    void showAlignment();

    std::vector<StudySource> m_subtrahends;
    QListWidget *m_list;
    QCheckBox *m_align;
    QComboBox *m_beside;
    QPushButton *m_subtract;
};

} // namespace pellucid::ui
