// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch_run.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "app/cli/batch_report.h"
#include "app/cli/batch_sources.h"
#include "app/cli/commands.h"
#include "app/cli/input.h"
#include "app/cli/reason_lines.h"
#include "app/cli/reasons.h"
#include "app/cli/servers.h"
#include "app/cli/terminal.h"
#include "core/archive/login.h"
#include "core/archive/reasons.h"
#include "core/archive/sending.h"
#include "core/batch/reasons.h"
#include "core/batch/study_results.h"
#include "core/decoding/client/reasons.h"
#include "core/dicom/reasons.h"
#include "core/files/atomic_file.h"
#include "core/files/reasons.h"
#include "core/files/session_folder.h"
#include "core/files/user_folders.h"
#include "core/files/video_file.h"
#include "core/fourier/transforms/wisdom.h"
#include "core/network/client/link.h"
#include "core/platform/memory.h"
#include "core/system/content_digest.h"
#include "core/system/memory.h"
#include "core/task/error.h"
#include "core/task/naming.h"
#include "core/task/reasons.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using batch::DoneRecord;
using task::Error;
using task::ErrorCode;

// Checks before any work.
void requirePossible(const batch::Recipe &recipe, bool isSent) {
    bool hasCapture = false;
    for (const batch::Output &output : recipe.outputs) {
        if (output.format == batch::Format::video && !files::VideoFile::isAvailable())
            throw Error(ErrorCode::usage, because::videosNeedFfmpeg);
        hasCapture = hasCapture || output.format == batch::Format::capture ||
                     output.format == batch::Format::captureLoop;
    }
    if (isSent && !hasCapture)
        throw Error(ErrorCode::usage,
                    because::inWords("--send: the recipe has no output that a server stores: "
                                     "format dicom or dicom-loop"));
}

// Whether a file is intact, but no image that can be projected. An archive within a folder may hold
// studies, and counts with the damaged files.
bool isOfAnotherKind(const task::Reason &reason) {
    return reason.is(because::isNotDicom) || reason.is(because::isEmpty) ||
           reason.is(because::isAnIndex) || reason.is(because::hasNoPixels) ||
           reason.is(because::hasNoPixelsBut) || reason.is(because::hasUnsupportedBits) ||
           reason.is(because::hasFloatingPointPixels) || reason.is(because::isASegmentation) ||
           reason.is(because::isAColorImage);
}

class BatchRun {
public:
    BatchRun(const BatchOptions &options, const Context &caller)
        : m_options(options), m_context{m_stop.get_token()},
          m_forward(caller.stop, [this] { m_stop.request_stop(); }), m_caller(caller),
          m_report(options.json) {}

    void run() {
        Stopwatch watch;
        m_recipe = batch::readRecipe(m_options.recipe);
        requirePossible(m_recipe, !m_options.sendTo.empty());
        for (const std::string &server : {m_options.from, m_options.sendTo})
            if (!server.empty())
                archive::ServerList::ofUser().get(server);
        requireProtection("batch", m_options.allowsUnprotected);
        choosePlace();
        // The same bits in every run: plans that are measured depend on the moment.
        fourier::estimatePlans();
        std::optional<tbb::global_control> threads;
        if (m_options.threads > 0)
            threads.emplace(tbb::global_control::max_allowed_parallelism,
                            std::size_t(m_options.threads));
        // A graphics card rounds differently, and has one picture at a time.
        m_card = chooseCard("cpu", 1);
        if (!m_options.sendTo.empty())
            reachReceiver();
        openSource();
        m_items = m_source->list();
        const bool isEmpty = m_items.empty(); // a part of a batch may have nothing to do
        std::erase_if(m_items, [&](const BatchItem &item) { return !isOfShard(item.key); });
        beginReport();
        if (isEmpty)
            reportNoStudies();
        renderAll();
        m_report.print(m_recipe.digest, watch.lapMs() / 1000.0);
        if (m_fatal)
            std::rethrow_exception(m_fatal);
        if (m_caller.stop.stop_requested())
            throw task::Cancelled();
        m_report.requireAllDone();
    }

private:
    // With --send alone, only the records of what was sent are kept.
    void choosePlace() {
        m_out = m_options.out;
        m_isKept = !m_out.empty();
        if (!m_isKept) {
            const auto data = files::userDataFolder();
            if (!data)
                throw Error(ErrorCode::output, because::noFolderForData);
            const std::string what = m_recipe.digest + " " + m_options.sendTo;
            m_out = *data / "batch" / system::contentDigest(std::as_bytes(std::span(what)));
        }
        std::error_code failed;
        fs::create_directories(m_out, failed);
        if (failed)
            throw Error(ErrorCode::output, because::cannotBeMade(task::systemReason(failed)),
                        m_out);
        files::requireWritable(m_out);
        files::removeAbandonedSessionFolders(m_out);
    }

    // Before any study is rendered in vain.
    void reachReceiver() {
        m_receiver = serverNamed(m_options.sendTo, m_context);
        const task::Progress progress(m_context.stop);
        task::naming(m_receiver->name, [&] {
            archive::withLogin(*m_receiver, progress, [&](const network::Peer &peer) {
                network::Link link(network::Connection{peer, network::Purpose::echo}, progress);
                link.echo(progress);
            });
        });
    }

    void openSource() {
        if (m_options.from.empty()) {
            m_source =
                batchOfFiles({m_options.paths.begin(), m_options.paths.end()}, m_out, m_context);
            return;
        }
        m_source = batchOfServer(serverNamed(m_options.from, m_context), m_options.terms,
                                 m_recipe.series, m_context);
    }

