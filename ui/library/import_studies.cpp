// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/import_studies.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <system_error>

#include <QCryptographicHash>

#include "core/decoding/client/read_volume_file.h"
#include "core/decoding/client/reasons.h"
#include "core/dicom/reasons.h"
#include "core/dicom/scan.h"
#include "core/files/atomic_file.h"
#include "core/files/is_below.h"
#include "core/files/session_folder.h"
#include "core/task/error.h"
#include "core/volume/volume_file.h"
#include "ui/library/reasons.h"
#include "ui/studies/thumbnail.h"

namespace pellucid::ui {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using task::Error;
using task::ErrorCode;

// A file in the folder of incoming copies, with one line for each final name.
fs::path namesFile(const fs::path &incoming) {
    return incoming / "names";
}

// File names must not contain patients' names.
std::string digest(const QString &text) {
    return QCryptographicHash::hash(text.toUtf8(), QCryptographicHash::Sha256)
        .toHex()
        .left(32)
        .toStdString();
}

// Records copies that are not, or will not be, on the list. If this program is killed, the next one
// deletes them.
void writeNames(const fs::path &folder, const std::vector<fs::path> &copies) {
    files::AtomicFile names(namesFile(folder));
    for (const fs::path &path : copies)
        names.write(path.string() + "\n");
    names.commit();
}

// Copies go to a separate folder and get their final names when all are complete. The names are
// recorded first: if the import is killed during the renaming, the next program finds the copies.
class Copies {
public:
    explicit Copies(const LibraryPlace &place) : m_place(place) {}
    ~Copies() {
        std::error_code ignored;
        for (const fs::path &path : m_renamed)
            fs::remove(path, ignored);
    }
    Copies(const Copies &) = delete;
    Copies &operator=(const Copies &) = delete;

    /// Copies a file and returns its final path.
    fs::path add(const fs::path &from, const std::string &series, const std::string &instance) {
        if (!m_incoming)
            m_incoming.emplace(m_place.incomingFolder());
        const fs::path incoming = m_incoming->path() / std::to_string(m_copies.size());
        std::error_code failed;
        fs::copy_file(from, incoming, fs::copy_options::overwrite_existing, failed);
        if (failed)
            throw Error(ErrorCode::output, because::cannotBeCopied(task::systemReason(failed)),
                        from);
        const std::string volumeSuffix = volume::volumeSuffix(from),
                          suffix = volumeSuffix.empty() ? ".dcm" : volumeSuffix;
        m_copies.push_back({incoming, m_place.copiesFolder() / series / (instance + suffix)});
        return m_copies.back().to;
    }

