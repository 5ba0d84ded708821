// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/theme/theme.h"

class QLabel;
class QListWidget;

namespace pellucid::ui {

class Document;

/// What openings and imports did not use, and why, until it is cleared: one list, not a message for
/// each file. Many files of one reason are one row. Hidden while there is nothing to say.
class ProblemList : public QWidget {
    Q_OBJECT
public:
    ProblemList(Document &document, const Theme &theme, QWidget *parent = nullptr);

protected:
    void resizeEvent(QResizeEvent *event) override;

private:
    void showProblems();
    void fitHeight();

    Document &m_document;
    Theme m_theme;
    QLabel *m_heading;
    QListWidget *m_list;
};

} // namespace pellucid::ui
