// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/run_transfer.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "core/archive/reasons.h"
#include "core/files/user_folders.h"
#include "core/task/error.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds recordedEvery(250);

// Whether earlier runs have brought anything. The count of a run that was killed may be too old.
bool hasBroughtFiles(const Transfer &transfer) {
    if (transfer.received > 0)
        return true;
    if (transfer.total == 0)
        return false; // nothing was even listed
    const std::filesystem::path study = transfer.folder / transfer.wanted.studyUid;
    const std::vector<std::string> &series = transfer.wanted.seriesUids;
    const auto isThere = [](const std::filesystem::path &folder) {
        std::error_code unknown;
        return std::filesystem::exists(folder, unknown);
    };
    return series.empty() ? isThere(study)
                          : std::any_of(series.begin(), series.end(), [&](const std::string &uid) {
                                return isThere(study / uid);
                            });
}

} // namespace

std::filesystem::path libraryObjectFolder() {
    const auto data = files::userDataFolder();
    if (!data)
        throw task::Error(task::ErrorCode::output, because::noFolderForData);
    return *data / "library" / "files";
}

RetrievalReport runTransfer(TransferLog &log, std::int64_t id, const Server &server,
                            const RetrievalObserver &observer, const task::Progress &progress,
                            const MoveDestination &destination, const Patient &listed,
                            Existing existing) {
    std::optional<Transfer> transfer = log.transfer(id);
    if (!transfer || !log.claim(id))
        throw task::Error(task::ErrorCode::usage, because::transferIsRunning);
    const bool isForLibrary = transfer->folder == libraryObjectFolder();
    const auto begin = Clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(Clock::now() - begin).count();
    };
    // Both end it: the caller's cancel, and that of another program in the log.
    std::stop_source stop;
    const task::Progress stoppable(stop.get_token());
    RetrievalState reached;
    auto recorded = Clock::now() - recordedEvery;
    // Callbacks come from several threads, one at a time; the log's connection allows that.
    RetrievalObserver recording;
    recording.listed = observer.listed;
    recording.stored = [&](const StoredObject &object) {
        if (isForLibrary)
            log.addArrival(object, server.name);
        if (observer.stored)
            observer.stored(object);
    };
    recording.matches = observer.matches;
    recording.changed = [&](const RetrievalState &state) {
        reached = state;
        if (progress.stopRequested())
            stop.request_stop();
        if (Clock::now() - recorded >= recordedEvery) {
            recorded = Clock::now();
            log.update(id, state, seconds());
            if (!log.hasClaim(id))
                stop.request_stop();
        }
        if (state.wanted > 0)
            progress.report(double(state.present + state.received) / double(state.wanted));
        if (observer.changed)
            observer.changed(state);
    };
    // A server that hangs brings no callbacks.
    const std::stop_callback forwarded(progress.stopToken(), [&] { stop.request_stop(); });
    try {
        transfer->wanted.patient = listed;
        transfer->wanted.existing = existing;
        RetrievalReport report =
            retrieve(server, transfer->wanted,
                     ObjectFolder(transfer->folder, ObjectFolder::Durability::cached), recording,
                     stoppable, destination);
        log.finish(id, report.isComplete() ? TransferState::complete : TransferState::incomplete,
                   report.state, seconds(),
                   report.isComplete() ? "" : report.missing.front().reason.encoded());
        return report;
    } catch (const task::Cancelled &) {
        // A program that ends continues it at its next start, unless the user has cancelled it.
        if (log.hasClaim(id))
            log.finish(id, TransferState::waiting, reached, seconds(), {});
        throw;
    } catch (const task::Error &error) {
        // Another attempt would end in the same way. What has arrived stays listed.
        if (error.reason().is(because::serverHasNoSuchStudy) && !hasBroughtFiles(*transfer))
            log.remove(id);
        else
            // What was complete stays so if the server cannot be asked again.
            log.finish(id,
                       transfer->state == TransferState::complete ? TransferState::complete
                                                                  : TransferState::incomplete,
                       reached, seconds(),
                       transfer->state == TransferState::complete ? "" : error.reason().encoded());
        throw;
    }
}

} // namespace pellucid::archive
