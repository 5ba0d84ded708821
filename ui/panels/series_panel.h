// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/theme.h"

class QLabel;
class QListWidget;
class QTreeWidget;

namespace pellucid::ui {

class Document;

/// The open studies as a tree, with their geometry warnings in the row they belong to, and the
/// problems of the last import below, in one list.
class SeriesPanel : public QWidget {
    Q_OBJECT
public:
    SeriesPanel(Document &document, const Theme &theme, QWidget *parent = nullptr);

signals:
    void sourceActivated(int index);

private:
    void showSources();
    void showCurrent();
    void showProblems();

    Document &m_document;
    Theme m_theme;
    QTreeWidget *m_tree;
    QLabel *m_problemHeading;
    QListWidget *m_problems;
};

} // namespace pellucid::ui
