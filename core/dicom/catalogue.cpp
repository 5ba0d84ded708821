// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/catalogue.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "core/decoding/client/reasons.h"
#include "core/dicom/reasons.h"
#include "core/files/reasons.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::dicom {

namespace {

namespace because = task::because;

// A stack precedes a large single image, a series precedes a file of labels for it, and scanned
// slices precede interpolated ones.
const Selection &largest(const std::vector<Selection> &candidates) {
    const auto rank = [](const Selection &s) {
        const VolumeEntry &v = *s.volume;
        return std::tuple(v.placed, v.geometry.lattice.size().k > 1, v.volumeFile.empty(),
                          !v.fillsHoles, v.voxels());
    };
    return *std::max_element(
        candidates.begin(), candidates.end(),
        [&](const Selection &a, const Selection &b) { return rank(a) < rank(b); });
}

// With Holes::fill, a series that has a filled volume contributes only that one.
std::vector<Selection> choose(std::vector<Selection> all, Holes holes) {
    if (holes == Holes::fill) {
        std::set<const Series *> filled;
        for (const Selection &s : all)
            if (s.volume->fillsHoles)
                filled.insert(s.series);
        std::erase_if(all, [&](const Selection &s) {
            return filled.contains(s.series) && !s.volume->fillsHoles;
        });
    }
    return all;
}

// Empty if the file is not below the folder.
std::optional<std::filesystem::path> below(const std::filesystem::path &folder,
                                           const std::filesystem::path &file) {
    const std::filesystem::path inside = file.lexically_relative(folder);
    return inside.empty() || *inside.begin() == ".." ? std::nullopt : std::optional(inside);
}

} // namespace

std::string labelText(const std::vector<task::Reason> &label) {
    std::string text;
    for (const task::Reason &part : label)
        text += (text.empty() ? "" : ", ") + part.english();
    return text;
}

std::filesystem::path Catalogue::named(const std::filesystem::path &file) const {
    for (const Unpacked &u : unpacked)
        if (const auto inside = below(u.folder->path(), file))
            return u.archive / *inside;
    return file;
}

std::optional<std::filesystem::path> Catalogue::archiveOf(const std::filesystem::path &file) const {
    for (const Unpacked &u : unpacked)
        if (below(u.folder->path(), file))
            return u.archive;
    return std::nullopt;
}

std::vector<Selection> selections(const Catalogue &catalogue) {
    std::vector<Selection> all;
    for (const Patient &patient : catalogue.patients)
        for (const Study &study : patient.studies)
            for (const Series &series : study.series)
                for (const VolumeEntry &volume : series.volumes)
                    all.push_back({&patient, &study, &series, &volume});
    return all;
}

std::vector<Skipped> problemsOf(const Catalogue &catalogue) {
    std::vector<Skipped> problems = catalogue.skipped;
    if (catalogue.empty())
        return problems;
    const auto isOther = [](const Skipped &file) { return file.reason.is(because::isNotDicom); };
    const auto first = std::find_if(problems.begin(), problems.end(), isOther);
    if (first == problems.end())
        return problems;
    const std::filesystem::path folder = first->path.parent_path();
    const std::size_t others = std::erase_if(problems, isOther);
    problems.push_back({folder, because::otherFiles(others)});
    return problems;
}

Selection defaultSelection(const Catalogue &catalogue, Holes holes) {
    const auto all = choose(selections(catalogue), holes);
    if (all.empty())
        throw task::Error(task::ErrorCode::unusable, because::holdsNoUsableImages);
    return largest(all);
}

Selection selectSeries(const Catalogue &catalogue, const std::string &numberOrUid, Holes holes) {
    std::vector<Selection> matching, byUid;
    std::string known;
    for (const Selection &s : choose(selections(catalogue), holes)) {
        if (s.series->uid == numberOrUid)
            byUid.push_back(s);
        if (std::to_string(s.series->number) == numberOrUid)
            matching.push_back(s);
        const std::string number = std::to_string(s.series->number);
        if ((", " + known + ",").find(", " + number + ",") == std::string::npos)
            known += (known.empty() ? "" : ", ") + number;
    }
    // A UID identifies the series uniquely, even if two patients share it.
    if (!byUid.empty())
        return largest(byUid);
    std::set<const Series *> series;
    std::string uids;
    for (const Selection &s : matching)
        if (series.insert(s.series).second)
            uids += (uids.empty() ? "" : ", ") + s.series->uid;
    if (series.size() > 1)
        throw task::Error(task::ErrorCode::unusable, because::severalSeriesAre(numberOrUid, uids));
    if (matching.empty())
        throw task::Error(task::ErrorCode::unusable, because::noSeries(numberOrUid, known));
    return largest(matching);
}

Selection selectVolume(const Selection &selection, int number) {
    const std::vector<VolumeEntry> &volumes = selection.series->volumes;
    if (number < 1 || number > int(volumes.size()))
        throw task::Error(
            task::ErrorCode::unusable,
            volumes.size() == 1
                ? because::noVolumeBesideOne(number, selection.series->number)
                : because::noVolumeInSeries(number, selection.series->number, volumes.size()));
    Selection chosen = selection;
    chosen.volume = &volumes[std::size_t(number - 1)];
    return chosen;
}

} // namespace pellucid::dicom
