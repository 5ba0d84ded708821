// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/servers/earlier_studies.h"

#include <algorithm>

#include <QSettings>

#include "ui/servers/same_patient.h"

namespace pellucid::ui {

namespace {

constexpr int mostListed = 500, mostInAdvance = 3;
constexpr auto inAdvanceKey = "earlierStudies/inAdvance";

// Both by the identifier, and by name and birth date, under which another hospital may know the
// patient.
std::vector<archive::SearchTerms> termsFor(const StudyFacts &study) {
    std::vector<archive::SearchTerms> all;
    if (const QString id = study.patientId.trimmed(); !id.isEmpty()) {
        archive::SearchTerms terms;
        terms.patientId = id.toStdString();
        all.push_back(terms);
    }
    if (!study.patientName.isEmpty() && !study.birthDate.isEmpty()) {
        archive::SearchTerms terms;
        terms.patientName = study.patientName.section('=', 0, 0).toStdString();
        all.push_back(terms);
    }
    return all;
}

} // namespace

EarlierStudies::EarlierStudies(StudyLibrary &library, ServerBook &book, QObject *parent)
    : QObject(parent), m_library(library), m_book(book),
      m_inAdvance(std::clamp(QSettings().value(inAdvanceKey, 0).toInt(), 0, mostInAdvance)) {
    connect(&library, &StudyLibrary::changed, this, [this] {
        if (m_open) {
            listLibrary();
            merge();
        }
    });
    connect(&book, &ServerBook::changed, this, &EarlierStudies::search);
}

void EarlierStudies::setOpenStudy(const std::optional<StudyFacts> &study) {
    const bool isSame =
        study.has_value() == m_open.has_value() &&
        (!study || (study->key() == m_open->key() && study->birthDate == m_open->birthDate));
    if (isSame)
        return;
    m_open = study;
    search();
}

void EarlierStudies::setShown(bool isShown) {
    m_isShown = isShown;
    if (isShown && !m_hasAsked)
        search();
}

void EarlierStudies::setInAdvance(int count) {
    m_inAdvance = std::clamp(count, 0, mostInAdvance);
    QSettings().setValue(inAdvanceKey, m_inAdvance);
    if (m_hasAsked)
        suggest();
    else
        search();
}

void EarlierStudies::search() {
    ++m_generation;
    m_jobs.cancel();
    m_hasAsked = false;
    m_here.clear();
    m_remote.clear();
    m_failures.clear();
    m_limited.clear();
    if (m_open && m_open->hasPatient() && (m_isShown || m_inAdvance > 0)) {
        m_hasAsked = true;
        listLibrary();
        // Nobody is asked for a password because a study is opened.
        if (!m_book.servers().empty())
            m_book.withSecrets(
                m_book.names(), nullptr,
                [this, generation = m_generation](const std::vector<archive::Server> &servers) {
                    if (generation == m_generation && !servers.empty())
                        searchServers(servers);
                });
    }
    merge();
}

void EarlierStudies::listLibrary() {
    m_here.clear();
    std::vector<QString> searches;
    if (!m_open->patientId.trimmed().isEmpty())
        searches.push_back(m_open->patientId.trimmed());
    if (!m_open->patientName.isEmpty())
        searches.push_back(QString(m_open->patientName).replace('^', ' ').replace('=', ' '));
    for (const QString &words : searches)
        for (const StudyFacts &study :
             m_library.find(words, StudyOrder::newestFirst, 0, mostListed).studies)
            if (std::none_of(m_here.begin(), m_here.end(),
                             [&](const StudyFacts &one) { return one.key() == study.key(); }))
                m_here.push_back(study);
}

void EarlierStudies::searchServers(const std::vector<archive::Server> &servers) {
    m_jobs.start(
        tr("Looking for prior studies"),
        [this, servers, all = termsFor(*m_open)](const Job &job) {
            for (const archive::SearchTerms &terms : all) {
                archive::SearchObserver observer;
                observer.found = [&](const archive::FoundEntry &entry, std::size_t) {
                    job.deliver(
                        [this, remote = remoteStudy(entry)] { m_remote.push_back(remote); });
                };
                observer.ended = [&](const archive::ServerOutcome &outcome) {
                    job.deliver([this, outcome] {
                        if (outcome.failure)
                            m_failures.insert_or_assign(QString::fromStdString(outcome.server),
                                                        *outcome.failure);
                        const QString name = QString::fromStdString(outcome.server);
                        if ((outcome.reachedLimit || outcome.mayBeIncomplete) &&
                            !m_limited.contains(name))
                            m_limited << name;
                        merge();
                    });
                };
                archive::search(servers, terms, observer, job.progress());
            }
        },
        [this](const Outcome &outcome) {
            // An identifier that no server can be asked for, such as one with a backslash.
            if (outcome.kind == Outcome::Kind::failed)
                for (const QString &name : m_book.names())
                    m_failures.insert_or_assign(name, *outcome.reason);
            merge();
            if (outcome.kind == Outcome::Kind::done)
                suggest();
        });
    emit changed();
}

void EarlierStudies::merge() {
    m_studies.clear();
    const auto add = [this](const StudyFacts &study, const QStringList &servers, int instances) {
        const SamePatient same = samePatient(*m_open, study);
        if (study.uid == m_open->uid || same == SamePatient::no)
            return;
        const auto known =
            std::find_if(m_studies.begin(), m_studies.end(),
                         [&](const EarlierStudy &one) { return one.study.uid == study.uid; });
        if (known == m_studies.end()) {
            m_studies.push_back({study, servers, instances, same == SamePatient::yes});
            return;
        }
        known->servers += servers;
        known->servers.removeDuplicates();
        known->instances = std::max(known->instances, instances);
    };
    if (m_open) {
        for (const StudyFacts &study : m_here)
            add(study, {}, 0);
        for (const RemoteStudy &remote : m_remote)
            add(remote.study, remote.servers, remote.instances);
    }
    std::stable_sort(
        m_studies.begin(), m_studies.end(), [](const EarlierStudy &a, const EarlierStudy &b) {
            return a.isCertain != b.isCertain ? a.isCertain : a.study.date > b.study.date;
        });
    emit changed();
}

// The latest that are certainly of the patient and have a modality of the open study.
void EarlierStudies::suggest() {
    if (!m_open)
        return;
    const QStringList modalities = m_open->modalities.split(' ', Qt::SkipEmptyParts);
    int left = m_inAdvance;
    for (const EarlierStudy &one : m_studies) {
        const QStringList others = one.study.modalities.split(' ', Qt::SkipEmptyParts);
        const bool isAlike =
            others.isEmpty() || // not every server says
            std::any_of(modalities.begin(), modalities.end(),
                        [&](const QString &modality) { return others.contains(modality); });
        if (left == 0 || !one.isCertain)
            return;
        if (!isAlike)
            continue;
        --left;
        if (!one.isHere() && !one.servers.isEmpty())
            emit retrievalSuggested(one.remote());
    }
}

} // namespace pellucid::ui
