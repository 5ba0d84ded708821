// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <QString>

#include "core/dicom/catalogue.h"
#include "ui/studies/study_facts.h"

namespace pellucid::ui {

/// Where a library keeps its list and its copies.
struct LibraryPlace {
    std::filesystem::path folder;
    /// The list is in memory, because the folder cannot be written; gone with the program.
    bool inMemory = false;

    std::filesystem::path listFile() const { return folder / "library.sqlite"; }
    std::filesystem::path copiesFolder() const { return folder / "files"; }
    /// Where copies are that have not all arrived.
    std::filesystem::path incomingFolder() const { return copiesFolder() / "incoming"; }
    /// There from a rebuild of the list until its copies have been looked for.
    std::filesystem::path rebuiltMark() const { return folder / "rebuilt"; }
};

enum class StudyOrder { newestFirst, byName, lastAddedFirst };

/// A series as it goes into the library.
struct LibrarySeries {
    StudyFacts study;
    std::vector<VolumeFacts> volumes;
    std::vector<dicom::InstanceFile> files;
};

struct StudyPage {
    std::vector<StudyFacts> studies;
    int count = 0; ///< of all that match
};

/// What `openLibrary` found and did.
struct OpenedLibrary {
    LibraryPlace place;
    /// One line each: the list was damaged, cannot be written, ...
    std::vector<dicom::Skipped> notices;
    bool wasDamaged = false;
    /// Copies may be missing from a list that was rebuilt, now or by a program that was killed.
    bool mayLackCopies = false;
    /// What could be read of a damaged list whose place cannot be written: for the one in memory.
    std::vector<LibrarySeries> readable;
};

/// Finds a library below a folder, or makes it. A list that is damaged is kept under another name
/// and what can be read of it goes into a new one; where nothing can be written, or the list is of
/// a newer program, it is in memory. Throws nothing of that: what was done is in the notices.
OpenedLibrary openLibrary(const std::filesystem::path &folder);

/// The studies that are kept: SQLite through Qt SQL. Every thread has an object of its own, because
/// SQLite's connections belong to threads. All functions *throw* Error{output} when the list cannot
/// be read or written.
class Library {
public:
    explicit Library(const LibraryPlace &place);
    ~Library();
    Library(const Library &) = delete;
    Library &operator=(const Library &) = delete;

    const LibraryPlace &place() const { return m_place; }

    /// Studies whose patient, date, descriptions, modalities and body parts hold every word of
    /// `search`, whatever its case and accents. *Shape*: at most `limit`, from `offset`.
    StudyPage find(const QString &search, StudyOrder order, int offset, int limit) const;
    /// Whether it has the series of a volume.
    bool holds(const StudyFacts &study, const VolumeFacts &volume) const;
    /// In the order of the series' numbers; none if the study is not there, as everywhere below:
    /// studies are asked for by what tells them apart, because another program may make the list
    /// anew and give other numbers.
    std::vector<VolumeFacts> volumes(const StudyFacts &study) const;
    /// Of the series that a volume belongs to.
    std::vector<dicom::InstanceFile> files(const StudyFacts &study,
                                           const VolumeFacts &volume) const;

    /// By the number that it had when it was found; it may be another one by now.
    std::optional<StudyFacts> study(qint64 id) const;

    /// Adds series, in place of those that are there already, all of them or none.
    void put(const std::vector<LibrarySeries> &series);
    /// The files of a study that are the library's own.
    std::vector<std::filesystem::path> copiesOf(const StudyFacts &study) const;
    /// Takes a study off the list; its copies first have their names written down, as `removeStudy`
    /// does: files without a row are litter, a row without files is a broken promise.
    void remove(const StudyFacts &study);
    /// Removes copies unless a study has come to use them meanwhile.
    void removeCopies(const std::vector<std::filesystem::path> &copies);

    /// The name that Qt knows its connection by.
    const QString &connection() const { return m_connection; }

private:
    LibraryPlace m_place;
    QString m_connection;
};

} // namespace pellucid::ui
