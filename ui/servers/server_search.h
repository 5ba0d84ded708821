// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
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
    enum class Kind { searching, answered, failed };
    Kind kind = Kind::searching;
    bool hasMore = false;
    std::optional<task::Reason> reason; ///< why it failed
};

/// Searches all servers in the background. A new search replaces the former one.
class ServerSearch : public QObject {
    Q_OBJECT
public:
    explicit ServerSearch(ServerBook &book, QObject *parent = nullptr);

    /// `asking`: the window that asks for missing secrets.
    void search(const QString &words, QWidget *asking);
    /// Drops the results.
    void clear();

    const std::vector<RemoteStudy> &found() const { return m_found; }
    const std::map<QString, ServerState> &states() const { return m_states; }
    bool isRunning() const { return m_jobs.isRunning(); }
    QStringList serverNames() const { return m_book.names(); }

signals:
    void changed();

private:
    void start(const archive::SearchTerms &terms, const std::vector<archive::Server> &servers);
    bool hasExpiredLogin() const;

    ServerBook &m_book;
    QString m_words; ///< of the search
    QPointer<QWidget> m_asking;
    std::vector<RemoteStudy> m_found;
    std::map<QString, ServerState> m_states;
    quint64 m_generation = 0;
    JobRunner m_jobs;
};

} // namespace pellucid::ui
