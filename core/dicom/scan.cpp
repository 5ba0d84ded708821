// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/scan.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <new>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/decoder/decoder.h"
#include "core/decoder/read_volume_file.h"
#include "core/decoder/unpack_archive.h"
#include "core/dicom/group_series.h"
#include "core/system/memory.h"
#include "core/system/text.h"
#include "core/task/error.h"
#include "core/volume/volume_file.h"

namespace pellucid::dicom {

namespace {

namespace fs = std::filesystem;
namespace because = task::because;
using task::Error;
using task::ErrorCode;

// The same for every path to a file, as far as the system tells.
fs::path resolved(const fs::path &path) {
    std::error_code unknown;
    const fs::path canonical = fs::weakly_canonical(path, unknown);
    return unknown ? path : canonical;
}

// CDs are written in capitals and mounted in lower case: an entry matches whatever its case. Each
// folder is read once.
class CaselessFolders {
public:
    fs::path childOf(const fs::path &folder, const std::string &name) {
        std::error_code ignored;
        if (fs::exists(folder / name, ignored))
            return folder / name;
        const auto [names, isNew] = m_names.try_emplace(folder);
        if (isNew)
            for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
                 entry.increment(ignored))
                names->second.try_emplace(system::lowered(entry->path().filename().string()),
                                          entry->path());
        const auto it = names->second.find(system::lowered(name));
        return it == names->second.end() ? folder / name : it->second;
    }

private:
    std::map<fs::path, std::map<std::string, fs::path>> m_names;
};

class FileList {
public:
    explicit FileList(const task::Progress &progress) : m_progress(progress) {}

    void add(const fs::path &path) {
        if (path.empty())
            throw Error(ErrorCode::unusable, because::emptyPath);
        std::error_code error;
        const fs::file_status status = fs::status(path, error);
        if (!fs::exists(status))
            throw Error(ErrorCode::unusable,
                        error && status.type() != fs::file_type::not_found
                            ? task::systemReason(error)
                            : because::doesNotExist,
                        path);
        if (fs::is_directory(status))
            addFolder(path);
        else if (!fs::is_regular_file(status))
            throw Error(ErrorCode::unusable, because::isNeitherFileNorFolder, path);
        else if (decoder::isArchive(path))
            addArchive(path);
        else if (const auto directory = directoryAt(path); directory.isDirectory)
            addDirectory(path, directory);
        else
            addFile(path);
    }

    std::vector<fs::path> found;
    std::vector<Skipped> skipped;
    std::vector<Unpacked> unpacked;

private:
    void addFile(const fs::path &path) {
        if (m_seen.insert(resolved(path)).second)
            found.push_back(path);
    }

    void addArchive(const fs::path &path) {
        auto folder = std::make_shared<files::SessionFolder>();
        for (const auto &file : decoder::unpackArchive(decoder::Decoder::ofProgram(), path,
                                                       folder->path(), m_progress))
            skipped.push_back({path / fs::path(file.name).relative_path(), file.reason});
        addFolder(folder->path());
        unpacked.push_back({std::move(folder), path});
    }

    // What is no DICOM file at all is said when it is read.
    decoder::DirectoryFile directoryAt(const fs::path &path) const {
        return volume::isVolumeFile(path)
                   ? decoder::DirectoryFile()
                   : decoder::Decoder::ofProgram().directory(path, m_progress);
    }

    void addDirectory(const fs::path &path, const decoder::DirectoryFile &directory) {
        std::error_code unknown;
        const fs::path folder = fs::weakly_canonical(fs::absolute(path).parent_path(), unknown);
        CaselessFolders folders;
        for (const auto &parts : directory.files) {
            m_progress.check();
            fs::path listed = path.parent_path();
            for (const std::string &part : parts) {
                // A part must be a plain name: an index may not lead out of its own folder.
                if (part == ".." || part.find_first_of(std::string_view("/\0", 2)) != part.npos)
                    throw Error(ErrorCode::unusable, because::listsAFileOutside, path);
                listed = folders.childOf(listed, part);
            }
            std::error_code ignored;
            if (!fs::is_regular_file(listed, ignored)) {
                skipped.push_back({listed, because::isListedButMissing});
                continue;
            }
            // A link leads elsewhere, too.
            const fs::path meant =
                fs::weakly_canonical(fs::absolute(listed), ignored).lexically_relative(folder);
            if (meant.empty() || *meant.begin() == "..")
                skipped.push_back({listed, because::listsAFileOutside});
            else
                addFile(listed);
        }
    }

