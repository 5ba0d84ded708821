// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch_run.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <malloc.h>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include "app/cli/batch_sources.h"
#include "app/cli/commands.h"
#include "app/cli/input.h"
#include "app/cli/json_text.h"
#include "app/cli/reason_lines.h"
#include "app/cli/servers.h"
#include "app/cli/terminal.h"
#include "core/archive/login.h"
#include "core/archive/sending.h"
#include "core/batch/study_results.h"
#include "core/exchange/link.h"
#include "core/files/atomic_file.h"
#include "core/files/user_folders.h"
#include "core/files/video_file.h"
#include "core/fourier/transforms/wisdom.h"
#include "core/system/content_digest.h"
#include "core/system/memory.h"
#include "core/task/error.h"
#include "core/task/naming.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using batch::DoneRecord;
using nlohmann::json;
using task::Error;
using task::ErrorCode;

struct Shard {
    int index = 0, count = 1;
};

// "I/N": part I of N, from 0 as Slurm counts tasks.
Shard shardFrom(const std::string &text) {
    if (text.empty())
        return {};
    const auto n = parseNumbers("--shard", text, '/', 2);
    constexpr double most = 1e6;
    if (n[0] != std::floor(n[0]) || n[1] != std::floor(n[1]) || n[0] < 0 || n[1] < 1 ||
        n[0] >= n[1] || n[1] > most)
        throw Error(ErrorCode::usage,
                    because::inWords("--shard: '" + text +
                                     "' is not I/N with I from 0 to N - 1, such as 0/4"));
    return {int(n[0]), int(n[1])};
}

archive::SearchTerms termsFrom(const std::vector<std::string> &texts) {
    archive::SearchTerms terms;
    const std::pair<const char *, std::string *> names[]{
        {"name", &terms.patientName},  {"id", &terms.patientId},   {"date", &terms.date},
        {"modality", &terms.modality}, {"study", &terms.studyUid}, {"accession", &terms.accession},
        {"series", &terms.seriesUid}};
    for (const std::string &text : texts) {
        const auto equals = text.find('=');
        const auto *const known =
            std::find_if(std::begin(names), std::end(names),
                         [&](const auto &one) { return text.substr(0, equals) == one.first; });
        if (equals == std::string::npos || known == std::end(names))
            throw Error(ErrorCode::usage,
                        because::inWords("--find: '" + text +
                                         "' is not TERM=VALUE with one of the terms name, id, "
                                         "date, modality, study, series and accession"));
        *known->second = text.substr(equals + 1);
    }
    if (!terms.seriesUid.empty()) { // of one study, as servers need it
        if (texts.size() != 2 || terms.studyUid.empty())
            throw Error(ErrorCode::usage,
                        because::inWords("--find: 'series' goes with 'study', and with no other"));
        terms.level = exchange::Level::series;
    }
    archive::queryOf(terms, 0); // checks the values
    return terms;
}

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

// Whether a file is intact, but no image that can be projected.
bool isOfAnotherKind(const task::Reason &reason) {
    return reason.is(because::isNotDicom) || reason.is(because::isAnIndex) ||
           reason.is(because::isAnArchive) || reason.is(because::hasNoPixels) ||
           reason.is(because::hasNoPixelsBut) || reason.is(because::isASegmentation) ||
           reason.is(because::isAColorImage);
}

class BatchRun {
public:
    BatchRun(const BatchOptions &options, const Context &caller)
        : m_options(options), m_context{m_stop.get_token()},
          m_forward(caller.stop, [this] { m_stop.request_stop(); }), m_caller(caller) {}

