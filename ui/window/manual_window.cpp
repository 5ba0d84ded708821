// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/manual_window.h"

#include <algorithm>

#include <QHBoxLayout>
#include <QLineEdit>
#include <QScreen>
#include <QScrollBar>
#include <QShortcut>
#include <QSignalBlocker>
#include <QSplitter>
#include <QTextBlock>
#include <QTextBrowser>
#include <QToolButton>
#include <QTreeWidget>
#include <QTreeWidgetItemIterator>
#include <QVBoxLayout>

#include "ui/language/plain_label.h"

namespace pellucid::ui {

namespace {

constexpr int positionRole = Qt::UserRole;
// One letter would find most of the text.
constexpr int shortestSearch = 2;

} // namespace

ManualWindow::ManualWindow(const QUrl &page)
    : m_search(new QLineEdit), m_count(new PlainLabel), m_contents(new QTreeWidget),
      m_text(new QTextBrowser) {
    setObjectName("manualWindow");
    setAttribute(Qt::WA_DeleteOnClose);
    setAttribute(Qt::WA_QuitOnClose, false); // closing the main window ends the program
    setWindowTitle(tr("Pellucid manual"));
    m_search->setObjectName("manualSearch");
    m_search->setPlaceholderText(tr("Search the manual"));
    m_search->setAccessibleName(tr("Search the manual"));
    m_search->setClearButtonEnabled(true);
    m_search->setToolTip(tr("Enter: next place; Shift+Enter: previous place"));
    m_count->setObjectName("manualCount");
    m_count->setProperty("role", "muted");
    m_contents->setObjectName("manualContents");
    m_contents->setAccessibleName(tr("Contents"));
    m_contents->setHeaderHidden(true);
    m_text->setObjectName("manual");
    m_text->setSource(page);
    auto *left = new QWidget;
    auto *column = new QVBoxLayout(left);
    column->setContentsMargins(10, 10, 4, 10);
    column->addWidget(m_search);
    column->addWidget(m_count);
    column->addWidget(m_contents, 1);
    auto *parts = new QSplitter;
    parts->addWidget(left);
    parts->addWidget(m_text);
    parts->setStretchFactor(1, 1);
    parts->setSizes({250, 750});
    auto *row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->addWidget(parts);
    resize(QSize(1040, 800).boundedTo(screen()->availableGeometry().size() - QSize(16, 44)));
    listContents();
    connect(m_contents, &QTreeWidget::itemClicked, this,
            [this](const QTreeWidgetItem *item) { goTo(item->data(0, positionRole).toInt()); });
    connect(m_contents, &QTreeWidget::itemActivated, this,
            [this](const QTreeWidgetItem *item) { goTo(item->data(0, positionRole).toInt()); });
    connect(m_search, &QLineEdit::textChanged, this, &ManualWindow::search);
    connect(m_search, &QLineEdit::returnPressed, this, [this] { findNext(1); });
    connect(
        new QShortcut(QKeySequence("Shift+Return"), m_search, nullptr, nullptr, Qt::WidgetShortcut),
        &QShortcut::activated, this, [this] { findNext(-1); });
    connect(new QShortcut(QKeySequence::Find, this), &QShortcut::activated, m_search,
            qOverload<>(&QWidget::setFocus));
    connect(new QShortcut(Qt::Key_Escape, this), &QShortcut::activated, this, [this] {
        if (m_search->text().isEmpty())
            close();
        else
            m_search->clear();
    });
    connect(m_text->verticalScrollBar(), &QScrollBar::valueChanged, this,
            &ManualWindow::followScrolling);
    m_search->setFocus();
}

void ManualWindow::listContents() {
    constexpr int chapter = 3;
    QTreeWidgetItem *above = nullptr;
    for (QTextBlock block = m_text->document()->begin(); block.isValid(); block = block.next()) {
        const int level = block.blockFormat().headingLevel();
        if (level < chapter)
            continue;
        auto *item = level == chapter || above == nullptr ? new QTreeWidgetItem(m_contents)
                                                          : new QTreeWidgetItem(above);
        item->setText(0, block.text());
        item->setData(0, positionRole, block.position());
        if (level == chapter)
            above = item;
    }
}

// Puts the line at the top.
void ManualWindow::goTo(int position) {
    QTextCursor cursor(m_text->document());
    cursor.setPosition(position);
    m_text->setTextCursor(cursor);
    constexpr int margin = 8;
    QScrollBar *const bar = m_text->verticalScrollBar();
    bar->setValue(bar->value() + m_text->cursorRect().top() - margin);
}

void ManualWindow::search() {
    m_found.clear();
    m_shown = -1;
    QList<QTextEdit::ExtraSelection> marks;
    const QString wanted = m_search->text().trimmed();
    // A single East Asian character can be a word.
    const bool isLong = wanted.size() >= shortestSearch ||
                        (!wanted.isEmpty() && wanted.front().unicode() >= 0x2E80);
    for (QTextCursor at(m_text->document()); isLong;) {
        at = m_text->document()->find(wanted, at);
        if (at.isNull())
            break;
        m_found << at.selectionStart();
        QTextEdit::ExtraSelection mark;
        mark.cursor = at;
        mark.format.setBackground(palette().highlight());
        mark.format.setForeground(palette().highlightedText());
        marks << mark;
    }
    m_text->setExtraSelections(marks);
    if (!m_found.isEmpty())
        findNext(1);
    showFound();
}

void ManualWindow::findNext(int step) {
    if (m_found.isEmpty())
        return;
    const auto count = int(m_found.size());
    m_shown = ((m_shown + step) % count + count) % count;
    goTo(m_found[m_shown]);
    showFound();
}

void ManualWindow::showFound() {
    if (m_search->text().trimmed().isEmpty())
        m_count->clear();
    else
        m_count->setText(m_found.isEmpty() ? tr("Nothing found")
                                           : tr("%1 of %2")
                                                 .arg(QString::number(m_shown + 1),
                                                      QString::number(m_found.size())));
}

// Marks the section at the top of the window.
void ManualWindow::followScrolling() {
    const int top = m_text->cursorForPosition({20, 24}).position();
    QTreeWidgetItem *current = nullptr;
    for (QTreeWidgetItemIterator it(m_contents); *it != nullptr; ++it)
        if ((*it)->data(0, positionRole).toInt() <= top)
            current = *it;
    const QSignalBlocker quiet(m_contents);
    m_contents->setCurrentItem(current);
}

} // namespace pellucid::ui
