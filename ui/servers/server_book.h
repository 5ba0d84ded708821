// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <QDateTime>
#include <QFileSystemWatcher>
#include <QHash>
#include <QObject>
#include <QPointer>
#include <QStringList>

#include "core/archive/login.h"
#include "core/task/reason.h"

class QDialog;
class QWidget;

namespace pellucid::ui {

class LoginDialog;

/// The user's servers and their secrets: passwords, tokens, logins, and passwords of private keys.
/// Secrets are in the desktop's keychain; without one, they are asked for once in each run of the
/// program. Of a login, only the token that renews it is kept there.
class ServerBook : public QObject {
    Q_OBJECT
public:
    explicit ServerBook(QObject *parent = nullptr);

    const std::vector<archive::Server> &servers() const { return m_servers; }
    QStringList names() const;
    /// Saves a server and, if they are not empty, its secrets. *Throws* Error{usage},
    /// Error{output}.
    void put(const archive::Server &server);
    /// *Throws* Error{usage}, Error{output}.
    void remove(const QString &name);

    using Use = std::function<void(const std::vector<archive::Server> &)>;
    /// Calls `use` with these servers and their secrets, at once or after the user has entered
    /// those that no keychain has. Servers whose secrets the user does not enter are left out, as
    /// are all that lack one if `asking` is null.
    void withSecrets(const QStringList &names, QWidget *asking, const Use &use);
    /// The same for servers that need not be saved. Secrets that they have are not asked for.
    void withSecrets(const std::vector<archive::Server> &servers, QWidget *asking, const Use &use);

    /// After a server has not accepted it: it is asked for again, and so is a login.
    void forgetSecret(const QString &name);

signals:
    void changed();
    /// The list on disk cannot be read.
    void failed(const pellucid::task::Reason &what, const QString &path);

private:
    struct Pending;
    void load();
    /// Notices what other programs change in the list on disk.
    void watch();
    void fetchNext(const std::shared_ptr<Pending> &pending);
    void ask(const std::shared_ptr<Pending> &pending, const QString &key, const QString &question);
    void keep(const QString &key, const QString &secret);
    void forget(const QString &key);
    void forgetLogin(const archive::Server &server);
    void replaceLogin(const archive::Server &former, const archive::Server &server);
    bool isSavedLogin(const QString &key) const;
    void prepareLogin(const std::shared_ptr<Pending> &pending, const QString &refreshToken);
    void renewLogin(const std::shared_ptr<Pending> &pending);
    void askToLogIn(const std::shared_ptr<Pending> &pending);
    /// Calls `then` when the dialog is accepted, rejected, or destroyed with its window.
    void whenEnded(QDialog *dialog, const std::function<void(bool isAccepted)> &then);

    std::vector<archive::Server> m_servers;
    QFileSystemWatcher m_watcher;
    QDateTime m_changed;             ///< the list on disk
    QHash<QString, QString> m_known; ///< secrets, by their key in the keychain
    /// By the keys of their refresh tokens.
    QHash<QString, std::shared_ptr<archive::Login>> m_logins;
    QHash<QString, QPointer<LoginDialog>> m_dialogs;
    /// Refresh tokens of servers that are tested before they are saved, by the same keys.
    QHash<QString, QString> m_unsavedTokens;
};

} // namespace pellucid::ui
