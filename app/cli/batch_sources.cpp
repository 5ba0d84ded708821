// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch_sources.h"

#include <algorithm>
#include <set>
#include <span>
#include <utility>

#include "app/cli/reasons.h"
#include "app/cli/servers.h"
#include "core/archive/retrieval.h"
#include "core/batch/reasons.h"
#include "core/decoding/client/decoder.h"
#include "core/dicom/file_list.h"
#include "core/dicom/reasons.h"
#include "core/dicom/scan.h"
#include "core/dicom/study_index.h"
#include "core/files/is_below.h"
#include "core/files/reasons.h"
#include "core/files/session_folder.h"
#include "core/system/content_digest.h"
#include "core/task/error.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
namespace tag = network::tag;

// A name for a folder: letters, digits and signs that are safe everywhere.
std::string safeName(const std::string &text) {
    std::string name;
    for (const char c : text)
        name += (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                        c == '-' || c == '_' || (c == '.' && !name.empty())
                    ? c
                    : '_';
    return name.empty() ? "study" : name;
}

// The key of a file without a study. Files in other folders may have the same name.
std::string keyOf(const fs::path &file) {
    constexpr std::size_t digits = 8, maxBytes = 200; // a folder's name may have 255
    const std::string path = dicom::resolved(file).string();
    return safeName(file.filename().string()).substr(0, maxBytes) + "-" +
           system::contentDigest(std::as_bytes(std::span(path))).substr(0, digits);
}

// Keys are folders of one folder.
std::string freeKey(const std::string &wanted, std::set<std::string> &taken) {
    std::string key = wanted;
    for (int n = 2; !taken.insert(key).second; ++n)
        key = wanted + "-" + std::to_string(n);
    return key;
}

// The study of a catalogue with this UID, or else the first one.
const dicom::Study &studyOf(const dicom::Catalogue &catalogue, const std::string &uid,
                            const dicom::Patient *&patient) {
    for (const dicom::Patient &each : catalogue.patients)
        for (const dicom::Study &study : each.studies)
            if (study.uid == uid) {
                patient = &each;
                return study;
            }
    if (catalogue.empty())
        throw task::Error(task::ErrorCode::unusable, catalogue.skipped.empty()
                                                         ? because::holdsNoUsableImages
                                                         : catalogue.skipped.front().reason);
    patient = &catalogue.patients.front();
    return patient->studies.front();
}

class FileSource : public BatchSource {
public:
    FileSource(std::vector<fs::path> paths, fs::path except, const Context &context)
        : m_paths(std::move(paths)), m_except(std::move(except)), m_context(context) {}

    std::vector<BatchItem> list() override {
        for (const fs::path &path : m_paths)
            if (std::error_code unknown; !fs::exists(path, unknown))
                throw task::Error(task::ErrorCode::unusable, because::doesNotExist, path);
        m_index = dicom::indexStudies(m_paths, task::Progress(m_context.stop));
        m_names.unpacked = m_index.unpacked;
        leaveOutResults();
        std::vector<BatchItem> items;
        for (std::size_t n = 0; n < m_index.studies.size(); ++n) {
            const dicom::IndexedStudy &study = m_index.studies[n];
            items.push_back(
                {network::isUid(study.uid) ? study.uid : keyOf(m_names.named(study.files.front())),
                 n});
        }
        std::stable_sort(items.begin(), items.end(),
                         [](const BatchItem &a, const BatchItem &b) { return a.key < b.key; });
        std::set<std::string> taken;
        for (BatchItem &item : items)
            item.key = freeKey(item.key, taken);
        return items;
    }
    std::string digestOf(const BatchItem &item) override {
        std::vector<batch::InputFile> files;
        for (const fs::path &path : m_index.studies[item.index].files)
            files.push_back({path, m_names.archiveOf(path).value_or(path)});
        return batch::digestOf(files);
    }
    void open(const BatchItem &item,
              const std::function<void(const StudyToRender &)> &use) override {
        const dicom::IndexedStudy &indexed = m_index.studies[item.index];
        dicom::Catalogue catalogue =
            dicom::scan(indexed.files, task::Progress(m_context.stop), {.isSameSource = true});
        catalogue.unpacked = m_index.unpacked;
        const dicom::Patient *patient = nullptr;
        const dicom::Study &study = studyOf(catalogue, indexed.uid, patient);
        use({catalogue, *patient, study, digestOf(item)});
    }
    std::vector<dicom::Skipped> skipped() const override {
        std::vector<dicom::Skipped> skipped = m_index.skipped;
        for (dicom::Skipped &one : skipped)
            one.path = m_names.named(one.path);
        return skipped;
    }

private:
    // They would be inputs of the next run.
    void leaveOutResults() {
        const bool hadStudies = !m_index.studies.empty();
        const fs::path folder = dicom::resolved(m_except);
        const auto isResult = [&](const fs::path &path) {
            return files::isBelow(dicom::resolved(path), folder);
        };
        for (dicom::IndexedStudy &study : m_index.studies)
            std::erase_if(study.files, isResult);
        std::erase_if(m_index.studies,
                      [](const dicom::IndexedStudy &study) { return study.files.empty(); });
        std::erase_if(m_index.skipped,
                      [&](const dicom::Skipped &skipped) { return isResult(skipped.path); });
        if (hadStudies && m_index.studies.empty())
            throw task::Error(task::ErrorCode::unusable, because::onlyResultsAreThere,
                              m_paths.front());
    }

    std::vector<fs::path> m_paths;
    fs::path m_except;
    Context m_context;
    dicom::StudyIndex m_index;
    dicom::Catalogue m_names; ///< of files in archives
};

class ServerSource : public BatchSource {
public:
    ServerSource(archive::Server server, archive::SearchTerms terms, batch::SeriesChoice choice,
                 const Context &context)
        : m_server(std::move(server)), m_terms(std::move(terms)), m_choice(std::move(choice)),
          m_context(context) {
        m_server.limit = 0; // all
    }

    std::vector<BatchItem> list() override {
        decoding::Decoder::shared().beginOpening();
        archive::SearchTerms terms = m_terms;
        terms.level = network::Level::study;
        terms.seriesUid.clear();
        std::vector<BatchItem> items;
        for (const archive::FoundEntry &entry : found(terms))
            // Two series of one study are two results.
            items.push_back(
                {m_terms.seriesUid.empty() ? entry.text(tag::studyUid) : m_terms.seriesUid, 0,
                 entry.text(tag::studyUid)});
        std::sort(items.begin(), items.end(),
                  [](const BatchItem &a, const BatchItem &b) { return a.key < b.key; });
        return items;
    }
    std::string digestOf(const BatchItem &item) override {
        return digestOf(archive::listInstances(m_server, wantedOf(item), progress()).instances);
    }
    void open(const BatchItem &item,
              const std::function<void(const StudyToRender &)> &use) override {
        const files::SessionFolder folder;
        const archive::ObjectFolder objects(folder.path(),
                                            archive::ObjectFolder::Durability::cached);
        archive::RetrievalObserver observer;
        std::string inputs;
        observer.listed = [&](const archive::Listing &listing) {
            inputs = digestOf(listing.instances);
        };
        const archive::RetrievalReport report =
            archive::retrieve(m_server, wantedOf(item), objects, observer, progress());
        requireComplete(report, m_server.name);
        // A batch runs unattended: nobody would notice images of the wrong patient.
        if (report.ofAnotherPatient > 0)
            throw task::Error(task::ErrorCode::unusable,
                              task::because::objectsAreOfAnotherPatient(report.ofAnotherPatient),
                              m_server.name);
        const dicom::Catalogue catalogue =
            dicom::scan({folder.path()}, progress(), {.isSameSource = true});
        const dicom::Patient *patient = nullptr;
        const dicom::Study &study = studyOf(catalogue, item.studyUid, patient);
        use({catalogue, *patient, study, inputs});
    }

private:
    task::Progress progress() const { return task::Progress(m_context.stop); }

    // Pictures are left out: what a batch sends back does not change the study.
    static std::string digestOf(const std::vector<archive::Instance> &instances) {
        static const std::string secondaryCapture = "1.2.840.10008.5.1.4.1.1.7";
        std::vector<std::string> uids;
        for (const archive::Instance &instance : instances)
            if (instance.sopClassUid != secondaryCapture &&
                !instance.sopClassUid.starts_with(secondaryCapture + "."))
                uids.push_back(instance.sopInstanceUid);
        return batch::digestOf(std::move(uids));
    }

    std::vector<archive::FoundEntry> found(const archive::SearchTerms &terms) const {
        archive::SearchResult result = archive::search({m_server}, terms, {}, progress());
        for (const archive::ServerOutcome &outcome : result.outcomes)
            if (outcome.failure)
                throw task::Error(outcome.code, *outcome.failure, outcome.server);
        return std::move(result.entries);
    }

    // The series that is asked for, or those of a modality that the recipe asks for: a study may
    // have gigabytes of others.
    archive::Wanted wantedOf(const BatchItem &item) const {
        archive::Wanted wanted{item.studyUid, {}};
        if (m_choice.modalities.empty() && m_terms.seriesUid.empty() && m_terms.modality.empty())
            return wanted;
        archive::SearchTerms terms;
        terms.studyUid = item.studyUid;
        terms.seriesUid = m_terms.seriesUid;
        terms.level = network::Level::series;
        const std::vector<archive::FoundEntry> series = found(terms);
        if (series.empty())
            throw task::Error(task::ErrorCode::unusable, because::holdsNoUsableImages);
        // Not every server heeds the modality in a search for studies.
        const auto hasModality = [&](const archive::FoundEntry &entry) {
            const std::string modality = entry.text(tag::modality);
            return modality.empty() || modality == m_terms.modality;
        };
        if (!m_terms.modality.empty() && std::none_of(series.begin(), series.end(), hasModality))
            throw task::Error(task::ErrorCode::unusable, because::noSeriesIsChosen);
        for (const archive::FoundEntry &entry : series) {
            const std::string modality = entry.text(tag::modality);
            if (modality.empty() || m_choice.modalities.empty() ||
                std::find(m_choice.modalities.begin(), m_choice.modalities.end(), modality) !=
                    m_choice.modalities.end())
                wanted.seriesUids.push_back(entry.text(tag::seriesUid));
        }
        if (wanted.seriesUids.empty())
            throw task::Error(task::ErrorCode::unusable, because::noSeriesIsChosen);
        return wanted;
    }

    archive::Server m_server;
    archive::SearchTerms m_terms;
    batch::SeriesChoice m_choice;
    Context m_context;
};

} // namespace

std::unique_ptr<BatchSource> batchOfFiles(const std::vector<fs::path> &paths,
                                          const fs::path &except, const Context &context) {
    return std::make_unique<FileSource>(paths, except, context);
}

std::unique_ptr<BatchSource> batchOfServer(const archive::Server &server,
                                           const archive::SearchTerms &terms,
                                           const batch::SeriesChoice &choice,
                                           const Context &context) {
    return std::make_unique<ServerSource>(server, terms, choice, context);
}

} // namespace pellucid::cli
