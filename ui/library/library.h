// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <QString>

#include "core/dicom/catalogue.h"
#include "ui/studies/study_facts.h"

namespace pellucid::ui {

/// Where a library stores its list and its copies.
struct LibraryPlace {
    std::filesystem::path folder;
    /// The list is in memory because the folder cannot be written; it is lost when the program
    /// ends.
    bool inMemory = false;

    std::filesystem::path listFile() const { return folder / "library.sqlite"; }
    std::filesystem::path copiesFolder() const { return folder / "files"; }
    /// Contains copies of unfinished imports.
    std::filesystem::path incomingFolder() const { return copiesFolder() / "incoming"; }
    /// A file that exists from a rebuild of the list until its copies are listed again.
    std::filesystem::path rebuiltMark() const { return folder / "rebuilt"; }
};

enum class StudyOrder { newestFirst, byName, lastAddedFirst };

/// A series to be stored in the library.
struct LibrarySeries {
    StudyFacts study;
    std::vector<VolumeFacts> volumes;
    std::vector<dicom::InstanceFile> files;
};

struct StudyPage {
    std::vector<StudyFacts> studies;
    int count = 0; ///< number of all matches
};

/// The result of `openLibrary`.
struct OpenedLibrary {
    LibraryPlace place;
    /// For the user: the list was damaged, cannot be written, ...
    std::vector<dicom::Skipped> notices;
    bool wasDamaged = false;
    /// The list was rebuilt, now or by a program that was killed, and may lack rows of copies.
    bool mayLackCopies = false;
    /// The readable series of a damaged list that cannot be replaced, for the list in memory.
    std::vector<LibrarySeries> readable;
};

/// Opens the library in a folder, or creates one. A damaged list is kept under a different name,
/// and its readable rows go into a new list. If the folder cannot be written, or the list is from a
/// other version of the program, the list is in memory. Reports all this in the notices instead of
/// throwing. `unlisted`: files that wait to be listed, such as those from a server; they are no
/// sign of a lost list.
OpenedLibrary openLibrary(const std::filesystem::path &folder,
                          const std::vector<std::filesystem::path> &unlisted = {});

/// The stored studies: SQLite through Qt SQL. Each thread needs its own object, because SQLite's
/// connections belong to threads. All functions *throw* Error{output} if the list cannot be read or
/// written.
class Library {
public:
    explicit Library(const LibraryPlace &place);
    ~Library();
    Library(const Library &) = delete;
    Library &operator=(const Library &) = delete;

    const LibraryPlace &place() const { return m_place; }

    /// Finds studies whose patient, date, descriptions, modalities and body parts contain every
    /// word of `search`, ignoring case and accents. *Shape*: at most `limit`, from `offset`.
    StudyPage find(const QString &search, StudyOrder order, int offset, int limit) const;
    /// Whether the library contains the series of a volume.
    bool contains(const StudyFacts &study, const VolumeFacts &volume) const;
    /// In the order of the series numbers; empty if the study is not in the library. Studies are
    /// identified by their facts, because another process may rebuild the list with other row
    /// numbers.
    std::vector<VolumeFacts> volumes(const StudyFacts &study) const;
    /// The files of the series that a volume belongs to.
    std::vector<dicom::InstanceFile> files(const StudyFacts &study,
                                           const VolumeFacts &volume) const;

    /// The study with this row number. After a rebuild of the list, the number may belong to a
    /// different study.
    std::optional<StudyFacts> study(qint64 id) const;

    /// Adds or replaces series, all of them or none.
    void put(const std::vector<LibrarySeries> &series);
    /// The files of a study that are copies in the library.
    std::vector<std::filesystem::path> copiesOf(const StudyFacts &study) const;
    /// Removes a study from the list. Record the names of its copies first, as `removeStudy` does:
    /// otherwise, nothing would find and delete them.
    void remove(const StudyFacts &study);
    /// Deletes copies, except those that a study now uses.
    void removeCopies(const std::vector<std::filesystem::path> &copies);

    /// Qt's name of the database connection.
    const QString &connection() const { return m_connection; }

private:
    LibraryPlace m_place;
    QString m_connection;
};

} // namespace pellucid::ui
