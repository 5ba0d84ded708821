// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/study_index.h"

#include <atomic>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <tuple>

#include <tbb/parallel_for.h>

#include "core/decoding/client/decoder.h"
#include "core/decoding/client/reasons.h"
#include "core/decoding/client/unpack_archive.h"
#include "core/dicom/file_list.h"
#include "core/dicom/reasons.h"
#include "core/task/error.h"
#include "core/volume/volume_file.h"

namespace pellucid::dicom {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using task::Error;
using task::ErrorCode;

// As images are sorted into series: some writers give each slice a study of its own.
using SeriesKey = std::tuple<std::string, std::string, std::string, std::string>;

struct Identity {
    SeriesKey series;
    std::string studyUid, patientId, patientName;
    bool isVolumeFile = false;
    std::optional<task::Reason> reason; ///< why it is not used
};

Identity identityOf(const fs::path &path, const task::Progress &progress) {
    Identity identity;
    try {
        identity.isVolumeFile = volume::isVolumeFile(path);
        if (identity.isVolumeFile)
            return identity;
        const decoding::InstanceHeader header = decoding::Decoder::shared().header(path, progress);
        identity.series = {header.patientId, header.patientName,
                           header.seriesUid.empty() ? header.studyUid : std::string(),
                           header.seriesUid};
        identity.studyUid = header.studyUid;
        identity.patientId = header.patientId;
        identity.patientName = header.patientName;
        identity.reason = decoding::whyUnusable(header);
    } catch (const Error &error) {
        if (error.code() == ErrorCode::internal) // nothing can be read without a decoder
            throw;
        identity.reason = error.code() != ErrorCode::outOfMemory && decoding::isArchive(path)
                              ? because::isAnArchive
                              : error.reason();
    } catch (const std::bad_alloc &) {
        identity.reason = because::needsTooMuchMemory;
    }
    return identity;
}

} // namespace

StudyIndex indexStudies(const std::vector<fs::path> &paths, const task::Progress &progress) {
    decoding::Decoder::shared().beginOpening();
    FileList list = listFiles(paths, progress);
    std::vector<Identity> identities(list.found.size());
    std::atomic<std::size_t> done = 0;
    std::mutex reporting;
    tbb::parallel_for(std::size_t(0), list.found.size(), [&](std::size_t n) {
        progress.check();
        identities[n] = identityOf(list.found[n], progress);
        const std::lock_guard lock(reporting);
        progress.report(double(++done) / double(list.found.size()));
    });
    StudyIndex index;
    index.skipped = std::move(list.skipped);
    index.unpacked = std::move(list.unpacked);
    Catalogue names; // of files in archives
    names.unpacked = index.unpacked;
    std::map<SeriesKey, std::size_t> studyOfSeries;
    std::map<std::tuple<std::string, std::string, std::string>, std::size_t> studies;
    for (std::size_t n = 0; n < identities.size(); ++n) {
        const Identity &identity = identities[n];
        const fs::path &path = list.found[n];
        if (identity.reason) {
            index.skipped.push_back({names.named(path), *identity.reason});
        } else if (identity.isVolumeFile) {
            index.studies.push_back({{}, {path}});
        } else {
            const auto [study, isNewStudy] =
                studies.try_emplace({identity.patientId, identity.patientName, identity.studyUid},
                                    index.studies.size());
            const auto [series, isNew] = studyOfSeries.try_emplace(identity.series, study->second);
            if (series->second == index.studies.size())
                index.studies.push_back({identity.studyUid, {}});
            index.studies[series->second].files.push_back(path);
            if (isNewStudy && series->second != study->second)
                studies.erase(study); // of a slice of a series that is elsewhere
        }
    }
    return index;
}

} // namespace pellucid::dicom
