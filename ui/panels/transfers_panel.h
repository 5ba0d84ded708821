// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QPushButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace pellucid::ui {

class PlainLabel;
class ServerBook;
class ServerTargets;
class StudyReceiver;
class TransferQueue;

/// The retrievals from servers: how far each is, and why one is incomplete. A context menu retries
/// and cancels. Studies and files that are dropped on a server are sent to it.
class TransfersPanel : public QWidget {
    Q_OBJECT
public:
    TransfersPanel(TransferQueue &queue, StudyReceiver &receiver, ServerBook &servers,
                   QWidget *parent = nullptr);

    /// The button beside the panel's heading, which removes what has ended.
    QWidget *corner();

signals:
    void sendRequested(const QStringList &paths, const QString &server);

private:
    void list();
    void showMenu(const QPoint &at);

    void showReceiver();
    void listServers();

    TransferQueue &m_queue;
    StudyReceiver &m_receiver;
    ServerBook &m_servers;
    ServerTargets *m_targets;
    PlainLabel *m_dropHere, *m_receiving;
    QTreeWidget *m_tree;
    PlainLabel *m_empty;
    QPushButton *m_corner;
};

} // namespace pellucid::ui
