// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch_sources.h"

#include <algorithm>
#include <set>
#include <utility>

#include "app/cli/servers.h"
#include "core/archive/retrieval.h"
#include "core/dicom/scan.h"
#include "core/files/session_folder.h"
#include "core/task/error.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
namespace tag = exchange::tag;

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

// Keys are folders of one folder.
std::string freeKey(const std::string &wanted, std::set<std::string> &taken) {
    std::string key = wanted;
    for (int n = 2; !taken.insert(key).second; ++n)
        key = wanted + "-" + std::to_string(n);
    return key;
}

class FileSource : public BatchSource {
public:
    FileSource(std::vector<fs::path> paths, const Context &context)
        : m_paths(std::move(paths)), m_context(context) {}

    std::vector<BatchItem> list() override {
        m_catalogue = dicom::scan(m_paths, task::Progress(m_context.stop));
        std::vector<BatchItem> items;
        for (const dicom::Patient &patient : m_catalogue.patients)
            for (const dicom::Study &study : patient.studies)
                if (exchange::isUid(study.uid))
                    items.push_back({study.uid, &patient, study});
                else
                    addEachSeries(patient, study, items);
        std::stable_sort(items.begin(), items.end(),
                         [](const BatchItem &a, const BatchItem &b) { return a.key < b.key; });
        std::set<std::string> taken;
        for (BatchItem &item : items)
            item.key = freeKey(item.key, taken);
        return items;
    }
    std::string digestOf(const BatchItem &item) override {
        return batch::digestOf(m_catalogue, *item.study);
    }
    void open(const BatchItem &item,
              const std::function<void(const StudyToRender &)> &use) override {
        use({m_catalogue, *item.patient, *item.study, digestOf(item)});
    }
    std::vector<dicom::Skipped> skipped() const override { return m_catalogue.skipped; }

private:
    // Files of volumes have no study: each is one.
    static void addEachSeries(const dicom::Patient &patient, const dicom::Study &study,
                              std::vector<BatchItem> &items) {
        for (const dicom::Series &series : study.series) {
            dicom::Study alone;
            alone.date = study.date;
            alone.description = study.description;
            alone.series = {series};
            const std::string name =
                series.files.empty() ? series.uid : series.files.front().path.filename().string();
            items.push_back({safeName(name), &patient, std::move(alone)});
        }
    }

    std::vector<fs::path> m_paths;
    Context m_context;
    dicom::Catalogue m_catalogue;
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
        std::vector<BatchItem> items;
        for (const archive::FoundEntry &entry : found(m_terms))
            items.push_back({entry.text(tag::studyUid), nullptr, std::nullopt});
        std::sort(items.begin(), items.end(),
                  [](const BatchItem &a, const BatchItem &b) { return a.key < b.key; });
        return items;
    }
    std::string digestOf(const BatchItem &item) override {
        return digestOf(archive::listInstances(m_server, wantedOf(item), progress()));
    }
    void open(const BatchItem &item,
              const std::function<void(const StudyToRender &)> &use) override {
        const files::SessionFolder folder;
        const archive::ObjectFolder objects(folder.path(),
                                            archive::ObjectFolder::Keeps::inMemoryOfTheSystem);
        archive::RetrievalObserver observer;
        std::string inputs;
        observer.listed = [&](const std::vector<archive::Instance> &instances) {
            inputs = digestOf(instances);
        };
        requireComplete(archive::retrieve(m_server, wantedOf(item), objects, observer, progress()),
                        m_server.name);
        const dicom::Catalogue catalogue = dicom::scan({folder.path()}, progress());
        for (const dicom::Patient &patient : catalogue.patients)
            for (const dicom::Study &study : patient.studies)
                if (study.uid == item.key) {
                    use({catalogue, patient, study, inputs});
                    return;
                }
        throw task::Error(task::ErrorCode::unusable, because::holdsNoUsableImages);
    }

private:
    task::Progress progress() const { return task::Progress(m_context.stop); }

    static std::string digestOf(const std::vector<archive::Instance> &instances) {
        std::vector<std::string> uids;
        for (const archive::Instance &instance : instances)
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

    // The series of a modality that the recipe asks for: a study may have gigabytes of others.
    archive::Wanted wantedOf(const BatchItem &item) const {
        archive::Wanted wanted{item.key, {}};
        if (m_choice.modalities.empty())
            return wanted;
        archive::SearchTerms terms;
        terms.studyUid = item.key;
        terms.level = exchange::Level::series;
        for (const archive::FoundEntry &entry : found(terms)) {
            const std::string modality = entry.text(tag::modality);
            if (modality.empty() ||
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
                                          const Context &context) {
    return std::make_unique<FileSource>(paths, context);
}

std::unique_ptr<BatchSource> batchOfServer(const archive::Server &server,
                                           const archive::SearchTerms &terms,
                                           const batch::SeriesChoice &choice,
                                           const Context &context) {
    return std::make_unique<ServerSource>(server, terms, choice, context);
}

} // namespace pellucid::cli
