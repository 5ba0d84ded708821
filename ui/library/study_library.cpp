// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/study_library.h"

#include "core/files/user_folders.h"
#include "core/system/log.h"
#include "core/task/error.h"
#include "ui/language/failure.h"
#include "ui/library/reasons.h"

namespace pellucid::ui {

StudyLibrary::StudyLibrary(const std::vector<std::filesystem::path> &unlisted, QObject *parent)
    : QObject(parent) {
    OpenedLibrary opened;
    if (const auto data = files::userDataFolder()) {
        opened = openLibrary(*data / "library", unlisted);
    } else {
        opened.place.inMemory = true;
        opened.notices.push_back({{}, task::because::noDataFolder});
    }
    m_notices = opened.notices;
    try {
        open(opened.place);
        if (!opened.readable.empty())
            m_library->put(opened.readable);
    } catch (const task::Error &error) {
        // Even a list in memory may fail; the program then continues without a library.
        m_notices.push_back({error.path(), error.reason()});
        return;
    }
    if (!opened.place.inMemory && hasUnfinishedImports(opened.place))
        start({tr("Tidying up the study library"),
               [place = opened.place,
                left = opened.mayLackCopies ? LeftCopies::kept : LeftCopies::removed](const Job &) {
                   Library library(place);
                   removeAbandonedImports(library, left);
               },
               true});
    if (opened.mayLackCopies)
        importBy([place = opened.place](const task::Progress &progress) {
            return relistCopies(place, progress);
        });
}

StudyLibrary::~StudyLibrary() {
    m_jobs.join();
    for (const Work &work : m_waiting)
        try {
            if (!work.isOptional)
                work.run(Job());
        } catch (...) {
            system::log("the study library: " + currentFailure().what.english());
        }
}

void StudyLibrary::start(Work work) {
    if (m_jobs.isRunning())
        m_waiting.push_back(std::move(work));
    else
        m_jobs.start(work.title, std::move(work.run),
                     [this](const Outcome &outcome) { workEnded(outcome); });
}

void StudyLibrary::workEnded(const Outcome &outcome) {
    if (outcome.kind == Outcome::Kind::failed)
        emit failed(*outcome.reason, outcome.path);
    // Queued, so that the destructor, which ends the job, does not start the next one.
    QMetaObject::invokeMethod(this, &StudyLibrary::startNext, Qt::QueuedConnection);
}

void StudyLibrary::startNext() {
    emit changed(); // an import that was cancelled too late has changed the list
    if (m_waiting.empty() || m_jobs.isRunning())
        return;
    const Work next = m_waiting.front();
    m_waiting.pop_front();
    start(next);
}

void StudyLibrary::open(const LibraryPlace &place) {
    // Before opening: if the list is replaced in between, openIfReplaced() notices.
    files::FileIds listFile(std::vector{place.listFile()});
    m_library = std::make_unique<Library>(place);
    if (listFile.isEmpty()) // opening created the list
        listFile = files::FileIds(std::vector{place.listFile()});
    m_listFile = std::move(listFile);
}

// Another process may have found the list damaged and replaced it.
void StudyLibrary::openIfReplaced() {
    const LibraryPlace place = m_library->place();
    std::error_code unknown;
    if (place.inMemory || !std::filesystem::exists(place.listFile(), unknown) ||
        m_listFile->find(place.listFile()))
        return;
    open(place);
    // Views of the former list must reload.
    QMetaObject::invokeMethod(this, &StudyLibrary::changed, Qt::QueuedConnection);
}

template <class F> auto StudyLibrary::attempt(F &&f) -> decltype(f(std::declval<Library &>())) {
    if (!m_library)
        return {};
    try {
        openIfReplaced();
        return f(*m_library);
    } catch (const task::Error &error) {
        emit failed(error.reason(), QString::fromStdString(error.path().string()));
        return {};
    }
}

StudyPage StudyLibrary::find(const QString &search, StudyOrder order, int offset, int limit) {
    return attempt([&](Library &l) { return l.find(search, order, offset, limit); });
}

bool StudyLibrary::contains(const StudyFacts &study, const VolumeFacts &volume) {
    return attempt([&](Library &l) { return l.contains(study, volume); });
}

std::optional<StudyFacts> StudyLibrary::study(qint64 id) {
    return attempt([&](Library &l) { return l.study(id); });
}

std::vector<VolumeFacts> StudyLibrary::volumes(const StudyFacts &study) {
    return attempt([&](Library &l) { return l.volumes(study); });
}

std::vector<dicom::InstanceFile> StudyLibrary::files(const StudyFacts &study,
                                                     const VolumeFacts &volume) {
    return attempt([&](Library &l) { return l.files(study, volume); });
}

void StudyLibrary::import(const Import &import) {
    if (m_library)
        importBy([import, place = m_library->place()](const task::Progress &progress) {
            return importStudies(place, import, progress);
        });
}

void StudyLibrary::importBy(std::function<ImportResult(const task::Progress &)> work) {
    start({tr("Importing"),
           [this, work = std::move(work)](const Job &job) {
               const ImportResult result = work(job.progress());
               job.deliver([this, result] {
                   emit changed();
                   emit imported(result);
               });
           },
           true});
}

void StudyLibrary::remove(const StudyFacts &study) {
    const auto removal = attempt([&](Library &l) { return removeStudy(l, study); });
    emit changed();
    if (!removal.copies.empty())
        start({tr("Removing copies"),
               [removal, place = m_library->place()](const Job &) {
                   Library library(place);
                   finish(removal, library);
               },
               false});
}

} // namespace pellucid::ui
