// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/link_port.h"

#include <QLocalServer>
#include <QLocalSocket>
#include <QStandardPaths>

namespace pellucid::ui {

namespace {

constexpr int waitMs = 1000;
constexpr qint64 longestLink = 1024;

// In a folder of the user, which others cannot enter.
QString portPath() {
    const QString folder = QStandardPaths::writableLocation(QStandardPaths::RuntimeLocation);
    return folder.isEmpty() ? QString() : folder + "/pellucid-links";
}

} // namespace

LinkPort::LinkPort(QObject *parent) : QObject(parent), m_server(new QLocalServer(this)) {
    m_server->setSocketOptions(QLocalServer::UserAccessOption);
    connect(m_server, &QLocalServer::newConnection, this, &LinkPort::takeAll);
    listen();
}

void LinkPort::listen() {
    const QString path = portPath();
    if (path.isEmpty())
        return;
    // First, because listening would take the port from another program that has it.
    auto *const other = new QLocalSocket(this);
    other->connectToServer(path);
    if (other->waitForConnected(waitMs)) { // the connection stays until that one ends
        connect(other, &QLocalSocket::disconnected, this, [this, other] {
            other->deleteLater();
            listen();
        });
        return;
    }
    delete other;
    QLocalServer::removeServer(path); // left by a program that was killed
    m_server->listen(path);
}

bool LinkPort::handOver(const QString &link) {
    QLocalSocket socket;
    socket.connectToServer(portPath());
    if (portPath().isEmpty() || !socket.waitForConnected(waitMs))
        return false;
    socket.write(link.toUtf8() + "\n");
    // The other program answers when it has the whole line.
    return socket.waitForBytesWritten(waitMs) && socket.waitForReadyRead(waitMs);
}

void LinkPort::takeAll() {
    while (QLocalSocket *const socket = m_server->nextPendingConnection()) {
        connect(socket, &QLocalSocket::disconnected, socket, &QObject::deleteLater);
        const auto read = [this, socket] {
            if (!socket->canReadLine()) {
                if (socket->bytesAvailable() > longestLink)
                    socket->abort();
                return;
            }
            const QString link = QString::fromUtf8(socket->readLine(longestLink)).trimmed();
            socket->write("+");
            socket->flush();
            socket->disconnectFromServer();
            emit linkReceived(link);
        };
        connect(socket, &QLocalSocket::readyRead, this, read);
        read(); // it may have come before
    }
}

} // namespace pellucid::ui