    void renderAll() {
        const int jobs = std::max(1, std::min(m_options.jobs, int(m_items.size())));
        const std::size_t bytes =
            m_options.memory > 0 ? std::size_t(m_options.memory) : system::availableMemoryBytes();
        m_memory = std::make_unique<batch::MemoryShares>(bytes, jobs);
        {
            std::vector<std::jthread> workers;
            for (int n = 0; n < jobs; ++n)
                workers.emplace_back([this] { work(); });
        }
    }

    void work() {
        for (std::size_t n = 0; !m_stop.stop_requested() && (n = m_next++) < m_items.size();) {
            const BatchItem &item = m_items[n];
            try {
                naming(item.key, [&] { renderOne(item); });
                // The heaps of the threads would grow otherwise.
                platform::returnFreedMemory();
            } catch (const task::Cancelled &) {
                return;
            } catch (const Error &error) {
                // Other studies could not be written either.
                if (error.code() == ErrorCode::output) {
                    stop();
                    return;
                }
                if (error.reason().is(because::noSeriesIsChosen))
                    m_report.passedOver(item.key);
                else
                    m_report.failed(item.key, error.what());
            } catch (const std::exception &error) {
                m_report.failed(item.key, error.what());
            }
        }
    }

    void renderOne(const BatchItem &item) {
        Stopwatch watch;
        DoneRecord wanted;
        wanted.program = "pellucid-cli " PELLUCID_VERSION;
        wanted.recipe = m_recipe.digest;
        wanted.sentTo = m_options.sendTo;
        if (m_options.resumes) {
            wanted.inputs = m_source->digestOf(item);
            if (batch::isDone(m_out / item.key, wanted)) {
                m_report.wasDoneBefore();
                return;
            }
        }
        batch::requireReplaceable(m_out / item.key); // before anything is retrieved
        m_source->open(item, [&](const StudyToRender &study) {
            batch::StudyResults results(m_out, item.key);
            DoneRecord record =
                renderStudy(m_recipe, study, results.folder(), *m_memory, m_card, m_context);
            record.program = wanted.program;
            record.sentTo = wanted.sentTo;
            if (m_receiver)
                send(results.folder());
            if (!m_isKept)
                for (const fs::directory_entry &made : fs::directory_iterator(results.folder()))
                    fs::remove(made.path());
            results.publish(record);
            m_report.finished(item.key, record, watch.lapMs() / 1000.0);
        });
    }

    void send(const fs::path &folder) const {
        std::vector<fs::path> captures;
        for (const fs::directory_entry &made : fs::directory_iterator(folder))
            if (made.path().extension() == ".dcm")
                captures.push_back(made.path());
        std::sort(captures.begin(), captures.end());
        const archive::SendingReport report =
            archive::send(*m_receiver, captures, {}, task::Progress(m_context.stop));
        if (!report.notSent.empty())
            throw Error(ErrorCode::incomplete, report.notSent.front().reason, m_receiver->name);
    }

    // Damaged files count as failures, because a study may consist of them. Which one is not known:
    // each part of a batch counts its share.
    void beginReport() {
        std::vector<Named> named;
        std::vector<dicom::Skipped> damaged, unused;
        for (const dicom::Skipped &skipped : m_source->skipped()) {
            if (!skipped.reason.is(because::isNotDicom)) // texts and programs beside images
                named.push_back({skipped.path.string(), skipped.reason});
            if (isOfAnotherKind(skipped.reason))
                unused.push_back(skipped);
            else if (isOfShard(skipped.path.string()))
                damaged.push_back(skipped);
        }
        for (const std::string &line : linesByReason(named, "not used"))
            warn(line);
        m_report.begin(m_items.size(), std::move(damaged), std::move(unused));
    }

    // In a handler of the exception.
    void stop() {
        const std::lock_guard lock(m_mutex);
        if (!m_fatal)
            m_fatal = std::current_exception();
        m_stop.request_stop();
    }

    bool isOfShard(const std::string &key) const {
        return batch::shardOf(key, m_options.shard.count) == m_options.shard.index;
    }

    // A nightly query may match nothing, but a study that is named must be there.
    void reportNoStudies() const {
        if (m_options.from.empty())
            throw Error(ErrorCode::unusable, because::holdsNoUsableImages, m_options.paths.front());
        if (!m_options.terms.studyUid.empty() || !m_options.terms.accession.empty())
            throw Error(ErrorCode::unusable, because::noStudyMatches, m_options.from);
        warn(m_options.from + ": " + task::Reason(because::noStudyMatches).english());
    }

    const BatchOptions &m_options;
    std::stop_source m_stop;
    Context m_context;
    std::stop_callback<std::function<void()>> m_forward;
    const Context &m_caller;
    batch::Recipe m_recipe;
    fs::path m_out;
    bool m_isKept = true;
    CardChoice m_card;
    std::optional<archive::Server> m_receiver;
    std::unique_ptr<BatchSource> m_source;
    std::vector<BatchItem> m_items;
    std::unique_ptr<batch::MemoryShares> m_memory;
    std::atomic<std::size_t> m_next = 0;
    BatchReport m_report;
    std::mutex m_mutex; ///< of what follows
    std::exception_ptr m_fatal;
};

} // namespace

void runBatch(const BatchOptions &options, const Context &context) {
    BatchRun(options, context).run();
}

} // namespace pellucid::cli
