// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/earlier_panel.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "ui/language/reasons.h"
#include "ui/language/shown_text.h"
#include "ui/servers/earlier_studies.h"
#include "ui/widgets/panel_background.h"
#include "ui/widgets/plain_label.h"
#include "ui/widgets/question.h"

namespace pellucid::ui {

namespace {

constexpr int indexRole = Qt::UserRole, uidRole = Qt::UserRole + 1;

// The patient as a study names it, to be compared by eye.
QString identityText(const StudyFacts &study) {
    return QString("%1, %2, ID %3")
        .arg(patientText(study), dateText(study.birthDate), shownText(study.patientId));
}

QString placeText(const EarlierStudy &one) {
    if (one.isHere())
        return EarlierPanel::tr("here");
    // The others are in the tooltip: the date needs the room.
    const QString server = one.servers.size() > 1
                               ? one.servers[0] + " +" + QString::number(one.servers.size() - 1)
                               : one.servers.value(0);
    return one.instances > 0 ? EarlierPanel::tr("%1, %n images", "", one.instances).arg(server)
                             : server;
}

} // namespace

EarlierPanel::EarlierPanel(EarlierStudies &studies, QWidget *parent)
    : QWidget(parent), m_studies(studies), m_tree(new QTreeWidget), m_state(new PlainLabel),
      m_inAdvance(new QComboBox) {
    setPanelBackground(*this, "earlierPanel");
    m_tree->setObjectName("earlierTree");
    m_tree->setAccessibleName(tr("Prior studies"));
    m_tree->setHeaderHidden(true);
    m_tree->setIndentation(0);
    m_tree->setRootIsDecorated(false);
    m_tree->setColumnCount(2);
    m_tree->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_tree->header()->setStretchLastSection(false);
    m_tree->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    m_tree->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
    m_state->setObjectName("earlierState");
    m_state->setProperty("role", "muted");
    m_state->setWordWrap(true);
    m_inAdvance->setObjectName("inAdvanceBox");
    m_inAdvance->setToolTip(
        tr("Retrieves the latest prior studies of the same modality when a study is opened"));
    m_inAdvance->addItems(
        {tr("none"), tr("the latest"), tr("the latest two"), tr("the latest three")});
    m_inAdvance->setCurrentIndex(studies.inAdvance());
    auto *label = new PlainLabel(tr("Prefetch prior studies"));
    label->setBuddy(m_inAdvance);
    auto *choice = new QHBoxLayout;
    choice->addWidget(label);
    choice->addWidget(m_inAdvance, 1);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(14, 4, 10, 12);
    layout->addWidget(m_state, 0, Qt::AlignTop);
    layout->addWidget(m_tree, 1);
    layout->addLayout(choice);
    connect(&m_studies, &EarlierStudies::changed, this, &EarlierPanel::list);
    connect(m_inAdvance, &QComboBox::activated, this,
            [this](int count) { m_studies.setInAdvance(count); });
    const auto open = [this](const QTreeWidgetItem *item) {
        if (item != nullptr)
            activate(*item);
    };
    connect(m_tree, &QTreeWidget::itemClicked, this, open);
    m_tree->installEventFilter(this);
    list();
}

// Enter, which some styles also make of a click.
bool EarlierPanel::eventFilter(QObject *watched, QEvent *event) {
    if (watched == m_tree && event->type() == QEvent::KeyPress) {
        const int key = static_cast<QKeyEvent *>(event)->key();
        if ((key == Qt::Key_Return || key == Qt::Key_Enter) && m_tree->currentItem() != nullptr) {
            activate(*m_tree->currentItem());
            return true;
        }
    }
    return QWidget::eventFilter(watched, event);
}

void EarlierPanel::showEvent(QShowEvent *event) {
    QWidget::showEvent(event);
    m_studies.setShown(true);
}

void EarlierPanel::hideEvent(QHideEvent *event) {
    QWidget::hideEvent(event);
    m_studies.setShown(false);
}

void EarlierPanel::changeEvent(QEvent *event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) // a heading has a color of the theme
        list();
}

void EarlierPanel::list() {
    const QString current = m_tree->currentItem() == nullptr
                                ? QString()
                                : m_tree->currentItem()->data(0, uidRole).toString();
    m_tree->clear();
    bool isCertain = true;
    for (std::size_t n = 0; n < m_studies.studies().size(); ++n) {
        const EarlierStudy &one = m_studies.studies()[n];
        if (isCertain && !one.isCertain) {
            isCertain = false;
            auto *const heading = new QTreeWidgetItem(m_tree, {tr("Possibly a different patient")});
            heading->setFlags(Qt::ItemIsEnabled);
            heading->setFirstColumnSpanned(true);
            heading->setForeground(0, palette().brush(QPalette::Disabled, QPalette::Text));
            heading->setData(0, indexRole, -1);
        }
        auto *const item = new QTreeWidgetItem(
            m_tree, {one.isCertain ? studyText(one.study)
                                   : patientText(one.study) + ", " + studyText(one.study),
                     shownText(placeText(one))});
        item->setData(0, indexRole, int(n));
        item->setData(0, uidRole, one.study.uid);
        if (!current.isEmpty() && one.study.uid == current)
            m_tree->setCurrentItem(item);
        const QString tip = tr("Click to open it side by side") + "\n" + identityText(one.study) +
                            "\n" + one.servers.join(", ");
        for (const int column : {0, 1})
            item->setToolTip(column, plainToolTip(tip));
    }
    QStringList texts;
    if (m_studies.isSearching())
        texts << tr("Searching...");
    else if (m_studies.studies().empty() && m_studies.hasOpenStudy())
        texts << tr("No other study of this patient is known.");
    // As above the studies: the names here, the reasons in the tooltip.
    QStringList silent, reasons;
    for (const auto &[server, reason] : m_studies.failures()) {
        silent << server;
        reasons << server + ": " + translated(reason);
    }
    if (!silent.isEmpty())
        texts << QString::fromUtf8("\u26A0 ") + silent.join(", ");
    if (!m_studies.limited().isEmpty())
        texts << tr("%1: more results than shown").arg(m_studies.limited().join(", "));
    m_state->setToolTip(plainToolTip(reasons.join("\n")));
    m_state->setText(texts.join("\n"));
    m_state->setVisible(!texts.isEmpty());
    m_tree->setVisible(m_tree->topLevelItemCount() > 0);
}

void EarlierPanel::activate(const QTreeWidgetItem &item) {
    const int index = item.data(0, indexRole).toInt();
    if (index < 0 || index >= int(m_studies.studies().size()))
        return;
    const EarlierStudy chosen = m_studies.studies()[std::size_t(index)];
    if (chosen.isCertain) {
        emit besideRequested(chosen);
        return;
    }
    ask(window(),
        {"otherPatientQuestion", tr("Possibly a different patient"),
         tr("This study may belong to a different patient:\n%1\n\nOpen it side by side?")
             .arg(identityText(chosen.study)),
         tr("Open")},
        [this, chosen] { emit besideRequested(chosen); });
}

} // namespace pellucid::ui