    void rename() {
        if (!m_incoming)
            return;
        std::vector<fs::path> names;
        for (const auto &[from, to] : m_copies)
            names.push_back(to);
        writeNames(m_incoming->path(), names);
        for (const auto &[from, to] : m_copies) {
            std::error_code failed, ignored;
            fs::create_directories(to.parent_path(), failed);
            const bool isNew = !fs::exists(to, ignored);
            if (!failed)
                fs::rename(from, to, failed);
            if (failed)
                throw Error(ErrorCode::output, task::systemReason(failed), to);
            if (isNew)
                m_renamed.push_back(to);
        }
    }
    /// After this, the copies and their names are on disk, and the list may refer to them.
    void flush() const {
        if (m_incoming)
            files::flush(m_place.copiesFolder());
    }
    void keep() { m_renamed.clear(); }

private:
    struct Copy {
        fs::path from, to;
    };
    const LibraryPlace &m_place;
    std::optional<files::SessionFolder> m_incoming;
    std::vector<Copy> m_copies;
    std::vector<fs::path> m_renamed;
};

void checkFreeSpace(const LibraryPlace &place, const std::vector<LibrarySeries> &all) {
    std::error_code unknown;
    fs::create_directories(place.copiesFolder(), unknown);
    std::uintmax_t needed = 0;
    for (const LibrarySeries &series : all)
        for (const dicom::InstanceFile &file : series.files)
            if (const auto bytes = fs::file_size(file.path, unknown); !unknown)
                needed += bytes;
    if (const fs::space_info space = fs::space(place.copiesFolder(), unknown);
        !unknown && needed > space.available)
        throw Error(ErrorCode::output, because::copiesNeedRoom(needed >> 20, space.available >> 20),
                    place.folder);
}

// In the catalogue's order.
std::vector<LibrarySeries> seriesOf(const dicom::Catalogue &catalogue,
                                    const task::Progress &progress) {
    const auto all = dicom::selections(catalogue);
    std::vector<LibrarySeries> series;
    const dicom::Series *last = nullptr;
    for (std::size_t n = 0; n < all.size(); ++n) {
        if (all[n].series != last)
            series.push_back({studyFacts(all[n]), {}, all[n].series->files});
        last = all[n].series;
        VolumeFacts facts = volumeFacts(all[n]);
        facts.thumbnail = makeThumbnail(*all[n].volume);
        series.back().volumes.push_back(std::move(facts));
        progress.report(double(n + 1) / double(all.size()));
    }
    return series;
}

bool isFileThere(const dicom::InstanceFile &file) {
    std::error_code ignored;
    return fs::is_regular_file(file.path, ignored);
}

// The files that the library has of these series but the catalogue lacks: a series may span discs.
std::vector<fs::path> missingParts(const Library &library, const dicom::Catalogue &catalogue) {
    std::set<fs::path> missing;
    for (const dicom::Selection &s : dicom::selections(catalogue)) {
        std::set<std::string> instances;
        std::set<fs::path> paths;
        for (const dicom::InstanceFile &file : s.series->files) {
            instances.insert(file.sopInstanceUid);
            paths.insert(file.path);
        }
        for (const dicom::InstanceFile &file : library.files(studyFacts(s), volumeFacts(s)))
            if (!instances.contains(file.sopInstanceUid) && !paths.contains(file.path) &&
                isFileThere(file))
                missing.insert(file.path);
    }
    return {missing.begin(), missing.end()};
}

bool isLibraryCopy(const LibraryPlace &place, const fs::path &path) {
    return files::isBelow(path, place.copiesFolder());
}

// The library's copies of a series, by instance UID.
std::map<std::string, fs::path> libraryCopies(const Library &library, const LibrarySeries &series) {
    std::map<std::string, fs::path> own;
    for (const dicom::InstanceFile &file : library.files(series.study, series.volumes.front()))
        if (!file.sopInstanceUid.empty() && isLibraryCopy(library.place(), file.path) &&
            isFileThere(file))
            own[file.sopInstanceUid] = file.path;
    return own;
}

std::string seriesDigest(const LibrarySeries &s) {
    return digest(s.study.key() + "\n" + s.volumes.front().seriesUid + "\n" +
                  s.volumes.front().file);
}

dicom::Catalogue scanFiles(const Library &library, const Import &import,
                           const task::Progress &progress) {
    dicom::Catalogue catalogue = dicom::scan(import.paths, progress.part(0.0, 0.4));
    if (catalogue.empty()) {
        if (catalogue.skipped.size() == 1)
            throw Error(ErrorCode::unusable, catalogue.skipped[0].reason,
                        catalogue.skipped[0].path);
        throw Error(ErrorCode::unusable, because::holdsNoUsableImages, import.paths.front());
    }
    if (const auto parts = missingParts(library, catalogue); !parts.empty()) {
        std::vector<fs::path> paths = import.paths;
        paths.insert(paths.end(), parts.begin(), parts.end());
        catalogue = dicom::scan(paths, progress.part(0.4, 0.5));
    }
    return catalogue;
}

// Determines the path of each file in the library, and copies the files that need it.
class FilePlacer {
public:
    FilePlacer(const Library &library, ImportMode mode, ImportResult &result)
        : m_library(library), m_mode(mode), m_result(result), m_copies(library.place()) {}

