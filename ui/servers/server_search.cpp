// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/servers/server_search.h"

#include <algorithm>

#include "core/network/client/reasons.h"

namespace pellucid::ui {

ServerSearch::ServerSearch(ServerBook &book, QObject *parent) : QObject(parent), m_book(book) {
    connect(&book, &ServerBook::changed, this, &ServerSearch::clear);
}

void ServerSearch::clear() {
    ++m_generation;
    for (const auto &[name, jobs] : m_jobs)
        jobs->cancel();
    m_found.clear();
    m_states.clear();
    emit changed();
}

bool ServerSearch::isRunning() const {
    return std::any_of(m_jobs.begin(), m_jobs.end(),
                       [](const auto &one) { return one.second->isRunning(); });
}

void ServerSearch::search(const QString &words, QWidget *asking) {
    clear();
    m_words = words;
    m_asking = asking;
    // At once: the renewal of a login takes a moment.
    for (const QString &name : m_book.names())
        m_states[name] = {};
    emit changed();
    // Those that need no question first.
    const auto waiting = std::make_shared<qsizetype>(m_book.names().size());
    for (const QString &name : m_book.names())
        begin(name, nullptr, [this, waiting] {
            if (--*waiting == 0 && m_asking != nullptr)
                askForNext();
        });
}

void ServerSearch::unlock(const QString &server, QWidget *asking) {
    m_states[server] = {};
    emit changed();
    begin(server, asking, [] {});
}

void ServerSearch::begin(const QString &server, QWidget *asking,
                         const std::function<void()> &then) {
    m_book.withSecrets({server}, asking,
                       [this, server, then,
                        generation = m_generation](const std::vector<archive::Server> &servers) {
                           if (generation != m_generation)
                               return;
                           if (servers.empty())
                               m_states[server] = {ServerState::Kind::locked, false, {}};
                           else
                               start(servers.front());
                           emit changed();
                           then();
                       });
}

// A server whose question is closed stays locked, and the next one is asked for.
void ServerSearch::askForNext() {
    const QStringList names = m_book.names();
    const auto ask = [this, names](const auto &self, qsizetype at) -> void {
        const auto isLocked = [&](const QString &name) {
            const auto state = m_states.find(name);
            return state != m_states.end() && state->second.kind == ServerState::Kind::locked;
        };
        while (at < names.size() && !isLocked(names[at]))
            ++at;
        if (at == names.size() || m_asking == nullptr)
            return;
        m_states[names[at]] = {};
        emit changed();
        begin(names[at], m_asking, [self, at] { self(self, at + 1); });
    };
    ask(ask, 0);
}

void ServerSearch::take(const RemoteStudy &study) {
    const auto known = std::find_if(m_found.begin(), m_found.end(), [&](const RemoteStudy &one) {
        return one.study.uid == study.study.uid;
    });
    if (known == m_found.end())
        m_found.push_back(study);
    else if (!known->servers.contains(study.servers.value(0)))
        known->servers += study.servers;
}

void ServerSearch::start(const archive::Server &server) {
    const QString name = QString::fromStdString(server.name);
    std::unique_ptr<JobRunner> &jobs = m_jobs[name];
    if (!jobs)
        jobs = std::make_unique<JobRunner>();
    jobs->start(
        tr("Searching servers"),
        [this, server, name, terms = searchTermsOf(m_words)](const Job &job) {
            archive::SearchObserver observer;
            observer.found = [&](const archive::FoundEntry &entry, std::size_t) {
                job.deliver([this, remote = remoteStudy(entry)] { take(remote); });
            };
            observer.ended = [&](const archive::ServerOutcome &outcome) {
                job.deliver([this, name, outcome] {
                    m_states[name] = {
                        outcome.failure ? ServerState::Kind::failed : ServerState::Kind::answered,
                        outcome.reachedLimit || outcome.mayBeIncomplete, outcome.failure};
                    if (outcome.failure &&
                        outcome.failure->is(task::because::serverDoesNotAcceptTheLogin))
                        m_book.forgetSecret(name);
                    emit changed();
                });
            };
            archive::search({server}, terms, observer, job.progress());
        },
        [this, name](const Outcome &outcome) {
            ServerState &state = m_states[name];
            // The login server has refused to renew a login meanwhile: the user logs in again.
            if (outcome.kind == Outcome::Kind::done && m_asking != nullptr && state.reason &&
                state.reason->is(task::because::loginHasExpired))
                unlock(name, m_asking);
            if (outcome.kind != Outcome::Kind::failed)
                return;
            // Words that no server can be asked for, such as a backslash.
            state = {ServerState::Kind::failed, false, outcome.reason};
            emit changed();
        });
}

} // namespace pellucid::ui
