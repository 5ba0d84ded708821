// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/problem_list.h"

#include <algorithm>
#include <map>

#include <QHBoxLayout>
#include <QListWidget>
#include <QPushButton>
#include <QVBoxLayout>

#include "core/decoding/client/reasons.h"
#include "core/dicom/reasons.h"
#include "core/files/reasons.h"
#include "ui/document/document.h"
#include "ui/language/reasons.h"
#include "ui/language/shown_text.h"
#include "ui/theme/theme.h"
#include "ui/widgets/form.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

namespace {

namespace because = task::because;

// More files than this with the same reason share a row; a tooltip names at most this many paths.
constexpr std::size_t maxRows = 3, maxTipPaths = 20;
constexpr int maxHeight = 170;

// Files that are not images are not errors.
bool isNoImage(const task::Reason &reason) {
    return reason.is(because::isNotDicom) || reason.is(because::hasNoPixels) ||
           reason.is(because::hasNoPixelsBut) || reason.is(because::isAnIndex) ||
           reason.is(because::isAnArchive) || reason.is(because::otherFiles);
}

} // namespace

ProblemList::ProblemList(Document &document, QWidget *parent)
    : QWidget(parent), m_document(document), m_heading(new PlainLabel), m_list(new QListWidget) {
    m_list->setObjectName("problemList");
    m_list->setAccessibleName(tr("Problems"));
    m_list->setToolTip(tr("Files not used, and why"));
    m_list->setWordWrap(true);
    m_list->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
    m_heading->setProperty("role", "heading");
    m_heading->setObjectName("problemHeading");
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(4);
    auto *clear = makeLink(tr("Clear"), "clearProblemsButton", tr("Clear the list"));
    connect(clear, &QPushButton::clicked, &document, &Document::clearProblems);
    auto *row = new QHBoxLayout;
    row->addWidget(m_heading, 1);
    row->addWidget(clear);
    layout->addLayout(row);
    layout->addWidget(m_list);
    document.whenever(Change::problems, this, &ProblemList::showProblems);
    showProblems();
}

void ProblemList::changeEvent(QEvent *event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) // the rows have a color of the theme
        showProblems();
}

void ProblemList::showProblems() {
    m_list->clear();
    const auto &problems = m_document.problems();
    std::map<std::string, std::vector<const dicom::Skipped *>> byReason;
    std::vector<const task::Reason *> order;
    for (const dicom::Skipped &problem : problems) {
        auto &same = byReason[problem.reason.encoded()];
        if (same.empty())
            order.push_back(&problem.reason);
        same.push_back(&problem);
    }
    const dicom::Skipped *const last = problems.empty() ? nullptr : &problems.back();
    QListWidgetItem *rowOfLast = nullptr;
    const auto add = [this](const QString &text, const QString &tip, const task::Reason &reason) {
        auto *item = new QListWidgetItem(text, m_list);
        item->setToolTip(plainToolTip(tip));
        if (isNoImage(reason))
            item->setForeground(Theme::current().color("muted"));
        return item;
    };
    for (const task::Reason *reason : order) {
        const auto &same = byReason[reason->encoded()];
        const QString why = translated(*reason);
        QStringList paths;
        for (const dicom::Skipped *problem : same)
            paths << QString::fromStdString(problem->path.string());
        if (same.size() > maxRows) {
            QString tip = paths.mid(0, maxTipPaths).join("\n");
            if (same.size() > maxTipPaths)
                tip += "\n" + tr("and %n more", "", int(same.size() - maxTipPaths));
            auto *const row = add(tr("%n files: %1", "", int(same.size())).arg(why), tip, *reason);
            if (same.back() == last)
                rowOfLast = row;
            continue;
        }
        for (std::size_t n = 0; n < same.size(); ++n) {
            const QString name =
                shownText(QString::fromStdString(same[n]->path.filename().string()));
            auto *const row = add(name.isEmpty() ? why : name + ": " + why, paths[int(n)], *reason);
            if (same[n] == last)
                rowOfLast = row;
        }
    }
    fitHeight();
    if (rowOfLast != nullptr)
        m_list->scrollToItem(rowOfLast);
    // Texts and programs beside images are mentioned, but no problem.
    const auto count =
        std::count_if(problems.begin(), problems.end(), [](const dicom::Skipped &problem) {
            return !problem.reason.is(because::otherFiles);
        });
    m_heading->setText(count > 0 ? tr("PROBLEMS (%1)").arg(count) : tr("NOT USED"));
    setVisible(!problems.empty());
}

// Fits the height to the wrapped lines, up to a maximum.
void ProblemList::fitHeight() {
    m_list->doItemsLayout();
    int height = 2 * m_list->frameWidth() + 2;
    for (int row = 0; row < m_list->count() && height < maxHeight; ++row)
        height += std::max(m_list->sizeHintForRow(row),
                           m_list->visualItemRect(m_list->item(row)).height());
    m_list->setFixedHeight(std::min(height, maxHeight));
}

void ProblemList::resizeEvent(QResizeEvent *event) {
    QWidget::resizeEvent(event);
    fitHeight();
}

} // namespace pellucid::ui
