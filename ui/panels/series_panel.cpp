// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/series_panel.h"

#include <QHeaderView>
#include <QLabel>
#include <QListWidget>
#include <QSize>
#include <QTreeWidget>
#include <QTreeWidgetItemIterator>
#include <QVBoxLayout>

#include "ui/document.h"

namespace pellucid::ui {

namespace {

constexpr int sourceRole = Qt::UserRole, keyRole = Qt::UserRole + 1;

// The row of a patient or a study, made if it is not there. Rows are told apart by key: two
// patients may have one name.
QTreeWidgetItem *rowFor(QTreeWidget *tree, QTreeWidgetItem *parent, const QString &key,
                        const QString &name) {
    const int count = parent != nullptr ? parent->childCount() : tree->topLevelItemCount();
    for (int n = 0; n < count; ++n) {
        QTreeWidgetItem *item = parent != nullptr ? parent->child(n) : tree->topLevelItem(n);
        if (item->data(0, keyRole).toString() == key)
            return item;
    }
    auto *item =
        parent != nullptr ? new QTreeWidgetItem(parent, {name}) : new QTreeWidgetItem(tree, {name});
    item->setData(0, keyRole, key);
    return item;
}

} // namespace

SeriesPanel::SeriesPanel(Document &document, const Theme &theme, QWidget *parent)
    : QWidget(parent), m_document(document), m_theme(theme), m_tree(new QTreeWidget),
      m_problemHeading(new QLabel), m_problems(new QListWidget) {
    setObjectName("seriesPanel");
    m_tree->setObjectName("seriesTree");
    m_tree->setAccessibleName(tr("Studies"));
    m_tree->setToolTip(tr("Click a series to open it"));
    m_tree->setHeaderHidden(true);
    m_tree->setIndentation(12);
    m_tree->setWordWrap(true);
    m_tree->setUniformRowHeights(false);
    m_tree->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_tree->header()->setSectionResizeMode(QHeaderView::Stretch);
    m_problems->setObjectName("problemList");
    m_problems->setAccessibleName(tr("Problems"));
    m_problems->setToolTip(tr("Files that are not used, and why"));
    m_problems->setWordWrap(true);
    m_problems->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_problems->setMaximumHeight(170);
    m_problemHeading->setProperty("role", "heading");
    m_problemHeading->setObjectName("problemHeading");
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(14, 4, 10, 12);
    layout->setSpacing(4);
    layout->addWidget(m_tree, 1);
    layout->addWidget(m_problemHeading);
    layout->addWidget(m_problems);
    connect(&document, &Document::sourcesChanged, this, &SeriesPanel::showSources);
    connect(&document, &Document::currentSourceChanged, this, &SeriesPanel::showCurrent);
    connect(&document, &Document::problemsChanged, this, &SeriesPanel::showProblems);
    const auto activate = [this](QTreeWidgetItem *item) {
        if (item->data(0, sourceRole).isValid())
            emit sourceActivated(item->data(0, sourceRole).toInt());
    };
    connect(m_tree, &QTreeWidget::itemClicked, this, activate);
    connect(m_tree, &QTreeWidget::itemActivated, this, activate);
    showProblems();
}

void SeriesPanel::showSources() {
    m_tree->clear();
    const auto &sources = m_document.sources();
    for (std::size_t n = 0; n < sources.size(); ++n) {
        const StudySource &source = sources[n];
        QTreeWidgetItem *patient = rowFor(m_tree, nullptr, source.patientKey, source.patient);
        patient->setToolTip(0, source.patientKey.section('\n', 0, 0));
        QFont bold = font();
        bold.setBold(true);
        patient->setFont(0, bold);
        QTreeWidgetItem *study = rowFor(m_tree, patient, source.studyKey,
                                        source.study.isEmpty() ? tr("Study") : source.study);
        study->setForeground(0, m_theme.color("muted"));
        QString text = source.series + "\n" + source.detail;
        auto *item = new QTreeWidgetItem(study, {text});
        item->setData(0, sourceRole, int(n));
        // The view would elide all but the first lines of a text with line breaks.
        item->setSizeHint(0,
                          QSize(0, int(text.count('\n') + 1) * fontMetrics().lineSpacing() + 12));
        item->setToolTip(0, (QStringList{source.series} + source.warnings).join("\n"));
        if (!source.warnings.isEmpty()) {
            auto *warning = new QTreeWidgetItem(item, {source.warnings.join("\n")});
            warning->setForeground(0, m_theme.color("warning"));
            warning->setToolTip(0, source.warnings.join("\n"));
            const QRect needed = fontMetrics().boundingRect(
                QRect(0, 0, 190, 1000), Qt::TextWordWrap, source.warnings.join("\n"));
            warning->setSizeHint(0, QSize(0, needed.height() + 8));
            warning->setFlags(Qt::ItemIsEnabled);
            item->setExpanded(true);
        }
    }
    m_tree->expandAll();
    showCurrent();
}

void SeriesPanel::showCurrent() {
    for (QTreeWidgetItemIterator it(m_tree); *it != nullptr; ++it) {
        const QVariant source = (*it)->data(0, sourceRole);
        if (source.isValid() && source.toInt() == m_document.currentSource()) {
            m_tree->setCurrentItem(*it);
            return;
        }
    }
    m_tree->setCurrentItem(nullptr);
}

void SeriesPanel::showProblems() {
    m_problems->clear();
    const auto &problems = m_document.problems();
    for (const dicom::Skipped &problem : problems) {
        const QString name = QString::fromStdString(problem.path.filename().string());
        const QString reason = QString::fromStdString(problem.reason);
        auto *item =
            new QListWidgetItem(name.isEmpty() ? reason : name + ": " + reason, m_problems);
        item->setToolTip(QString::fromStdString(problem.path.string()));
        // Files that are no images at all are no errors.
        if (reason.startsWith("is not a DICOM") || reason.startsWith("has no pixels"))
            item->setForeground(m_theme.color("muted"));
    }
    m_problemHeading->setText(tr("PROBLEMS (%1)").arg(problems.size()));
    m_problemHeading->setVisible(!problems.empty());
    m_problems->setVisible(!problems.empty());
}

} // namespace pellucid::ui
