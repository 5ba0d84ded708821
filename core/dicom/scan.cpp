// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/scan.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/decoding/client/decoder.h"
#include "core/decoding/client/read_volume_file.h"
#include "core/decoding/client/reasons.h"
#include "core/decoding/client/unpack_archive.h"
#include "core/dicom/file_list.h"
#include "core/dicom/group_series.h"
#include "core/dicom/missing_objects.h"
#include "core/dicom/reasons.h"
#include "core/dicom/uptake_scale.h"
#include "core/dicom/value_warnings.h"
#include "core/system/memory.h"
#include "core/task/error.h"
#include "core/volume/volume_file.h"

namespace pellucid::dicom {

namespace {

namespace fs = std::filesystem;
namespace because = task::because;
using task::Error;
using task::ErrorCode;

// The memory of a file's frames while they are sorted into volumes: as read, as sorted, and as
// references, each with its texts and path.
std::size_t bytesToGroup(const InstanceHeader &header) {
    constexpr std::size_t copies = 5, pathBytes = 256;
    std::size_t bytes = 0;
    for (const volume::ValueWindow &window : header.windows)
        bytes += sizeof window + (window.curve ? window.curve->size() * sizeof(float) : 0);
    for (const decoding::FrameHeader &frame : header.frames) {
        bytes += sizeof(PlacedFrame) + pathBytes;
        for (const auto &[tag, value] : frame.dimensions)
            bytes += 96 + value.capacity();
    }
    return copies * bytes;
}

task::Reason hugeReason(const InstanceHeader &h, std::uint64_t fileBytes) {
    return because::isUnusuallyLarge(h.columns, h.rows, h.frames.size(),
                                     fmt::format("{:.1f}", double(fileBytes) / 1e6));
}

using HeadersByPath = std::map<fs::path, const InstanceHeader *>;

// Whether images of one series state clearly different windows. Scanners set a window for each
// image of an MR or PET series by its own values: none of them fits the series.
bool doWindowsDiffer(const std::vector<const InstanceHeader *> &files) {
    constexpr double tolerance = 0.1; // of the width
    const auto first = std::find_if(files.begin(), files.end(),
                                    [](const InstanceHeader *h) { return !h->windows.empty(); });
    if (first == files.end())
        return false;
    const volume::ValueWindow &one = (*first)->windows.front();
    return std::any_of(first, files.end(), [&](const InstanceHeader *h) {
        if (h->windows.empty())
            return false;
        const volume::ValueWindow &other = h->windows.front();
        const double limit = tolerance * std::max(one.width, other.width);
        return std::abs(other.width - one.width) > limit ||
               std::abs(other.center - one.center) > limit;
    });
}

// The windows that the files of an entry agree on, in its unit. HU mean the same in each image:
// there, the middle image's windows are used, because the first image is often noise.
std::vector<volume::ValueWindow> windowsOf(const VolumeEntry &entry, const HeadersByPath &headers,
                                           const std::vector<const InstanceHeader *> &files) {
    if (entry.placed && entry.unit != volume::ValueUnit::hounsfield && doWindowsDiffer(files))
        return {};
    std::vector<volume::ValueWindow> windows =
        headers.at(entry.frames[entry.frames.size() / 2].path)->windows;
    if (windows.empty())
        windows = headers.at(entry.frames.front().path)->windows;
    for (volume::ValueWindow &window : windows) {
        window.center *= entry.valueFactor;
        window.width *= entry.valueFactor;
        // That function is for whole numbers.
        if (entry.valueFactor != 1.0 && window.function == volume::WindowFunction::linear)
            window.function = volume::WindowFunction::linearExact;
    }
    return windows;
}

// Sets the type of the values and the notes, from the first file of an entry. `mostStated`: the
// most that any image of its series states of what its samples mean, see `statedValues`. `pet`: the
// PET images of its series.
void describe(VolumeEntry &entry, const HeadersByPath &headers, int mostStated,
              const std::vector<const InstanceHeader *> &pet) {
    const InstanceHeader &h = *headers.at(entry.frames.front().path);
    entry.notes.title = h.seriesDescription.empty() ? h.modality : h.seriesDescription;
    entry.notes.modality = h.modality;
    entry.notes.bodyPart = h.bodyPart;
    entry.notes.darkIsHigh =
        h.photometric == "MONOCHROME1" || h.isInverse || (h.pet && entry.placed);
    entry.notes.spacingPlace = h.spacingPlace;
    entry.notes.placed = entry.placed;
    const FrameReference &front = entry.frames.front();
    entry.notes.isLocalizer = isLocalizer(h.frames.at(std::size_t(front.frame)));
    std::map<fs::path, const InstanceHeader *> files;
    for (const FrameReference &frame : entry.frames)
        files.emplace(frame.path, headers.at(frame.path));
    std::vector<const InstanceHeader *> each;
    for (const auto &[path, header] : files)
        each.push_back(header);
    entry.notes.studyUid = h.studyUid;
    // Some series have another frame of reference in every file: then it means nothing.
    if (std::all_of(each.begin(), each.end(), [&](const InstanceHeader *other) {
            return other->frameOfReferenceUid == h.frameOfReferenceUid;
        }))
        entry.notes.frameOfReferenceUid = h.frameOfReferenceUid;
    for (const task::Reason &warning : warningsOfValues(each))
        entry.notes.warnings.push_back(warning);
    if (!entry.placed) // last, because the view shows that one
        entry.notes.warnings.push_back(because::imagesOnly(*entry.notPlacedReason));
    entry.notes.lossy =
        std::any_of(entry.frames.begin(), entry.frames.end(),
                    [&](const FrameReference &frame) { return headers.at(frame.path)->lossy; });
    const int stated = statedValues(h, front.frame);
    const bool statesLess = stated < mostStated;
    const bool hounsfield =
        (h.rescaleType == "HU" ||
         (h.modality == "CT" && (h.rescaleType.empty() || h.rescaleType == "US"))) &&
        !statesLess;
    if (entry.placed && !entry.notes.isLocalizer &&
        (statesLess || (stated == 0 && h.modality == "CT")))
        entry.notes.warnings.push_back(statesLess ? because::valuesAsStored
                                                  : because::rescaleIsAssumed);
    if (hounsfield && entry.placed && h.modality == "CT") {
        entry.unit = volume::ValueUnit::hounsfield;
    } else if (h.pet && entry.placed) {
        const UptakeScale scale = uptakeScale(pet);
        entry.unit = scale.unit;
        entry.valueFactor = scale.factor;
        if (scale.notUptake)
            entry.notes.warnings.insert(entry.notes.warnings.begin(),
                                        because::noUptakeValues(*scale.notUptake));
    }
    entry.notes.windows = windowsOf(entry, headers, each);
    // The tilt of the gantry, which explains the sheared stack.
    const double tilt = entry.geometry.lattice.shearRad() * 180.0 / 3.14159265358979323846;
    if (entry.placed && tilt > 0.1 && entry.geometry.lattice.size().k > 1)
        entry.notes.warnings.push_back(because::tilted(fmt::format("{:.1f}", tilt)));
}

// Instance UIDs that several images share identify none of them.
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

// Maps series to studies in a catalogue, and adds new studies.
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
            studies.push_back({h.studyUid, h.studyDate, h.studyDescription, {}, {}});
        return studies[study->second];
    }
    // The study of a file, or null if it is not in the catalogue.
    Study *find(const InstanceHeader &h) {
        const auto patient = m_patients.find({h.patientId, h.patientName});
        if (patient == m_patients.end())
            return nullptr;
        const auto study = m_studies.find({patient->second, h.studyUid});
        return study == m_studies.end()
                   ? nullptr
                   : &m_catalogue.patients[patient->second].studies[study->second];
    }

private:
    Catalogue &m_catalogue;
    std::map<std::pair<std::string, std::string>, std::size_t> m_patients;
    std::map<std::pair<std::size_t, std::string>, std::size_t> m_studies;
};

