// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QListWidget>

namespace pellucid::ui {

/// The servers, each of which takes files and studies that are dropped on it.
class ServerTargets : public QListWidget {
    Q_OBJECT
public:
    explicit ServerTargets(QWidget *parent = nullptr);

    void list(const QStringList &servers);

signals:
    /// Files, or folders with files, for a server.
    void dropped(const QStringList &paths, const QString &server);

protected:
    void dragEnterEvent(QDragEnterEvent *event) override;
    void dragMoveEvent(QDragMoveEvent *event) override;
    void dropEvent(QDropEvent *event) override;

private:
    QListWidgetItem *targetOf(const QDropEvent &event) const;
};

} // namespace pellucid::ui
