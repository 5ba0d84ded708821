// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/transfers_panel.h"

#include <QHeaderView>
#include <QMenu>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "ui/language/reasons.h"
#include "ui/language/shown_text.h"
#include "ui/panels/server_targets.h"
#include "ui/servers/server_book.h"
#include "ui/servers/study_receiver.h"
#include "ui/servers/transfer_queue.h"
#include "ui/widgets/panel_background.h"
#include "ui/widgets/plain_label.h"

namespace pellucid::ui {

namespace {

using archive::Transfer;
using archive::TransferState;

constexpr int idRole = Qt::UserRole;

QString share(const Transfer &transfer) {
    return TransfersPanel::tr("%1 of %2")
        .arg(QString::number(transfer.received), QString::number(transfer.total));
}

} // namespace

TransfersPanel::TransfersPanel(TransferQueue &queue, StudyReceiver &receiver, ServerBook &servers,
                               QWidget *parent)
    : QWidget(parent), m_queue(queue), m_receiver(receiver), m_servers(servers),
      m_targets(new ServerTargets),
      m_dropHere(new PlainLabel(tr("Drop studies or files here to send:"))),
      m_receiving(new PlainLabel), m_tree(new QTreeWidget),
      m_empty(
          new PlainLabel(tr("Nothing has been retrieved yet. Search for a study, and double-click "
                            "one that a server has."))),
      m_corner(new QPushButton(tr("Clear"))) {
    setPanelBackground(*this, "transfersPanel");
    m_tree->setObjectName("transfersTree");
    m_tree->setAccessibleName(tr("Transfers"));
    m_tree->setHeaderHidden(true);
    m_tree->setRootIsDecorated(false);
    m_tree->setColumnCount(2);
    m_tree->header()->setStretchLastSection(false);
    m_tree->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    m_tree->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
    m_tree->setContextMenuPolicy(Qt::CustomContextMenu);
    m_receiving->setObjectName("receivingLabel");
    m_receiving->setProperty("role", "muted");
    m_receiving->setWordWrap(true);
    m_empty->setProperty("role", "muted");
    m_empty->setWordWrap(true);
    m_corner->setObjectName("clearTransfersButton");
    m_corner->setProperty("role", "link");
    m_corner->setToolTip(tr("Remove finished transfers from the list; the images stay"));
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(14, 4, 10, 12);
    layout->addWidget(m_receiving);
    layout->addWidget(m_empty, 0, Qt::AlignTop);
    layout->addWidget(m_tree, 1);
    layout->addWidget(m_dropHere);
    layout->addWidget(m_targets);
    m_dropHere->setProperty("role", "muted");
    m_dropHere->setWordWrap(true);
    connect(m_targets, &ServerTargets::dropped, this, &TransfersPanel::sendRequested);
    connect(&m_servers, &ServerBook::changed, this, &TransfersPanel::listServers);
    connect(&m_queue, &TransferQueue::changed, this, &TransfersPanel::list);
    connect(m_corner, &QPushButton::clicked, this, [this] { m_queue.clearFinished(); });
    connect(m_tree, &QWidget::customContextMenuRequested, this, &TransfersPanel::showMenu);
    connect(&m_receiver, &StudyReceiver::changed, this, &TransfersPanel::showReceiver);
    list();
    listServers();
    showReceiver();
}

QWidget *TransfersPanel::corner() {
    return m_corner;
}

void TransfersPanel::listServers() {
    m_targets->list(m_servers.names());
    m_dropHere->setVisible(!m_servers.servers().empty());
}

void TransfersPanel::showReceiver() {
    const ReceiverSettings &now = m_receiver.settings();
    m_receiving->setVisible(m_receiver.isListening() || m_receiver.failure());
    if (m_receiver.failure())
        m_receiving->setText(QString::fromUtf8("\u26A0 ") +
                             tr("Nothing is received: %1").arg(translated(*m_receiver.failure())));
    else if (m_receiver.isListening())
        m_receiving->setText(tr("%1 receives on port %2; %n objects have arrived", "",
                                int(m_receiver.receivedCount()))
                                 .arg(now.ae, QString::number(now.port)));
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
            state = transfer.total == 0 ? tr("listing") : share(transfer);
            break;
        case TransferState::complete:
            state = tr("%n images", "", int(transfer.total));
            break;
        case TransferState::incomplete:
            state = QString::fromUtf8("\u26A0 ") + share(transfer);
            break;
        case TransferState::cancelled:
            state = tr("cancelled");
            break;
        }
        const QString title = QString::fromStdString(transfer.title);
        item->setText(0, shownText((title.isEmpty() ? title : title + ", ") +
                                   QString::fromStdString(transfer.server)));
        item->setText(1, state);
        item->setData(0, idRole, qint64(transfer.id));
        for (const int column : {0, 1})
            item->setToolTip(column, plainToolTip(reason ? translated(*reason) : QString()));
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
