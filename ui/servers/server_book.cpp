// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/servers/server_book.h"

#include <algorithm>
#include <deque>
#include <memory>

#include <QInputDialog>
#include <QPointer>

#include <qt6keychain/keychain.h>

#include "core/task/error.h"

namespace pellucid::ui {

namespace {

const QString service = "Pellucid";

// With its address: the secret of one server is never sent to another one of the same name.
QString secretKey(const archive::Server &server) {
    return QString("%1/secret/%2:%3")
        .arg(QString::fromStdString(server.name), QString::fromStdString(server.peer.host))
        .arg(server.peer.port);
}

QString keyPasswordKey(const archive::Server &server) {
    return QString::fromStdString(server.name) + "/key";
}

} // namespace

// The servers that still need secrets, one after the other.
struct ServerBook::Pending {
    struct Need {
        std::size_t server;
        bool isOfKey;
        QString key, question;
    };
    std::vector<archive::Server> servers;
    std::vector<bool> isLeftOut;
    std::deque<Need> needs;
    QPointer<QWidget> asking;
    Use use;

    void set(const QString &secret) {
        const Need need = needs.front();
        archive::Server &server = servers[need.server];
        (need.isOfKey ? server.peer.keyPassword : server.peer.secret) = secret.toStdString();
        needs.pop_front();
    }
    void leaveOut() {
        isLeftOut[needs.front().server] = true;
        needs.pop_front();
    }
};

ServerBook::ServerBook(QObject *parent) : QObject(parent) {
    load();
}

void ServerBook::load() {
    try {
        m_servers = archive::ServerList::ofUser().servers();
    } catch (const task::Error &error) {
        m_servers.clear();
        // After the window has connected to the signal.
        QMetaObject::invokeMethod(
            this,
            [this, error] {
                emit failed(error.reason(), QString::fromStdString(error.path().string()));
            },
            Qt::QueuedConnection);
    }
}

QStringList ServerBook::names() const {
    QStringList names;
    for (const archive::Server &server : m_servers)
        names << QString::fromStdString(server.name);
    return names;
}

void ServerBook::put(const archive::Server &server) {
    archive::ServerList::ofUser().put(server);
    const auto keep = [&](const QString &key, const std::string &secret) {
        if (secret.empty())
            return;
        const QString text = QString::fromStdString(secret);
        m_known[key] = text;
        auto *job = new QKeychain::WritePasswordJob(service, this); // deletes itself
        job->setKey(key);
        job->setTextData(text);
        job->start();
    };
    keep(secretKey(server), server.peer.secret);
    keep(keyPasswordKey(server), server.peer.keyPassword);
    load();
    emit changed();
}

void ServerBook::remove(const QString &name) {
    archive::ServerList::ofUser().remove(name.toStdString());
    for (const archive::Server &server : m_servers)
        if (QString::fromStdString(server.name) == name)
            for (const QString &key : {secretKey(server), keyPasswordKey(server)}) {
                m_known.remove(key);
                auto *job = new QKeychain::DeletePasswordJob(service, this);
                job->setKey(key);
                job->start();
            }
    load();
    emit changed();
}

void ServerBook::withSecrets(const QStringList &names, QWidget *asking, const Use &use) {
    auto pending = std::make_shared<Pending>();
    pending->asking = asking;
    pending->use = use;
    for (const archive::Server &server : m_servers) {
        const QString name = QString::fromStdString(server.name);
        if (!names.contains(name))
            continue;
        const std::size_t at = pending->servers.size();
        pending->servers.push_back(server);
        pending->isLeftOut.push_back(false);
        const exchange::Peer &peer = server.peer;
        if (peer.authentication == exchange::Authentication::basic)
            pending->needs.push_back(
                {at, false, secretKey(server),
                 tr("Password of %1 at %2").arg(QString::fromStdString(peer.user), name)});
        else if (peer.authentication == exchange::Authentication::bearer)
            pending->needs.push_back({at, false, secretKey(server), tr("Token for %1").arg(name)});
        if (archive::isEncryptedKey(peer.key))
            pending->needs.push_back({at, true, keyPasswordKey(server),
                                      tr("Password of the private key for %1").arg(name)});
    }
    fetchNext(pending);
}

void ServerBook::fetchNext(const std::shared_ptr<Pending> &pending) {
    while (!pending->needs.empty()) {
        const auto &need = pending->needs.front();
        if (pending->isLeftOut[need.server]) {
            pending->needs.pop_front();
        } else if (const auto known = m_known.constFind(need.key); known != m_known.constEnd()) {
            pending->set(*known);
        } else {
            auto *job = new QKeychain::ReadPasswordJob(service, this);
            job->setKey(need.key);
            connect(job, &QKeychain::Job::finished, this,
                    [this, pending, job, key = need.key, question = need.question] {
                        if (job->error() == QKeychain::NoError) {
                            m_known[key] = job->textData();
                            fetchNext(pending);
                        } else {
                            ask(pending, key, question);
                        }
                    });
            job->start();
            return;
        }
    }
    std::vector<archive::Server> servers;
    for (std::size_t n = 0; n < pending->servers.size(); ++n)
        if (!pending->isLeftOut[n])
            servers.push_back(pending->servers[n]);
    pending->use(servers);
}

void ServerBook::forgetSecret(const QString &name) {
    for (const archive::Server &server : m_servers)
        if (QString::fromStdString(server.name) == name)
            m_known.remove(secretKey(server));
}

void ServerBook::ask(const std::shared_ptr<Pending> &pending, const QString &key,
                     const QString &question) {
    if (pending->asking == nullptr) {
        pending->leaveOut();
        fetchNext(pending);
        return;
    }
    auto *dialog = new QInputDialog(pending->asking);
    dialog->setObjectName("secretDialog");
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(tr("Server"));
    dialog->setLabelText(question);
    dialog->setTextEchoMode(QLineEdit::Password);
    connect(dialog, &QInputDialog::textValueSelected, this, [this, key](const QString &text) {
        m_known[key] = text; // for this run
    });
    connect(dialog, &QDialog::finished, this, [this, pending, key] {
        if (!m_known.contains(key))
            pending->leaveOut();
        fetchNext(pending);
    });
    dialog->open();
}

} // namespace pellucid::ui
