// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QListWidget;

namespace pellucid::ui {

class Document;
class PlainLabel;

/// Lists the files that were not used when opening or importing, with reasons, until the user
/// clears it. Many files with the same reason share a row. Hidden while empty.
class ProblemList : public QWidget {
    Q_OBJECT
public:
    ProblemList(Document &document, QWidget *parent = nullptr);

protected:
    void resizeEvent(QResizeEvent *event) override;
    void changeEvent(QEvent *event) override;

private:
    void showProblems();
    void fitHeight();

    Document &m_document;
    PlainLabel *m_heading;
    QListWidget *m_list;
};

} // namespace pellucid::ui