    void addFolder(const fs::path &folder) {
        std::error_code error;
        fs::directory_iterator top(folder, error);
        if (error)
            throw Error(ErrorCode::unusable, task::systemReason(error), folder);
        std::vector<fs::path> pending{folder}, below;
        while (!pending.empty()) {
            m_progress.check();
            const fs::path current = pending.back();
            pending.pop_back();
            fs::directory_iterator entries(current, error);
            if (error) {
                skipped.push_back({current, task::systemReason(error)});
                continue;
            }
            for (; entries != fs::directory_iterator(); entries.increment(error)) {
                const fs::directory_entry &entry = *entries;
                std::error_code ignored;
                const bool link = entry.is_symlink(ignored);
                if (entry.is_directory(ignored)) {
                    if (link)
                        skipped.push_back({entry.path(), because::linksToAFolder});
                    else
                        pending.push_back(entry.path());
                } else if (entry.is_regular_file(ignored)) {
                    below.push_back(entry.path());
                } else {
                    skipped.push_back(
                        {entry.path(), link ? because::isABrokenLink : because::isNotARegularFile});
                }
            }
            if (error) // a share or a CD that fails half way
                skipped.push_back({current, task::systemReason(error)});
        }
        std::sort(below.begin(), below.end());
        for (const fs::path &path : below)
            addFile(path);
    }

    const task::Progress &m_progress;
    std::set<fs::path> m_seen;
};

// What the frames of a file take while they are sorted into volumes: as they were read, as they are
// sorted, and as they are referred to; each with its texts and its path.
std::size_t bytesToGroup(const InstanceHeader &header) {
    constexpr std::size_t copies = 5, pathBytes = 256;
    std::size_t bytes = 0;
    for (const decoder::FrameHeader &frame : header.frames) {
        bytes += sizeof(PlacedFrame) + pathBytes + frame.imageType.capacity();
        for (const auto &[name, value] : frame.dimensions)
            bytes += 64 + name.capacity() + value.capacity();
    }
    return copies * bytes;
}

task::Reason hugeReason(const InstanceHeader &h, std::uint64_t fileBytes) {
    return because::isUnusuallyLarge(h.columns, h.rows, h.frames.size(),
                                     fmt::format("{:.1f}", double(fileBytes) / 1e6));
}

using HeadersByPath = std::map<fs::path, const InstanceHeader *>;

// What the volume's values and notes are, from the first file of a series' entry.
void describe(VolumeEntry &entry, const HeadersByPath &headers) {
    const InstanceHeader &h = *headers.at(entry.frames.front().path);
    entry.notes.title = h.seriesDescription.empty() ? h.modality : h.seriesDescription;
    entry.notes.modality = h.modality;
    // Of series whose images state windows of their own, the middle one's: the first is often
    // noise.
    entry.notes.windows = headers.at(entry.frames[entry.frames.size() / 2].path)->windows;
    if (entry.notes.windows.empty())
        entry.notes.windows = h.windows;
    entry.notes.darkIsHigh = h.photometric == "MONOCHROME1";
    entry.notes.placed = entry.placed;
    std::map<fs::path, const InstanceHeader *> files;
    for (const FrameReference &frame : entry.frames)
        files.emplace(frame.path, headers.at(frame.path));
    std::vector<const InstanceHeader *> each;
    for (const auto &[path, header] : files)
        each.push_back(header);
    for (const task::Reason &warning : warningsOfValues(each))
        entry.notes.warnings.push_back(warning);
    if (!entry.placed) // the last: it is what the view says
        entry.notes.warnings.push_back(because::imagesOnly(*entry.notPlacedReason));
    entry.notes.lossy =
        std::any_of(entry.frames.begin(), entry.frames.end(),
                    [&](const FrameReference &frame) { return headers.at(frame.path)->lossy; });
    const bool hounsfield =
        h.rescaleType == "HU" ||
        (h.modality == "CT" && (h.rescaleType.empty() || h.rescaleType == "US"));
    entry.unit = hounsfield && entry.placed && h.modality == "CT" ? volume::ValueUnit::hounsfield
                                                                  : volume::ValueUnit::none;
    // Tilt as the table needs it, so that nobody wonders about the leaning stack.
    const double tilt = entry.geometry.lattice.shearRad() * 180.0 / 3.14159265358979323846;
    if (entry.placed && tilt > 0.1 && entry.geometry.lattice.size().k > 1)
        entry.notes.warnings.push_back(because::tilted(fmt::format("{:.1f}", tilt)));
}

// Instance UIDs that several images share tell none of them.
void addFiles(Series &series, const std::vector<SeriesFile> &files) {
    std::map<std::string, std::size_t> images;
    std::set<fs::path> used;
    for (const VolumeEntry &volume : series.volumes)
        for (const FrameReference &frame : volume.frames)
            used.insert(frame.path);
    for (const SeriesFile &file : files)
        images[file.header.sopInstanceUid] += used.contains(file.path) ? 1 : 0;
    for (const SeriesFile &file : files) {
        const std::string &uid = file.header.sopInstanceUid;
        series.files.push_back({file.path, images[uid] > 1 ? std::string() : uid});
    }
}

// Where in a catalogue the studies are that series belong to; new ones are added.
class Studies {
public:
    explicit Studies(Catalogue &catalogue) : m_catalogue(catalogue) {}

