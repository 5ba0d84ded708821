// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QLabel;
class QPushButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace pellucid::ui {

class TransferQueue;

/// The retrievals from servers: how far each is, and why one is incomplete. A context menu retries
/// and cancels.
class TransfersPanel : public QWidget {
    Q_OBJECT
public:
    explicit TransfersPanel(TransferQueue &queue, QWidget *parent = nullptr);

    /// The button beside the panel's heading, which removes what has ended.
    QWidget *corner();

private:
    void list();
    void showMenu(const QPoint &at);

    TransferQueue &m_queue;
    QTreeWidget *m_tree;
    QLabel *m_empty;
    QPushButton *m_corner;
};

} // namespace pellucid::ui