    void place(std::vector<LibrarySeries> &all, const task::Progress &progress) {
        std::size_t done = 0, count = 0;
        bool copiesAny = false;
        for (const LibrarySeries &series : all) {
            count += series.files.size();
            copiesAny = copiesAny || std::any_of(series.files.begin(), series.files.end(),
                                                 [&](const auto &file) { return isCopied(file); });
        }
        if (copiesAny && m_library.place().inMemory)
            throw Error(ErrorCode::output, because::copiesNeedALibrary, m_library.place().folder);
        if (copiesAny)
            checkFreeSpace(m_library.place(), all);
        for (LibrarySeries &series : all) {
            ++m_result.series;
            m_result.files += int(series.files.size());
            const std::string folder = seriesDigest(series);
            const auto own = libraryCopies(m_library, series);
            std::erase_if(series.files, [&](dicom::InstanceFile &file) {
                progress.report(double(++done) / double(count));
                return !placeFile(file, series, folder, own, progress);
            });
        }
        std::erase_if(all, [](const LibrarySeries &s) { return s.files.empty(); });
    }
    Copies &copies() { return m_copies; }

private:
    // Files unpacked from archives are deleted when the program ends.
    bool isCopied(const dicom::InstanceFile &file) const {
        return m_mode == ImportMode::copy || files::isInSessionFolder(file.path);
    }
    // Places a file. Returns whether the library can refer to it.
    bool placeFile(dicom::InstanceFile &file, LibrarySeries &series, const std::string &folder,
                   const std::map<std::string, fs::path> &own, const task::Progress &progress) {
        if (isLibraryCopy(m_library.place(), file.path))
            return true;
        if (const auto held = own.find(file.sopInstanceUid); held != own.end()) {
            file.path = held->second; // the copy is safer than the new file
            return true;
        }
        if (!isCopied(file))
            return true;
        if (volume::isVolumeFile(file.path) &&
            decoding::readVolumeFileHeader(file.path, progress).samplesFile != file.path) {
            const bool isTemporary = files::isInSessionFolder(file.path);
            m_result.skipped.push_back(
                {file.path, isTemporary ? because::notImported : because::referredNotCopied});
            return !isTemporary;
        }
        const std::string instance =
            file.sopInstanceUid.empty() ? file.path.string() : file.sopInstanceUid;
        file.path = m_copies.add(file.path, folder, digest(QString::fromStdString(instance)));
        if (!series.volumes.front().file.isEmpty())
            series.volumes.front().file = QString::fromStdString(file.path.string());
        return true;
    }

    const Library &m_library;
    ImportMode m_mode;
    ImportResult &m_result;
    Copies m_copies;
};

} // namespace

ImportResult importStudies(const LibraryPlace &place, const Import &import,
                           const task::Progress &progress) {
    Library library(place);
    const dicom::Catalogue catalogue = scanFiles(library, import, progress);
    ImportResult result;
    result.skipped = dicom::problemsOf(catalogue);
    // The library lists volumes only.
    for (const dicom::Patient &patient : catalogue.patients)
        for (const dicom::Study &study : patient.studies)
            for (const dicom::SegmentationFile &file : study.segmentations)
                result.skipped.push_back(
                    {catalogue.named(file.path), task::because::isASegmentation});
    std::vector<LibrarySeries> all = seriesOf(catalogue, progress.part(0.5, 0.7));
    FilePlacer placer(library, import.mode, result);
    placer.place(all, progress.part(0.7, 0.99));
    progress.check(); // from here on, the import cannot be cancelled
    placer.copies().rename();
    placer.copies().flush();
    library.put(all);
    placer.copies().keep();
    if (import.listed)
        import.listed();
    progress.report(1.0);
    return result;
}

Removal removeStudy(Library &library, const StudyFacts &study) {
    Removal removal;
    removal.copies = library.copiesOf(study);
    if (!removal.copies.empty()) {
        removal.names = std::make_shared<files::SessionFolder>(library.place().incomingFolder());
        writeNames(removal.names->path(), removal.copies);
    }
    library.remove(study);
    if (removal.names)
        removal.names->setAbandoned(true);
    return removal;
}

void finish(const Removal &removal, Library &library) {
    library.removeCopies(removal.copies);
    if (removal.names)
        removal.names->setAbandoned(false);
}

ImportResult relistCopies(const LibraryPlace &place, const task::Progress &progress) {
    ImportResult result;
    try {
        result = importStudies(place, {{place.copiesFolder()}, ImportMode::refer}, progress);
    } catch (const Error &error) {
        if (error.code() != ErrorCode::unusable) // there are no copies
            throw;
    }
    std::error_code ignored;
    fs::remove(place.rebuiltMark(), ignored);
    return result;
}

bool hasUnfinishedImports(const LibraryPlace &place) {
    std::error_code ignored;
    return fs::exists(place.incomingFolder(), ignored);
}

void removeAbandonedImports(Library &library, LeftCopies left) {
    files::removeAbandonedSessionFolders(library.place().incomingFolder(),
                                         [&](const fs::path &folder) {
                                             if (left == LeftCopies::kept)
                                                 return;
                                             // Copies that already have their final names, but no
                                             // row in the list.
                                             std::ifstream names(namesFile(folder));
                                             std::vector<fs::path> copies;
                                             for (std::string name; std::getline(names, name);)
                                                 if (isLibraryCopy(library.place(), name))
                                                     copies.emplace_back(name);
                                             library.removeCopies(copies);
                                         });
    std::error_code ignored;
    fs::remove(library.place().incomingFolder(), ignored); // succeeds only if it is empty
}

} // namespace pellucid::ui
