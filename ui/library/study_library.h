// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include <QObject>

#include "core/files/file_ids.h"
#include "core/task/reason.h"
#include "ui/jobs/job_runner.h"
#include "ui/library/import_studies.h"
#include "ui/library/library.h"

namespace pellucid::ui {

/// The library as the window uses it: opens it once, and imports and removes studies in its own job
/// runner, separate from the jobs of the open study. Reports errors by `failed` and never throws.
class StudyLibrary : public QObject {
    Q_OBJECT
public:
    /// `unlisted`: as for `openLibrary`.
    explicit StudyLibrary(const std::vector<std::filesystem::path> &unlisted = {},
                          QObject *parent = nullptr);
    ~StudyLibrary() override;

    /// The notices of `openLibrary`.
    const std::vector<dicom::Skipped> &notices() const { return m_notices; }

    StudyPage find(const QString &search, StudyOrder order, int offset, int limit);
    bool contains(const StudyFacts &study, const VolumeFacts &volume);
    /// None if the study has been removed.
    std::optional<StudyFacts> study(qint64 id);
    std::vector<VolumeFacts> volumes(const StudyFacts &study);
    std::vector<dicom::InstanceFile> files(const StudyFacts &study, const VolumeFacts &volume);

    void import(const Import &import);
    void remove(const StudyFacts &study);
    JobRunner &jobs() { return m_jobs; }

signals:
    void changed();
    void imported(const pellucid::ui::ImportResult &result);
    void failed(const pellucid::task::Reason &what, const QString &path);

private:
    void open(const LibraryPlace &place);
    void openIfReplaced();
    template <class F> auto attempt(F &&f) -> decltype(f(std::declval<Library &>()));

    std::vector<dicom::Skipped> m_notices;
    /// Work on the library's files; one piece runs at a time.
    struct Work {
        QString title;
        std::function<void(const Job &)> run;
        bool isOptional; ///< skipped if it has not started when the program ends
    };
    void start(Work work);
    void workEnded(const Outcome &outcome);
    void startNext();
    void importBy(std::function<ImportResult(const task::Progress &)> work);

    std::unique_ptr<Library> m_library;
    std::optional<files::FileIds> m_listFile; ///< the open list
    JobRunner m_jobs;
    std::deque<Work> m_waiting;
};

} // namespace pellucid::ui
