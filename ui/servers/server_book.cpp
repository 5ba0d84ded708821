// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/servers/server_book.h"

#include <algorithm>
#include <deque>
#include <memory>
#include <utility>

#include <QCoreApplication>
#include <QFileInfo>
#include <QInputDialog>
#include <QPointer>

#include <qt6keychain/keychain.h>

#include "core/files/user_folders.h"
#include "core/network/client/reasons.h"
#include "core/task/error.h"
#include "ui/jobs/job_runner.h"
#include "ui/language/shown_text.h"
#include "ui/servers/login_dialog.h"

namespace pellucid::ui {

namespace {

const QString service = "Pellucid";

// With its address: the secret of one server is never sent to another one of the same name.
QString secretKey(const archive::Server &server) {
    return QString("%1/secret/%2:%3")
        .arg(QString::fromStdString(server.name), QString::fromStdString(server.peer.host),
             QString::number(server.peer.port));
}

// With the addresses of both servers and the scope: a token goes to the login server that gave it,
// and allows what it was given for.
QString loginKey(const archive::Server &server) {
    const archive::LoginSettings &login = server.loginSettings;
    const QString address = QString::fromStdString(archive::addressOf(server.peer));
    return QString("%1/login/%2/%3/%4/%5")
        .arg(QString::fromStdString(server.name), address,
             QString::fromStdString(login.issuer.empty() ? login.tokenUrl : login.issuer),
             QString::fromStdString(login.clientId), QString::fromStdString(login.scope));
}

bool hasLogin(const archive::Server &server) {
    return server.peer.authentication == network::Authentication::oauth;
}

QString keyPasswordKey(const archive::Server &server) {
    return QString::fromStdString(server.name) + "/key";
}

} // namespace

// The servers that still need secrets, one after the other.
struct ServerBook::Pending {
    enum class Kind { secret, keyPassword, login };
    struct Need {
        std::size_t server;
        Kind kind;
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
        (need.kind == Kind::keyPassword ? server.peer.keyPassword : server.peer.secret) =
            secret.toStdString();
        needs.pop_front();
    }
    void set(const std::shared_ptr<archive::Login> &login) {
        servers[needs.front().server].login = login;
        needs.pop_front();
    }
    void leaveOut() {
        isLeftOut[needs.front().server] = true;
        needs.pop_front();
    }
};

ServerBook::ServerBook(QObject *parent) : QObject(parent) {
    load();
    watch();
}

void ServerBook::watch() {
    // The folder: each change makes a new file.
    const auto folder = files::userDataFolder();
    if (!folder)
        return;
    m_watcher.addPath(QString::fromStdString(folder->string()));
    const QString file = QString::fromStdString((*folder / "servers.json").string());
    m_changed = QFileInfo(file).lastModified();
    connect(&m_watcher, &QFileSystemWatcher::directoryChanged, this, [this, file] {
        // Other files of the folder change more often.
        const QDateTime written = QFileInfo(file).lastModified();
        if (std::exchange(m_changed, written) == written)
            return;
        const std::vector<archive::Server> former = m_servers;
        load();
        if (m_servers == former)
            return;
        for (const archive::Server &before : former)
            for (const archive::Server &now : m_servers)
                if (before.name == now.name && hasLogin(before))
                    replaceLogin(before, now);
        emit changed();
    });
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
    for (const archive::Server &former : m_servers)
        if (former.name == server.name && hasLogin(former))
            replaceLogin(former, server);
    // Nobody would find or remove it later.
    for (const archive::Server &former : m_servers)
        if (former.name == server.name && secretKey(former) != secretKey(server)) {
            m_known.remove(secretKey(former));
            forget(secretKey(former));
        }
    const auto keepText = [&](const QString &key, const std::string &secret) {
        if (secret.empty())
            return;
        m_known[key] = QString::fromStdString(secret);
        keep(key, m_known[key]);
    };
    keepText(secretKey(server), server.peer.secret);
    keepText(keyPasswordKey(server), server.peer.keyPassword);
    load();
    // The user has logged in while testing it.
    if (const QString key = loginKey(server); hasLogin(server) && m_unsavedTokens.contains(key))
        keep(key, m_unsavedTokens.take(key));
    emit changed();
}

void ServerBook::remove(const QString &name) {
    archive::ServerList::ofUser().remove(name.toStdString());
    for (const archive::Server &server : m_servers)
        if (QString::fromStdString(server.name) == name) {
            for (const QString &key : {secretKey(server), keyPasswordKey(server)}) {
                m_known.remove(key);
                forget(key);
            }
            if (hasLogin(server))
                forgetLogin(server);
        }
    load();
    emit changed();
}

// Jobs of the keychain delete themselves at their end, and may outlive the book: the library also
// calls a job that has been destroyed.
void ServerBook::keep(const QString &key, const QString &secret) {
    auto *job = new QKeychain::WritePasswordJob(service);
    job->setKey(key);
    job->setTextData(secret);
    job->start();
}

void ServerBook::forget(const QString &key) {
    auto *job = new QKeychain::DeletePasswordJob(service);
    job->setKey(key);
    job->start();
}

void ServerBook::replaceLogin(const archive::Server &former, const archive::Server &server) {
    const QString key = loginKey(former);
    if (!hasLogin(server) || loginKey(server) != key)
        forgetLogin(former);
    else if (!(server.loginSettings == former.loginSettings) ||
             server.peer.authorities != former.peer.authorities)
        m_logins.remove(key); // the next one has the new settings, and the token in the keychain
}

void ServerBook::forgetLogin(const archive::Server &server) {
    const QString key = loginKey(server);
    if (const auto login = m_logins.take(key))
        login->forget();
    m_unsavedTokens.remove(key);
    forget(key);
}

bool ServerBook::isSavedLogin(const QString &key) const {
    return std::any_of(m_servers.begin(), m_servers.end(), [&](const archive::Server &server) {
        return hasLogin(server) && loginKey(server) == key;
    });
}

void ServerBook::withSecrets(const QStringList &names, QWidget *asking, const Use &use) {
    std::vector<archive::Server> servers;
    for (const archive::Server &server : m_servers)
        if (names.contains(QString::fromStdString(server.name)))
            servers.push_back(server);
    withSecrets(servers, asking, use);
}

void ServerBook::withSecrets(const std::vector<archive::Server> &servers, QWidget *asking,
                             const Use &use) {
    using Kind = Pending::Kind;
    auto pending = std::make_shared<Pending>();
    pending->asking = asking;
    pending->use = use;
    for (const archive::Server &server : servers) {
        const QString name = QString::fromStdString(server.name);
        const std::size_t at = pending->servers.size();
        pending->servers.push_back(server);
        pending->isLeftOut.push_back(false);
        const network::Peer &peer = server.peer;
        if (hasLogin(server))
            pending->needs.push_back({at, Kind::login, loginKey(server), {}});
        else if (peer.authentication == network::Authentication::basic && peer.secret.empty())
            pending->needs.push_back(
                {at, Kind::secret, secretKey(server),
                 tr("Password of %1 at %2").arg(QString::fromStdString(peer.user), name)});
        else if (peer.authentication == network::Authentication::bearer && peer.secret.empty())
            pending->needs.push_back(
                {at, Kind::secret, secretKey(server), tr("Token for %1").arg(name)});
        if (peer.keyPassword.empty() && archive::isEncryptedKey(peer.key))
            pending->needs.push_back({at, Kind::keyPassword, keyPasswordKey(server),
                                      tr("Password of the private key for %1").arg(name)});
    }
    fetchNext(pending);
}

void ServerBook::fetchNext(const std::shared_ptr<Pending> &pending) {
    while (!pending->needs.empty()) {
        const auto &need = pending->needs.front();
        if (pending->isLeftOut[need.server]) {
            pending->needs.pop_front();
        } else if (need.kind == Pending::Kind::login && m_logins.contains(need.key)) {
            renewLogin(pending);
            return;
        } else if (const auto known = m_known.constFind(need.key); known != m_known.constEnd()) {
            pending->set(*known);
        } else {
            auto *job = new QKeychain::ReadPasswordJob(service);
            job->setKey(need.key);
            connect(
                job, &QKeychain::Job::finished, this,
                [this, pending, job, kind = need.kind, key = need.key, question = need.question] {
                    const bool isFound = job->error() == QKeychain::NoError;
                    if (kind == Pending::Kind::login) {
                        prepareLogin(pending, isFound ? job->textData() : QString());
                    } else if (isFound) {
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
        if (QString::fromStdString(server.name) == name) {
            m_known.remove(secretKey(server));
            forget(secretKey(server));
            if (hasLogin(server))
                forgetLogin(server);
        }
}

void ServerBook::prepareLogin(const std::shared_ptr<Pending> &pending,
                              const QString &refreshToken) {
    const Pending::Need &need = pending->needs.front();
    // From any thread. Without a keychain, the login has the token for this run.
    const auto keepIt = [self = QPointer<ServerBook>(this),
                         key = need.key](const std::string &token) {
        QMetaObject::invokeMethod(
            qApp,
            [self, key, text = QString::fromStdString(token)] {
                if (self == nullptr)
                    return;
                if (!self->isSavedLogin(key) && !text.isEmpty())
                    self->m_unsavedTokens[key] = text;
                else if (!self->isSavedLogin(key))
                    self->m_unsavedTokens.remove(key);
                else if (text.isEmpty())
                    self->forget(key);
                else
                    self->keep(key, text);
            },
            Qt::QueuedConnection);
    };
    if (!m_logins.contains(need.key)) // another search may have been faster
        m_logins[need.key] = std::make_shared<archive::Login>(pending->servers[need.server],
                                                              refreshToken.toStdString(), keepIt);
    renewLogin(pending);
}

// The user is asked before a long job begins, not in the middle of it.
void ServerBook::renewLogin(const std::shared_ptr<Pending> &pending) {
    const std::shared_ptr<archive::Login> login = m_logins[pending->needs.front().key];
    if (login->hasToken()) {
        pending->set(login);
        fetchNext(pending);
        return;
    }
    if (!login->isLoggedIn()) {
        askToLogIn(pending);
        return;
    }
    auto *jobs = new JobRunner(this);
    jobs->start(
        tr("Logging in to %1")
            .arg(QString::fromStdString(pending->servers[pending->needs.front().server].name)),
        [login](const Job &job) { login->token(job.progress()); },
        [this, jobs, pending, login](const Outcome &outcome) {
            jobs->deleteLater();
            if (outcome.kind == Outcome::Kind::cancelled) // the program ends
                return;
            if (outcome.kind == Outcome::Kind::failed &&
                outcome.reason->is(task::because::loginHasExpired)) {
                askToLogIn(pending);
                return;
            }
            // Other failures are reported by whoever connects.
            pending->set(login);
            fetchNext(pending);
        });
}

void ServerBook::whenEnded(QDialog *dialog, const std::function<void(bool)> &then) {
    const auto once = std::make_shared<bool>(false);
    const auto end = [once, then](bool isAccepted) {
        if (!std::exchange(*once, true))
            then(isAccepted);
    };
    connect(dialog, &QDialog::finished, this,
            [end](int result) { end(result == QDialog::Accepted); });
    connect(dialog, &QObject::destroyed, this, [end] { end(false); });
}

void ServerBook::askToLogIn(const std::shared_ptr<Pending> &pending) {
    if (pending->asking == nullptr) {
        pending->leaveOut();
        fetchNext(pending);
        return;
    }
    const Pending::Need &need = pending->needs.front();
    const std::shared_ptr<archive::Login> login = m_logins[need.key];
    // A search and a retrieval may need the same login.
    QPointer<LoginDialog> &dialog = m_dialogs[need.key];
    if (dialog == nullptr) {
        const QString name = QString::fromStdString(pending->servers[need.server].name);
        dialog = new LoginDialog(name, login, pending->asking);
        dialog->setAttribute(Qt::WA_DeleteOnClose);
        dialog->open();
    }
    whenEnded(dialog, [this, pending, login, key = need.key](bool isAccepted) {
        m_dialogs.remove(key);
        if (isAccepted)
            pending->set(login);
        else
            pending->leaveOut();
        fetchNext(pending);
    });
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
    dialog->setLabelText(shownText(question));
    dialog->setTextEchoMode(QLineEdit::Password);
    // Not by textValueSelected(), which comes after finished().
    whenEnded(dialog, [this, pending, key, dialog](bool isAccepted) {
        if (isAccepted)
            m_known[key] = dialog->textValue(); // for this run
        if (!m_known.contains(key))
            pending->leaveOut();
        fetchNext(pending);
    });
    dialog->open();
}

} // namespace pellucid::ui
