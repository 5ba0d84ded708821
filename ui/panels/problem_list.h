// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/theme.h"

class QLabel;
class QListWidget;

namespace pellucid::ui {

class Document;

/// What the last opening or import did not use, and why: one list, not a message for each file.
/// Many files of one reason are one row. Hidden while there is nothing to say.
class ProblemList : public QWidget {
    Q_OBJECT
public:
    ProblemList(Document &document, const Theme &theme, QWidget *parent = nullptr);

private:
    void showProblems();

    Document &m_document;
    Theme m_theme;
    QLabel *m_heading;
    QListWidget *m_list;
};

} // namespace pellucid::ui