void addVolumeFile(Catalogue &catalogue, const fs::path &path,
                   const decoding::VolumeFileHeader &header) {
    if (catalogue.patients.empty() || !catalogue.patients.back().isOfVolumeFiles)
        catalogue.patients.push_back(
            {"files", "Files", "", "", {{"", "", "Volume files", {}, {}}}, true});
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

// The memory of headers that are held until all are grouped. A refused one takes no memory from the
// others.
class HeldMemory {
public:
    explicit HeldMemory(std::size_t limit) : m_limit(limit) {}
    bool take(std::size_t bytes) {
        std::size_t held = m_held;
        while (bytes <= m_limit - held)
            if (m_held.compare_exchange_weak(held, held + bytes))
                return true;
        return false;
    }

private:
    const std::size_t m_limit;
    std::atomic<std::size_t> m_held = 0;
};

// Why a file is left out: lack of memory does not mean that the file is bad.
task::Reason reasonOf(const Error &error) {
    return error.code() == ErrorCode::outOfMemory ? because::needsTooMuchMemory : error.reason();
}

// The result of reading a file: one of the headers, or why there is none.
struct FileContents {
    InstanceHeader header; ///< also of a segmentation, which has a reason not to be an image
    std::optional<decoding::VolumeFileHeader> volumeFile;
    std::optional<task::Reason> reason;
    bool isHuge = false;
};

// Files that hold the samples of a header are not images themselves, and are not reported as
// skipped.
std::set<fs::path> samplesOf(const std::vector<FileContents> &contents) {
    std::set<fs::path> samples;
    for (const FileContents &file : contents)
        if (file.volumeFile)
            samples.insert(resolved(file.volumeFile->samplesFile));
    return samples;
}

// Reads the headers of files in parallel.
class HeaderReader {
public:
    HeaderReader(const ScanOptions &options, const task::Progress &progress)
        : m_options(options), m_progress(progress),
          m_held(std::max(system::availableMemoryBytes() / 2, bytesOfTypicalSeries)) {}

    std::vector<FileContents> read(const std::vector<fs::path> &paths) {
        std::vector<FileContents> contents(paths.size());
        std::atomic<std::size_t> done = 0;
        std::mutex reporting;
        tbb::parallel_for(std::size_t(0), paths.size(), [&](std::size_t n) {
            m_progress.check();
            readOne(paths[n], contents[n]);
            const std::lock_guard lock(reporting);
            m_progress.report(double(++done) / double(paths.size()));
        });
        return contents;
    }

private:
    // A small file may declare very many frames, and all of them are held until they are grouped.
    static constexpr std::size_t bytesOfTypicalSeries = std::size_t(32) << 20;

    void readOne(const fs::path &path, FileContents &contents) {
        try {
            if (volume::isVolumeFile(path))
                contents.volumeFile = decoding::readVolumeFileHeader(path, m_progress);
            else
                readInstance(path, contents);
        } catch (const Error &error) {
            if (error.code() == ErrorCode::internal) // nothing can be read without a decoder
                throw;
            contents.reason = error.code() != ErrorCode::outOfMemory && decoding::isArchive(path)
                                  ? because::isAnArchive
                                  : reasonOf(error);
        } catch (const std::bad_alloc &) {
            contents.reason = because::needsTooMuchMemory;
        }
    }

    void readInstance(const fs::path &path, FileContents &contents) {
        const auto known =
            m_options.decoded != nullptr ? m_options.decoded->header(path) : std::nullopt;
        InstanceHeader header =
            known ? *known : decoding::Decoder::shared().header(path, m_progress);
        std::error_code unknown;
        const auto bytes = fs::file_size(path, unknown);
        contents.reason = decoding::whyUnusable(header);
        if (!contents.reason && !m_options.includesHuge && decoding::isHuge(header, bytes)) {
            contents.reason = hugeReason(header, bytes);
            contents.isHuge = true;
        }
        if (!contents.reason && !m_held.take(bytesToGroup(header)))
            contents.reason = because::needsTooMuchMemory;
        if (contents.reason && contents.reason != task::Reason(because::isASegmentation))
            return;
        if (contents.reason)
            header.frames = std::vector<decoding::FrameHeader>(1); // only its identity is used
        contents.header = std::move(header);
    }

    const ScanOptions &m_options;
    const task::Progress &m_progress;
    HeldMemory m_held;
};

// The files of each series, in the order of their first files. A volume never mixes series: the key
// is the series with its patient. The study counts only for images without a series, because some
// writers give each slice its own study.
class SeriesSorter {
public:
    void add(SeriesFile file) {
        const InstanceHeader &h = file.header;
        const auto [it, isNew] =
            m_known.try_emplace({h.patientId, h.patientName,
                                 h.seriesUid.empty() ? h.studyUid : std::string(), h.seriesUid},
                                m_series.size());
        if (isNew)
            m_series.emplace_back();
        m_series[it->second].push_back(std::move(file));
    }
    const std::vector<std::vector<SeriesFile>> &series() const { return m_series; }

private:
    std::map<std::tuple<std::string, std::string, std::string, std::string>, std::size_t> m_known;
    std::vector<std::vector<SeriesFile>> m_series;
};

// Adds volume files and skipped files to the catalogue directly, sets segmentations aside, and
// sorts all others into series.
SeriesSorter sortFiles(const std::vector<fs::path> &paths, std::vector<FileContents> contents,
                       Catalogue &catalogue, std::vector<SeriesFile> &segmentations) {
    SeriesSorter sorter;
    const std::set<fs::path> samples = samplesOf(contents);
    for (std::size_t n = 0; n < paths.size(); ++n) {
        FileContents &file = contents[n];
        if (file.reason == task::Reason(because::isASegmentation)) {
            segmentations.push_back({paths[n], std::move(file.header)});
        } else if (file.reason) {
            if (samples.empty() || !samples.contains(resolved(paths[n])))
                catalogue.skipped.push_back({paths[n], *file.reason, file.isHuge});
        } else if (file.volumeFile) {
            addVolumeFile(catalogue, paths[n], *file.volumeFile);
        } else {
            sorter.add({paths[n], std::move(file.header)});
        }
    }
    return sorter;
}

Series seriesOf(const std::vector<SeriesFile> &files, Slices slices, std::vector<Skipped> &skipped,
                const task::Progress &progress) {
    const InstanceHeader &h = files.front().header;
    const ReadAttributes read = [&](const fs::path &path) {
        return decoding::Decoder::shared().attributes(path, progress);
    };
    Series series{
        h.seriesUid, h.seriesDescription, h.modality,
        h.bodyPart,  h.seriesNumber,      groupSeries(files, skipped, progress, slices, read),
        {}};
    addFiles(series, files);
    HeadersByPath headers;
    std::set<std::string> studies;
    for (const SeriesFile &file : files) {
        headers[file.path] = &file.header;
        studies.insert(file.header.studyUid);
    }
    // The decay correction refers to the start of the series, also of its later phases.
    std::vector<const InstanceHeader *> pet;
    for (const SeriesFile &file : files)
        if (file.header.pet)
            pet.push_back(&file.header);
    int mostStated = 0;
    for (const SeriesFile &file : files)
        mostStated = std::max(mostStated, statedValues(file.header, 0));
    // Files of one folder belong to one study.
    std::map<fs::path, std::optional<std::size_t>> missing;
    for (VolumeEntry &volume : series.volumes) {
        for (const FrameReference &frame : volume.frames) {
            const auto [at, isNew] = missing.try_emplace(frame.path.parent_path());
            if (isNew)
                at->second = missingObjectsBeside(frame.path);
            if (at->second) {
                volume.notes.warnings.push_back(because::objectsOfStudyMissing(*at->second));
                break;
            }
        }
        if (studies.size() > 1)
            volume.notes.warnings.push_back(because::namesSeveralStudies(studies.size()));
        describe(volume, headers, mostStated, pet);
    }
    return series;
}

} // namespace

Catalogue scan(const std::vector<fs::path> &paths, const task::Progress &progress,
               const ScanOptions &options) {
    if (!options.isSameSource)
        decoding::Decoder::shared().beginOpening();
    FileList list = listFiles(paths, progress);
    std::vector<FileContents> contents = HeaderReader(options, progress).read(list.found);
    Catalogue catalogue;
    catalogue.skipped = std::move(list.skipped);
    catalogue.unpacked = std::move(list.unpacked);
    std::vector<SeriesFile> segmentations;
    const SeriesSorter sorter =
        sortFiles(list.found, std::move(contents), catalogue, segmentations);
    Studies studies(catalogue);
    for (const std::vector<SeriesFile> &files : sorter.series()) {
        Series series = seriesOf(files, options.slices, catalogue.skipped, progress);
        studies.of(files.front().header).series.push_back(std::move(series));
    }
    for (const SeriesFile &file : segmentations) {
        const InstanceHeader &h = file.header;
        if (Study *const study = studies.find(h))
            study->segmentations.push_back({file.path, h.seriesDescription, h.modality});
        else
            catalogue.skipped.push_back({file.path, because::isASegmentation});
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