    Study &of(const InstanceHeader &h) {
        auto &patients = m_catalogue.patients;
        const auto [patient, isNewPatient] =
            m_patients.try_emplace({h.patientId, h.patientName}, patients.size());
        if (isNewPatient)
            patients.push_back({h.patientId, h.patientName, h.birthDate, h.sex, {}});
        auto &studies = patients[patient->second].studies;
        const auto [study, isNewStudy] =
            m_studies.try_emplace({patient->second, h.studyUid}, studies.size());
        if (isNewStudy)
            studies.push_back({h.studyUid, h.studyDate, h.studyDescription, {}});
        return studies[study->second];
    }

private:
    Catalogue &m_catalogue;
    std::map<std::pair<std::string, std::string>, std::size_t> m_patients;
    std::map<std::pair<std::size_t, std::string>, std::size_t> m_studies;
};

void addVolumeFile(Catalogue &catalogue, const fs::path &path,
                   const decoder::VolumeFileHeader &header) {
    if (catalogue.patients.empty() || catalogue.patients.back().id != "files")
        catalogue.patients.push_back({"files", "Files", "", "", {{"", "", "Volume files", {}}}});
    Series series;
    series.description = path.filename().string();
    series.number = int(catalogue.patients.back().studies[0].series.size()) + 1;
    series.files.push_back({path, ""});
    for (int n = 0; n < header.volumes; ++n) {
        VolumeEntry entry;
        entry.volumeFile = path;
        entry.fileVolume = n;
        if (header.volumes > 1)
            entry.label = {because::temporalPosition(n + 1)};
        entry.geometry.lattice = header.lattice;
        entry.notes = header.notes;
        series.volumes.push_back(std::move(entry));
    }
    catalogue.patients.back().studies[0].series.push_back(std::move(series));
}

// Files that hold the samples of a header are no images by themselves, and nobody's loss.
std::set<fs::path>
samplesOf(const std::vector<std::optional<decoder::VolumeFileHeader>> &volumeFiles) {
    std::set<fs::path> samples;
    for (const auto &file : volumeFiles)
        if (file)
            samples.insert(resolved(file->samplesFile));
    return samples;
}

// What headers take that are held until all of them are grouped. One that is refused takes nothing
// from the others.
class HeldMemory {
public:
    explicit HeldMemory(std::size_t most) : m_most(most) {}
    bool take(std::size_t bytes) {
        std::size_t held = m_held;
        while (bytes <= m_most - held)
            if (m_held.compare_exchange_weak(held, held + bytes))
                return true;
        return false;
    }

private:
    const std::size_t m_most;
    std::atomic<std::size_t> m_held = 0;
};

// Of a file that is left out: that there is no memory is not its fault.
task::Reason reasonOf(const Error &error) {
    return error.code() == ErrorCode::outOfMemory ? because::needsTooMuchMemory : error.reason();
}

} // namespace

