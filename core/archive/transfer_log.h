// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/archive/instance_list.h"
#include "core/archive/object_folder.h"
#include "core/archive/retrieval.h"

struct sqlite3;

namespace pellucid::archive {

enum class TransferState { waiting, running, complete, incomplete, cancelled };

/// A retrieval that was asked for, as it is remembered.
struct Transfer {
    std::int64_t id = 0;
    std::string server;
    Wanted wanted;
    std::string title; ///< for the list of transfers: date and description, not a name
    std::filesystem::path folder;
    TransferState state = TransferState::waiting;
    std::size_t total = 0, received = 0;
    std::uint64_t bytes = 0; ///< over all its runs
    double seconds = 0.0;    ///< of the runs that brought any
    std::string reason;      ///< encoded task::Reason; empty if none
    bool isForLater = false; ///< nobody waits for it
    std::string created;     ///< UTC, as of ISO 8601
};

/// The queue of retrievals and the objects that this program's server received: SQLite, written
/// before anything is confirmed, so that a program that is killed goes on where it was. Several
/// programs may have it open; each thread needs its own object. All functions *throw* Error{output}
/// if it cannot be read or written.
class TransferLog {
public:
    explicit TransferLog(const std::filesystem::path &file);
    static std::filesystem::path fileOfUser();
    ~TransferLog();
    TransferLog(const TransferLog &) = delete;
    TransferLog &operator=(const TransferLog &) = delete;

    /// Adds a retrieval that waits, or restarts an equal one; one that somebody waits for stays
    /// urgent.
    std::int64_t add(const Transfer &transfer);
    /// Reports a transfer as waiting if its program has ended.
    std::vector<Transfer> transfers() const;
    std::optional<Transfer> transfer(std::int64_t id) const;
    /// Takes a waiting transfer, or one whose program has ended. False if another program has it.
    bool claim(std::int64_t id);
    /// Whether a claimed transfer has neither been cancelled nor been claimed again. What follows
    /// has no effect after that.
    bool hasClaim(std::int64_t id) const;
    void update(std::int64_t id, const RetrievalState &state, double seconds);
    void finish(std::int64_t id, TransferState state, const RetrievalState &reached, double seconds,
                const std::string &reason);
    /// Removes a claimed transfer, unless it has been claimed again.
    void remove(std::int64_t id);
    void cancel(std::int64_t id);
    /// It waits again, and now somebody waits for it.
    void retry(std::int64_t id);
    /// Removes what is neither waiting nor running.
    void clearFinished();

    /// Records an object that a sender may now delete.
    void addArrival(const StoredObject &object, const std::string &sender);
    /// The objects that the library does not list yet.
    std::vector<StoredObject> arrivals() const;
    void removeArrivals(const std::vector<StoredObject> &objects);

private:
    struct Close {
        void operator()(sqlite3 *database) const;
    };
    std::unique_ptr<sqlite3, Close> m_database;
    std::filesystem::path m_file;
    /// A claimed transfer.
    struct Run {
        std::int64_t number = 0;
        std::uint64_t bytesBefore = 0;
        double secondsBefore = 0.0;
    };
    std::map<std::int64_t, Run> m_runs;
};

} // namespace pellucid::archive