    void run() {
        Stopwatch watch;
        const Shard shard = shardFrom(m_options.shard);
        m_recipe = batch::readRecipe(m_options.recipe);
        requirePossible(m_recipe, !m_options.sendTo.empty());
        const archive::SearchTerms terms = termsFrom(m_options.terms);
        for (const std::string &server : {m_options.from, m_options.sendTo})
            if (!server.empty())
                archive::ServerList::ofUser().get(server);
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
        openSource(terms);
        m_items = m_source->list();
        sortUnused(shard);
        std::erase_if(m_items, [&](const BatchItem &item) {
            return batch::shardOf(item.key, shard.count) != shard.index;
        });
        renderAll();
        print(watch.lapMs() / 1000.0);
        if (m_fatal)
            std::rethrow_exception(m_fatal);
        if (m_caller.stop.stop_requested())
            throw task::Cancelled();
        requireDone();
    }

private:
    struct Failure {
        std::string key, reason;
    };

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
        batch::removeUnfinished(m_out);
    }

    // Before any study is rendered in vain.
    void reachReceiver() {
        m_receiver = serverNamed(m_options.sendTo, m_context);
        const task::Progress progress(m_context.stop);
        task::naming(m_receiver->name, [&] {
            archive::withLogin(*m_receiver, progress, [&](const exchange::Peer &peer) {
                exchange::Link link(exchange::Connection{peer, exchange::Purpose::echo}, progress);
                link.echo(progress);
            });
        });
    }

    void openSource(const archive::SearchTerms &terms) {
        if (m_options.from.empty()) {
            m_source =
                batchOfFiles({m_options.paths.begin(), m_options.paths.end()}, m_out, m_context);
            return;
        }
        m_source = batchOfServer(serverNamed(m_options.from, m_context), terms, m_recipe.series,
                                 m_context);
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
                // Returns freed memory to the system. The heaps of the threads would grow
                // otherwise.
                ::malloc_trim(0);
            } catch (const task::Cancelled &) {
                return;
            } catch (const Error &error) {
                // Other studies could not be written either.
                if (error.code() == ErrorCode::output) {
                    stop();
                    return;
                }
                if (error.reason().is(because::noSeriesIsChosen))
                    passOver(item);
                else
                    fail(item, error.what());
            } catch (const std::exception &error) {
                fail(item, error.what());
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
                ++m_skipped;
                return;
            }
        }
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
            const std::lock_guard lock(m_mutex);
            ++m_done;
            tell(item, record, watch.lapMs() / 1000.0);
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

    // Requires the lock.
    void tell(const BatchItem &item, const DoneRecord &record, double seconds) const {
        double error = 0.0;
        std::vector<std::string> told; // what concerns all outputs, once
        for (const DoneRecord::MadeOutput &output : record.outputs) {
            error = std::max(error, output.predictedError);
            for (const std::string &warning : output.warnings)
                if (std::find(told.begin(), told.end(), warning) == told.end()) {
                    told.push_back(warning);
                    warn(item.key + ": " + output.name + ": " + warning);
                }
        }
        if (m_options.json)
            return;
        std::puts(
            printable(fmt::format("{} of {}: {}: outputs: {}; {:.2f} s, error at most {:.2g}",
                                  m_done + m_skipped + m_failures.size() + m_passedOver.size(),
                                  m_items.size(), item.key, record.outputs.size(), seconds, error))
                .c_str());
        std::fflush(stdout);
    }

    void passOver(const BatchItem &item) {
        const std::lock_guard lock(m_mutex);
        m_passedOver.push_back(item.key);
    }

    // Damaged files count as failures, because a study may consist of them. Which one is not known:
    // each part of a batch counts its share.
    void sortUnused(const Shard &shard) {
        std::vector<Named> named;
        for (const dicom::Skipped &skipped : m_source->skipped()) {
            if (!skipped.reason.is(because::isNotDicom)) // texts and programs beside images
                named.push_back({skipped.path.string(), skipped.reason});
            if (isOfAnotherKind(skipped.reason))
                m_unused.push_back(skipped);
            else if (batch::shardOf(skipped.path.string(), shard.count) == shard.index)
                m_damaged.push_back(skipped);
        }
        for (const std::string &line : linesByReason(named, "not used"))
            warn(line);
    }

    void fail(const BatchItem &item, const std::string &reason) {
        const std::lock_guard lock(m_mutex);
        m_failures.push_back({item.key, reason});
        if (!m_options.json) {
            std::puts(printable(item.key + ": failed").c_str());
            std::fflush(stdout);
        }
        warn(reason.find(item.key) == std::string::npos ? item.key + ": " + reason : reason);
    }

    // In a handler of the exception.
    void stop() {
        const std::lock_guard lock(m_mutex);
        if (!m_fatal)
            m_fatal = std::current_exception();
        m_stop.request_stop();
    }

    void print(double seconds) {
        std::sort(m_failures.begin(), m_failures.end(),
                  [](const Failure &a, const Failure &b) { return a.key < b.key; });
        std::sort(m_passedOver.begin(), m_passedOver.end());
        if (m_options.json) {
            json failures = json::array();
            for (const Failure &failure : m_failures)
                failures.push_back({{"study", failure.key}, {"reason", failure.reason}});
            std::puts(jsonText({{"studies", m_items.size()},
                                {"done", m_done},
                                {"skipped", m_skipped.load()},
                                {"failed", failures},
                                {"without_such_a_series", m_passedOver},
                                {"damaged_files", jsonOf(m_damaged)},
                                {"unused_files", jsonOf(m_unused)},
                                {"recipe", m_recipe.digest},
                                {"seconds", seconds}})
                          .c_str());
        } else {
            std::string text = fmt::format("{} of {} done", m_done, m_items.size());
            if (m_skipped > 0)
                text += fmt::format(", {} were done before", m_skipped.load());
            if (!m_failures.empty())
                text += fmt::format(", {} failed", m_failures.size());
            if (!m_damaged.empty())
                text += fmt::format(", damaged files: {}", m_damaged.size());
            if (!m_passedOver.empty())
                text += fmt::format(", {} have no series that the recipe asks for",
                                    m_passedOver.size());
            std::puts(fmt::format("{}; {:.1f} s", text, seconds).c_str());
        }
    }

    static json jsonOf(const std::vector<dicom::Skipped> &skipped) {
        json files = json::array();
        for (const dicom::Skipped &one : skipped)
            files.push_back({{"path", one.path.string()}, {"reason", one.reason.english()}});
        return files;
    }

    // A part of a batch may have nothing to do.
    void requireDone() const {
        if (m_items.empty() && m_options.shard.empty())
            throw Error(ErrorCode::unusable, because::holdsNoUsableImages,
                        m_options.from.empty() ? m_options.paths.front() : m_options.from);
        if (!m_failures.empty())
            throw Error(ErrorCode::incomplete,
                        because::inWords(fmt::format("{} of {} studies failed", m_failures.size(),
                                                     m_items.size())));
        if (!m_damaged.empty())
            throw Error(
                ErrorCode::incomplete,
                because::inWords(fmt::format("damaged files: {}; the first: {}", m_damaged.size(),
                                             m_damaged.front().reason.english())),
                m_damaged.front().path);
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
    std::atomic<std::size_t> m_next = 0, m_skipped = 0;
    std::mutex m_mutex; ///< of what follows
    std::size_t m_done = 0;
    std::vector<Failure> m_failures;
    std::vector<dicom::Skipped> m_damaged, m_unused;
    std::vector<std::string> m_passedOver; ///< studies without a series that the recipe asks for
    std::exception_ptr m_fatal;
};

} // namespace

void runBatch(const BatchOptions &options, const Context &context) {
    BatchRun(options, context).run();
}

} // namespace pellucid::cli