Catalogue scan(const std::vector<fs::path> &paths, const task::Progress &progress,
               const ScanOptions &options) {
    decoder::Decoder::ofProgram().beginOpening();
    FileList list(progress);
    for (const fs::path &path : paths) {
        try {
            list.add(path);
        } catch (const Error &error) {
            // One of several paths does not keep the others from being opened; a full disk does.
            if (paths.size() == 1 || error.code() == ErrorCode::output)
                throw;
            list.skipped.push_back({path, reasonOf(error)});
        }
    }

    // A small file may announce very many frames: all of them are held until they are grouped.
    constexpr std::size_t ofUsualSeries = std::size_t(32) << 20;
    HeldMemory held(std::max(system::availableMemoryBytes() / 2, ofUsualSeries));
    std::vector<InstanceHeader> headers(list.found.size());
    std::vector<std::optional<decoder::VolumeFileHeader>> volumeFiles(list.found.size());
    std::vector<std::optional<task::Reason>> reasons(list.found.size());
    std::vector<char> huge(list.found.size()); // not bool: each is written by its own thread
    std::atomic<std::size_t> done = 0;
    std::mutex reporting;
    tbb::parallel_for(std::size_t(0), list.found.size(), [&](std::size_t n) {
        progress.check();
        try {
            if (volume::isVolumeFile(list.found[n])) {
                volumeFiles[n] = decoder::readVolumeFileHeader(list.found[n], progress);
            } else {
                InstanceHeader header =
                    decoder::Decoder::ofProgram().header(list.found[n], progress);
                std::error_code unknown;
                const auto bytes = fs::file_size(list.found[n], unknown);
                reasons[n] = decoder::whyUnusable(header);
                if (!reasons[n] && !options.takesHuge && decoder::isHuge(header, bytes)) {
                    reasons[n] = hugeReason(header, bytes);
                    huge[n] = 1;
                }
                if (!reasons[n] && !held.take(bytesToGroup(header)))
                    reasons[n] = because::needsTooMuchMemory;
                if (!reasons[n])
                    headers[n] = std::move(header);
            }
        } catch (const Error &error) {
            if (error.code() == ErrorCode::internal) // without a decoder nothing can be read
                throw;
            reasons[n] = error.code() != ErrorCode::outOfMemory && decoder::isArchive(list.found[n])
                             ? because::isAnArchive
                             : reasonOf(error);
        } catch (const std::bad_alloc &) {
            reasons[n] = because::needsTooMuchMemory;
        }
        const std::lock_guard lock(reporting);
        progress.report(double(++done) / double(list.found.size()));
    });

    Catalogue catalogue;
    catalogue.skipped = std::move(list.skipped);
    catalogue.unpacked = std::move(list.unpacked);
    // Never two series in one volume: the key is the series with its patient. The study counts only
    // for images that name no series: some writers give each slice a study of its own.
    std::map<std::tuple<std::string, std::string, std::string, std::string>,
             std::vector<SeriesFile>>
        series;
    std::vector<std::tuple<std::string, std::string, std::string, std::string>> order;
    const std::set<fs::path> samples = samplesOf(volumeFiles);
    for (std::size_t n = 0; n < list.found.size(); ++n) {
        if (reasons[n]) {
            if (!samples.empty() && samples.contains(resolved(list.found[n])))
                continue;
            catalogue.skipped.push_back({list.found[n], *reasons[n], huge[n] != 0});
            continue;
        }
        if (volumeFiles[n]) {
            addVolumeFile(catalogue, list.found[n], *volumeFiles[n]);
            continue;
        }
        const InstanceHeader &h = headers[n];
        const auto key = std::tuple(h.patientId, h.patientName,
                                    h.seriesUid.empty() ? h.studyUid : std::string(), h.seriesUid);
        auto &files = series[key];
        if (files.empty())
            order.push_back(key);
        files.push_back({list.found[n], std::move(headers[n])});
    }
    Studies studies(catalogue);
    for (const auto &key : order) {
        const std::vector<SeriesFile> &files = series[key];
        const InstanceHeader &h = files.front().header;
        Series entry{
            h.seriesUid, h.seriesDescription, h.modality,
            h.bodyPart,  h.seriesNumber,      groupSeries(files, catalogue.skipped, progress),
            {}};
        addFiles(entry, files);
        HeadersByPath headersByPath;
        for (const SeriesFile &file : files)
            headersByPath[file.path] = &file.header;
        std::set<std::string> namedStudies;
        for (const SeriesFile &file : files)
            namedStudies.insert(file.header.studyUid);
        for (VolumeEntry &volume : entry.volumes) {
            if (namedStudies.size() > 1)
                volume.notes.warnings.push_back(because::namesSeveralStudies(namedStudies.size()));
            describe(volume, headersByPath);
        }
        studies.of(h).series.push_back(std::move(entry));
    }
    for (Skipped &skipped : catalogue.skipped)
        skipped.path = catalogue.named(skipped.path);
    for (Patient &patient : catalogue.patients)
        for (Study &study : patient.studies)
            std::stable_sort(study.series.begin(), study.series.end(),
                             [](const Series &a, const Series &b) { return a.number < b.number; });
    return catalogue;
}

} // namespace pellucid::dicom
