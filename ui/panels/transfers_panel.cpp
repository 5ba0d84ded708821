// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/transfers_panel.h"

#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "ui/language/plain_tooltip.h"
#include "ui/language/reasons.h"
#include "ui/servers/transfer_queue.h"

namespace pellucid::ui {

namespace {

using archive::Transfer;
using archive::TransferState;

constexpr int idRole = Qt::UserRole;

} // namespace

TransfersPanel::TransfersPanel(TransferQueue &queue, QWidget *parent)
    : QWidget(parent), m_queue(queue), m_tree(new QTreeWidget),
      m_empty(new QLabel(tr("Nothing has been retrieved yet. Search for a study, and double-click "
                            "one that a server has."))),
      m_corner(new QPushButton(tr("Clear"))) {
    setObjectName("transfersPanel");
    setAttribute(Qt::WA_StyledBackground);
    m_tree->setObjectName("transfersTree");
    m_tree->setAccessibleName(tr("Transfers"));
    m_tree->setHeaderHidden(true);
    m_tree->setRootIsDecorated(false);
    m_tree->setColumnCount(2);
    m_tree->header()->setStretchLastSection(false);
    m_tree->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    m_tree->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
    m_tree->setContextMenuPolicy(Qt::CustomContextMenu);
    m_empty->setProperty("role", "muted");
    m_empty->setWordWrap(true);
    m_corner->setObjectName("clearTransfersButton");
    m_corner->setProperty("role", "link");
    m_corner->setToolTip(tr("Remove what has ended from the list; the images stay"));
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(14, 4, 10, 12);
    layout->addWidget(m_empty, 0, Qt::AlignTop);
    layout->addWidget(m_tree, 1);
    connect(&m_queue, &TransferQueue::changed, this, &TransfersPanel::list);
    connect(m_corner, &QPushButton::clicked, this, [this] { m_queue.clearFinished(); });
    connect(m_tree, &QWidget::customContextMenuRequested, this, &TransfersPanel::showMenu);
    list();
}

QWidget *TransfersPanel::corner() {
    return m_corner;
}

void TransfersPanel::list() {
    const auto &transfers = m_queue.transfers();
    m_empty->setVisible(transfers.empty());
    m_tree->setVisible(!transfers.empty());
    while (m_tree->topLevelItemCount() > int(transfers.size()))
        delete m_tree->takeTopLevelItem(0);
    for (int row = 0; row < int(transfers.size()); ++row) {
        const Transfer &transfer = transfers[std::size_t(row)];
        if (m_tree->topLevelItemCount() <= row)
            new QTreeWidgetItem(m_tree);
        QTreeWidgetItem *const item = m_tree->topLevelItem(row);
        const auto reason = task::Reason::decoded(transfer.reason);
        QString state;
        switch (transfer.state) {
        case TransferState::waiting:
            state = tr("waiting");
            break;
        case TransferState::running:
            state = transfer.total == 0 ? tr("listing")
                                        : tr("%1 of %2").arg(transfer.received).arg(transfer.total);
            break;
        case TransferState::complete:
            state = tr("%n images", "", int(transfer.total));
            break;
        case TransferState::incomplete:
            state = QString::fromUtf8("\u26A0 ") +
                    tr("%1 of %2").arg(transfer.received).arg(transfer.total);
            break;
        case TransferState::cancelled:
            state = tr("cancelled");
            break;
        }
        item->setText(0, QString::fromStdString(transfer.title) + ", " +
                             QString::fromStdString(transfer.server));
        item->setText(1, state);
        item->setData(0, idRole, qint64(transfer.id));
        const QString tip = reason ? plainToolTip(translated(*reason)) : QString();
        item->setToolTip(0, tip);
        item->setToolTip(1, tip);
    }
}

void TransfersPanel::showMenu(const QPoint &at) {
    const QTreeWidgetItem *const item = m_tree->itemAt(at);
    if (item == nullptr)
        return;
    const qint64 id = item->data(0, idRole).toLongLong();
    auto *menu = new QMenu(this);
    menu->setObjectName("transferMenu");
    menu->setAttribute(Qt::WA_DeleteOnClose);
    for (const Transfer &transfer : m_queue.transfers()) {
        if (transfer.id != id)
            continue;
        if (transfer.state > TransferState::complete)
            connect(menu->addAction(tr("Try again")), &QAction::triggered, this,
                    [this, id] { m_queue.retry(id, window()); });
        if (transfer.state <= TransferState::running)
            connect(menu->addAction(tr("Cancel")), &QAction::triggered, this,
                    [this, id] { m_queue.cancel(id); });
    }
    if (menu->isEmpty())
        delete menu;
    else
        menu->popup(m_tree->viewport()->mapToGlobal(at));
}

} // namespace pellucid::ui
