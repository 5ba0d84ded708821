// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <vector>

#include <QObject>
#include <QPointer>
#include <QStringList>
#include <QWidget>

#include "ui/jobs/job_runner.h"
#include "ui/servers/remote_study.h"
#include "ui/servers/server_book.h"

namespace pellucid::ui {

/// How a server fared in a search.
struct ServerState {
    enum class Kind { searching, answered, failed, locked }; ///< locked: it awaits a login
    Kind kind = Kind::searching;
    bool hasMore = false;
    std::optional<task::Reason> reason; ///< why it failed
};

/// Searches all servers in the background, each as soon as its secrets are known: a login holds up
/// its own server only. A new search replaces the former one.
class ServerSearch : public QObject {
    Q_OBJECT
public:
    explicit ServerSearch(ServerBook &book, QObject *parent = nullptr);

    /// `asking`: the window that asks for missing secrets, one after the other; null: servers that
    /// lack one stay locked.
    void search(const QString &words, QWidget *asking);
    /// Asks for the secrets of one server, and searches it.
    void unlock(const QString &server, QWidget *asking);
    /// Drops the results.
    void clear();

    const std::vector<RemoteStudy> &found() const { return m_found; }
    const std::map<QString, ServerState> &states() const { return m_states; }
    bool isRunning() const;
    QStringList serverNames() const { return m_book.names(); }

signals:
    void changed();

private:
    /// `then` is called when the search of the server has begun, or cannot begin.
    void begin(const QString &server, QWidget *asking, const std::function<void()> &then);
    void askForNext();
    void start(const archive::Server &server);
    void take(const RemoteStudy &study);

    ServerBook &m_book;
    QString m_words; ///< of the search
    QPointer<QWidget> m_asking;
    std::vector<RemoteStudy> m_found;
    std::map<QString, ServerState> m_states;
    quint64 m_generation = 0;
    std::map<QString, std::unique_ptr<JobRunner>> m_jobs; ///< by server
};

} // namespace pellucid::ui
