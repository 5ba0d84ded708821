// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/input.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <set>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/reason_lines.h"
#include "app/cli/reasons.h"
#include "app/cli/terminal.h"
#include "core/confined/protection.h"
#include "core/confined/reasons.h"
#include "core/decoding/client/decoder.h"
#include "core/decoding/client/read_volume_file.h"
#include "core/decoding/client/reasons.h"
#include "core/dicom/reasons.h"
#include "core/dicom/scan.h"
#include "core/files/file_ids.h"
#include "core/files/reasons.h"
#include "core/subtraction/difference.h"
#include "core/system/text.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::cli {

namespace {

double nowMs() {
    return std::chrono::duration<double, std::milli>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

namespace because = task::because;
using task::Error;
using task::ErrorCode;

// Input files are never overwritten.
void requireNotRead(const std::vector<std::filesystem::path> &outs,
                    const std::filesystem::path &path, const dicom::Catalogue &catalogue) {
    const files::FileIds outputs(outs);
    if (outputs.isEmpty())
        return;
    const auto check = [&](const std::filesystem::path &file) {
        if (const auto out = outputs.find(file))
            throw Error(ErrorCode::usage, because::inWords("-o: is one of the files that are read"),
                        *out);
    };
    check(path);
    for (const dicom::Skipped &s : catalogue.skipped)
        check(s.path);
    for (const dicom::Patient &patient : catalogue.patients)
        for (const dicom::Study &study : patient.studies)
            for (const dicom::SegmentationFile &file : study.segmentations)
                check(file.path);
    for (const dicom::Selection &s : dicom::selections(catalogue)) {
        for (const dicom::InstanceFile &file : s.series->files)
            check(file.path);
        if (!s.volume->volumeFile.empty())
            check(decoding::readVolumeFileHeader(s.volume->volumeFile).samplesFile);
    }
}

std::size_t filesOf(const dicom::VolumeEntry &volume) {
    std::set<std::filesystem::path> files;
    for (const dicom::FrameReference &frame : volume.frames)
        files.insert(frame.path);
    return files.size();
}

void warnOfOthers(const dicom::Catalogue &catalogue, const dicom::Selection &shown,
                  bool isSeriesByDefault, bool isVolumeByDefault) {
    std::size_t others = 0;
    std::vector<Named> unused;
    for (const dicom::Skipped &skipped : catalogue.skipped)
        if (skipped.reason.is(because::isNotDicom))
            ++others; // texts and programs beside images
        else
            unused.push_back({skipped.path.string(), skipped.reason});
    constexpr std::size_t maxLines = 20;
    const std::vector<std::string> lines = linesByReason(unused, "not used");
    for (std::size_t n = 0; n < std::min(lines.size(), maxLines); ++n)
        warn(lines[n]);
    if (lines.size() > maxLines)
        warn(fmt::format("more reasons for unused files: {}; 'info' lists them",
                         lines.size() - maxLines));
    if (others > 0)
        warn(fmt::format("unused files of other kinds: {}; 'info' lists them", others));
    std::set<const dicom::Series *> series;
    for (const dicom::Selection &s : dicom::selections(catalogue))
        series.insert(s.series);
    const std::size_t patients = catalogue.patients.size();
    if (isSeriesByDefault && series.size() > 1)
        warn(fmt::format("using series {} ({}), one of {} series of {}; --series selects another, "
                         "'info' lists them",
                         shown.series->number, shown.series->uid, series.size(),
                         counted(patients, "patient")));
    const std::vector<dicom::VolumeEntry> &volumes = shown.series->volumes;
    if (isVolumeByDefault && volumes.size() > 1) {
        // Volumes of one file have no frames.
        const std::size_t files = shown.volume->volumeFile.empty() ? filesOf(*shown.volume) : 1;
        const std::size_t all = shown.series->files.size();
        warn(fmt::format("volume {} of {} in the series ('{}', {} of {}); --volume selects "
                         "another, 'info' lists them",
                         shown.volume - volumes.data() + 1, volumes.size(),
                         dicom::labelText(shown.volume->label), files, counted(all, "file")));
    }
}

// Files that did not fit in memory may be good: report the lack of memory, not unusable files.
void requireAllRead(const std::vector<dicom::Skipped> &skipped, const std::filesystem::path &path) {
    const auto lacking = std::count_if(skipped.begin(), skipped.end(), [](const auto &s) {
        return s.reason.is(because::needsTooMuchMemory);
    });
    if (lacking > 0)
        throw Error(ErrorCode::outOfMemory,
                    because::inWords(fmt::format("{} of its files {} more memory than is available",
                                                 lacking, lacking == 1 ? "needs" : "need")),
                    path);
}

} // namespace

Stopwatch::Stopwatch() : m_last(nowMs()) {}

double Stopwatch::lapMs() {
    const double now = nowMs(), lap = now - m_last;
    m_last = now;
    return lap;
}

void naming(const std::filesystem::path &path, const std::function<void()> &work) {
    try {
        work();
    } catch (const Error &error) {
        if (error.code() != ErrorCode::outOfMemory || !error.path().empty())
            throw;
        throw Error(error.code(), error.reason(), path);
    } catch (const task::Cancelled &) {
        throw;
    } catch (const std::exception &error) {
        if (!task::isLackOfMemory(error))
            throw;
        throw Error(ErrorCode::outOfMemory, because::notEnoughMemory, path);
    }
}

[[noreturn]] void failWithoutImages(const dicom::Catalogue &catalogue,
                                    const std::filesystem::path &path) {
    requireAllRead(catalogue.skipped, path);
    const auto huge = std::find_if(catalogue.skipped.begin(), catalogue.skipped.end(),
                                   [](const dicom::Skipped &s) { return s.isHuge; });
    if (huge != catalogue.skipped.end())
        throw Error(ErrorCode::unusable,
                    because::inWords(huge->reason.english() + "; --large opens it"), huge->path);
    if (catalogue.skipped.size() == 1)
        throw Error(ErrorCode::unusable, catalogue.skipped[0].reason, catalogue.skipped[0].path);
    if (catalogue.skipped.empty())
        throw Error(ErrorCode::unusable, because::holdsNoUsableImages, path);
    throw Error(ErrorCode::unusable,
                because::inWords(fmt::format("contains no usable images in {} files; {}: {}",
                                             catalogue.skipped.size(),
                                             catalogue.skipped[0].path.filename().string(),
                                             catalogue.skipped[0].reason.english())),
                path);
}

CLI::Validator notEmpty() {
    return {[](std::string &text) { return text.empty() ? "must not be empty" : std::string(); },
            "", "text"};
}

void addProtectionOption(CLI::App &command, bool &allowsUnprotected) {
    command.add_flag("--allow-unprotected", allowsUnprotected,
                     "Run even if this system cannot confine the processes that read files");
}

void requireProtection(const std::string &command, bool allowsUnprotected) {
    if (allowsUnprotected)
        return;
    confined::whenUnprotected([command] {
        throw task::Error(task::ErrorCode::usage,
                          task::because::systemDoesNotProtectUnattended(
                              task::because::systemDoesNotProtect, command));
    });
    decoding::Decoder::shared().confinement(); // before any other work
}

void addLargeOption(CLI::App &command, bool &large) {
    command.add_flag("--large", large,
                     "Also open images that are unusually large, or that claim to be much larger "
                     "than their file");
}

void addInputOptions(CLI::App &command, InputOptions &options) {
    CLI::Option *const path = command.add_option(
        "PATH", options.path,
        "A file, a folder, a DICOMDIR, a ZIP archive, or a volume in NRRD, NIfTI or MetaImage");
    addRemoteOptions(command, options.remote, *path);
    command
        .add_option("--series", options.series,
                    "Series number or UID; default: the one whose volume has the most voxels")
        ->check(notEmpty());
    command
        .add_option("--volume", options.volume,
                    "Number of the volume in the series, as 'info' lists it; default: the one with "
                    "the most voxels")
        ->check(CLI::Range(1, 1000000));
    command
        .add_flag("--fill-gaps", options.fillGaps,
                  "Interpolate gaps of several slices; default: use the longest run without one")
        ->excludes("--volume");
    addLargeOption(command, options.large);
}

namespace {

Input openOne(const InputOptions &options, const std::vector<std::filesystem::path> &outs,
              const Context &context) {
    Stopwatch watch;
    std::optional<FetchedStudy> fetched;
    if (options.remote.isGiven())
        fetched.emplace(options.remote, options.series, context);
    const std::filesystem::path path =
        options.remote.isGiven() ? options.remote.server : options.path;
    const task::Progress progress(context.stop);
    const dicom::Catalogue catalogue =
        dicom::scan({fetched ? fetched->path() : path}, progress, {options.large});
    Input input;
    input.skipped = catalogue.skipped;
    input.scanMs = watch.lapMs();
    if (catalogue.empty())
        failWithoutImages(catalogue, path);
    requireNotRead(outs, path, catalogue);
    dicom::Selection selection;
    try {
        const auto holes = options.fillGaps ? dicom::Holes::fill : dicom::Holes::split;
        selection = options.series.empty() ? dicom::defaultSelection(catalogue, holes)
                                           : dicom::selectSeries(catalogue, options.series, holes);
        if (options.volume > 0)
            selection = dicom::selectVolume(selection, options.volume);
    } catch (const Error &error) {
        throw Error(error.code(), error.reason(), path);
    }
    if (!selection.volume->placed) {
        requireAllRead(catalogue.skipped, path);
        throw Error(ErrorCode::unusable,
                    because::inWords("contains images but no volume: " +
                                     selection.volume->notPlacedReason->english()),
                    path);
    }
    try {
        input.loaded = dicom::loadVolume(*selection.volume, progress);
    } catch (const Error &error) { // name the archive's entry: its unpacked file is deleted at exit
        throw Error(error.code(), error.reason(),
                    error.path().empty() ? path : catalogue.named(error.path()));
    }
    if (!input.loaded.volume.notes().placed) {
        requireAllRead(input.loaded.skipped, path);
        throw Error(ErrorCode::unusable,
                    because::inWords("contains images but no volume: " +
                                     input.loaded.volume.notes().warnings.back().english()),
                    path);
    }
    input.seriesUid = selection.series->uid;
    input.seriesDescription = selection.series->description;
    input.labels = dicom::captureLabels(selection);
    for (dicom::Skipped &skipped : input.loaded.skipped)
        skipped.path = catalogue.named(skipped.path);
    input.skipped.insert(input.skipped.end(), input.loaded.skipped.begin(),
                         input.loaded.skipped.end());
    // Warn even without --json, above all about slices that are left out.
    warnOfOthers(catalogue, selection, options.series.empty(), options.volume == 0);
    for (const task::Reason &warning : input.loaded.volume.notes().warnings)
        warn(warning.english());
    input.loadMs = watch.lapMs();
    return input;
}

// Replaces the volume by its difference from another one.
void subtractFrom(Input &input, const InputOptions &options,
                  const std::vector<std::filesystem::path> &outs, const Context &context) {
    InputOptions other;
    other.path = options.subtract;
    other.series = options.subtractSeries;
    other.fillGaps = options.fillGaps;
    other.large = options.large;
    const task::Progress progress(context.stop);
    subtraction::Weights weights;
    if (!options.weights.empty()) {
        const auto given = parseNumbers("--weights", options.weights, ',', 2);
        weights = {given[0], given[1]};
        subtraction::validate(weights);
    }
    try {
        const Input subtrahend = openOne(other, outs, context);
        const volume::Volume &a = input.loaded.volume, &b = subtrahend.loaded.volume;
        if (input.labels.patientId != subtrahend.labels.patientId)
            warn("--subtract: the two volumes have different patient IDs");
        const subtraction::Subtraction made =
            subtraction::subtract(a, b,
                                  options.alignment == "rigid" ? subtraction::Registering::rigid
                                                               : subtraction::Registering::none,
                                  weights, progress);
        if (made.needsAlignment)
            warn("--subtract: the two volumes have different frames of reference; --register rigid "
                 "aligns them");
        input.registration = made.registration;
        input.loaded.volume = made.difference;
        input.scanMs += subtrahend.scanMs;
        input.loadMs += subtrahend.loadMs;
    } catch (const Error &error) {
        throw Error(error.code(), error.reason(),
                    error.path().empty() ? std::filesystem::path(options.subtract) : error.path());
    }
}

} // namespace

Input openInput(const InputOptions &options, const std::vector<std::filesystem::path> &outs,
                const Context &context) {
    requirePathOrServer(!options.path.empty(), options.remote);
    Input input = openOne(options, outs, context);
    if (!options.subtract.empty())
        subtractFrom(input, options, outs, context);
    return input;
}

void addSubtractionOptions(CLI::App &command, InputOptions &options) {
    CLI::Option *subtract =
        command
            .add_option("--subtract", options.subtract,
                        "A study whose volume is subtracted, such as the pre-contrast phase")
            ->check(notEmpty());
    command
        .add_option("--subtract-series", options.subtractSeries,
                    "Series number or UID in that study; default: the one whose volume has the "
                    "most voxels")
        ->check(notEmpty())
        ->needs(subtract);
    command
        .add_option("--register", options.alignment,
                    "Align that volume first: rigid (rotation and shift, by mutual information)")
        ->check(CLI::IsMember({"rigid"}))
        ->needs(subtract);
    command
        .add_option("--weights", options.weights,
                    "A,B: show A times the volume plus B times the other, each from -2 to 2; "
                    "default 1,-1")
        ->check(notEmpty())
        ->needs(subtract);
}

std::vector<double> parseNumbers(const std::string &option, const std::string &text, char separator,
                                 std::size_t count) {
    std::vector<double> values;
    bool areNumbers = true;
    for (std::size_t first = 0; areNumbers && first <= text.size();) {
        const std::size_t end = std::min(text.find(separator, first), text.size());
        // Decimal numbers only: with the separator 'x', 0x10 means 0 by 10.
        const auto value = system::numberFrom(std::string_view(text).substr(first, end - first));
        areNumbers = value && std::isfinite(*value);
        values.push_back(value.value_or(0.0));
        first = end + 1;
    }
    if (!areNumbers || values.size() != count)
        throw Error(ErrorCode::usage,
                    because::inWords(option + ": '" + text + "' is not " + std::to_string(count) +
                                     " numbers separated by '" + separator + "'"));
    return values;
}

classify::FieldWindow parseWindow(const std::string &text) {
    const auto values = parseNumbers("--window", text, ',', 2);
    if (!(values[0] < values[1]))
        throw Error(ErrorCode::usage,
                    because::inWords("--window: the low end must be below the high end"));
    return {values[0], values[1]};
}

} // namespace pellucid::cli
