// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QUrl>
#include <QWidget>

class QLineEdit;
class QTextBrowser;
class QTreeWidget;

namespace pellucid::ui {

class PlainLabel;

/// The manual: its contents, made from its headings, beside its text, and a search.
class ManualWindow : public QWidget {
    Q_OBJECT
public:
    explicit ManualWindow(const QUrl &page);

private:
    void listContents();
    void goTo(int position);
    void search();
    void findNext(int step);
    void showFound();
    void followScrolling();

    QLineEdit *m_search;
    PlainLabel *m_count;
    QTreeWidget *m_contents;
    QTextBrowser *m_text;
    QList<int> m_found; ///< positions in the text
    int m_shown = -1;   ///< of them
};

} // namespace pellucid::ui
