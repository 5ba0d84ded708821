// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

class QLocalServer;

namespace pellucid::ui {

/// Where the running program takes links from a second one that was started with them. Of several
/// programs, the oldest has the port; when it ends, another one takes it. Only the same user can
/// reach it.
class LinkPort : public QObject {
    Q_OBJECT
public:
    explicit LinkPort(QObject *parent = nullptr);

    /// Gives a link to a program that is running; false if there is none.
    static bool handOver(const QString &link);

signals:
    void linkReceived(const QString &link);

private:
    void listen();
    void takeAll();

    QLocalServer *m_server;
};

} // namespace pellucid::ui
