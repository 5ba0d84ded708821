// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/servers/server_search.h"

#include <algorithm>

namespace pellucid::ui {

ServerSearch::ServerSearch(ServerBook &book, QObject *parent) : QObject(parent), m_book(book) {
    connect(&book, &ServerBook::changed, this, &ServerSearch::clear);
}

void ServerSearch::clear() {
    ++m_generation;
    m_jobs.cancel();
    m_found.clear();
    m_states.clear();
    emit changed();
}

void ServerSearch::search(const QString &words, QWidget *asking) {
    clear();
    m_words = words;
    m_asking = asking;
    if (m_book.servers().empty())
        return;
    // At once: the renewal of a login takes a moment.
    for (const QString &name : m_book.names())
        m_states[name] = {};
    emit changed();
    m_book.withSecrets(m_book.names(), asking,
                       [this, terms = searchTermsOf(words),
                        generation = m_generation](const std::vector<archive::Server> &servers) {
                           if (generation != m_generation)
                               return;
                           m_states.clear(); // some may be left out
                           if (servers.empty())
                               emit changed();
                           else
                               start(terms, servers);
                       });
}

void ServerSearch::start(const archive::SearchTerms &terms,
                         const std::vector<archive::Server> &servers) {
    for (const archive::Server &server : servers)
        m_states[QString::fromStdString(server.name)] = {};
    emit changed();
    m_jobs.start(
        tr("Searching servers"),
        [this, terms, servers](const Job &job) {
            archive::SearchObserver observer;
            observer.found = [&](const archive::FoundEntry &entry, std::size_t index) {
                job.deliver([this, remote = remoteStudy(entry), index] {
                    if (index < m_found.size())
                        m_found[index] = remote;
                    else
                        m_found.push_back(remote);
                });
            };
            observer.ended = [&](const archive::ServerOutcome &outcome) {
                job.deliver([this, outcome] {
                    m_states[QString::fromStdString(outcome.server)] = {
                        outcome.failure ? ServerState::Kind::failed : ServerState::Kind::answered,
                        outcome.reachedLimit || outcome.mayBeIncomplete, outcome.failure};
                    if (outcome.failure &&
                        outcome.failure->is(task::because::serverDoesNotAcceptTheLogin))
                        m_book.forgetSecret(QString::fromStdString(outcome.server));
                    emit changed();
                });
            };
            archive::search(servers, terms, observer, job.progress());
        },
        [this](const Outcome &outcome) {
            // The login server has refused to renew a login meanwhile: the user logs in again.
            if (outcome.kind == Outcome::Kind::done && m_asking != nullptr && hasExpiredLogin())
                search(QString(m_words), m_asking);
            if (outcome.kind != Outcome::Kind::failed)
                return;
            // Words that no server can be asked for, such as a backslash.
            for (auto &[name, state] : m_states)
                if (state.kind == ServerState::Kind::searching)
                    state = {ServerState::Kind::failed, false, outcome.reason};
            emit changed();
        });
}

bool ServerSearch::hasExpiredLogin() const {
    return std::any_of(m_states.begin(), m_states.end(), [](const auto &state) {
        return state.second.reason && state.second.reason->is(task::because::loginHasExpired);
    });
}

} // namespace pellucid::ui
