// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/archive/retrieval.h"
#include "core/network/client/query.h"

namespace pellucid::archive {

/// Instances of one series that are asked for together; without any, the whole series, or without a
/// series, the whole study.
struct Batch {
    std::string studyUid, seriesUid;
    std::vector<std::string> uids;
};

/// The size of the first batches; fewer objects do not repay a connection.
inline constexpr std::size_t firstBatchSize = 8;

/// The state of a retrieval, shared by its connections: what is missing, and why, and the queue of
/// batches from coarse to fine. Thread-safe, but for `classes`, `needsMove` and `useMove`, which
/// call these while no connection runs.
class RetrievalWork {
public:
    /// `folder` and `observer` outlive this object. `existing`: whether objects here of which
    /// the server lists corrected data are missing. `connections`: that begin at once, at least
    /// one.
    RetrievalWork(const Listing &listing, const ObjectFolder &folder,
                  const RetrievalObserver &observer, int connections, Existing existing);

    std::size_t missing() const;
    std::set<std::string> classes() const;

    /// Waits until connection `index` (from 0) would save time: the open ones leave the line idle
    /// between objects, or one has given up. *Returns* false if nothing is left to do.
    bool awaitNeed(std::size_t index);
    /// Adds the times that a connection spent on an object, in seconds: waiting for its first byte,
    /// and receiving and storing it.
    void worked(double waited, double received);

    /// Batches in the queue that ask for a whole series or study.
    std::size_t wholeBatches() const;
    bool hasBatches() const;
    /// The next batch; nothing when all are taken.
    std::optional<Batch> next();

    /// After a lost connection: requests again what did not arrive.
    void putBack(Batch batch);

    /// Where an object may belong, also one that the server did not list; nothing if it is not
    /// awaited. *Throws* if the server keeps sending others.
    std::vector<ObjectFolder::Place> placesOf(const std::string &uid);
    void stored(const StoredObject &object);
    void refused(const std::string &uid, const task::Reason &reason);
    /// Counts objects that another listener has stored since.
    void findHere(const Batch &batch);
    /// The server ended a batch: what did not come has this reason unless it has its own.
    void ended(const Batch &batch, const network::RetrievalEnd &end);
    void failed(const Batch &batch, const task::Reason &reason);
    void moved(std::int64_t bytes);
    /// Puts back a batch that the server refuses in a form that it may take: one object at a time,
    /// and if that is refused as well, the whole series. False if it has been refused like this.
    bool askDifferently(const Batch &batch);
    /// Records why a connection gave up. Objects still queued at the end get this reason.
    void gaveUp(const task::Reason &reason);
    /// Why objects are missing, by UID.
    std::map<std::string, task::Reason> reasons() const;
    /// Restores the recorded reasons of objects that are still missing.
    void restoreReasons(const std::map<std::string, task::Reason> &before);
    /// The reason of all that is missing.
    void refuseMissing(const task::Reason &reason);
    /// The rest is not asked for.
    void refuseAll(const Batch &batch, const task::Reason &reason);
    void offersNoGet();
    bool needsMove() const { return m_offersNoGet; }
    void useMove() { m_offersNoGet = false; }
    /// Ends all connections: the disk is full, or the program is to stop.
    void stop(std::exception_ptr failure);
    void rethrow();
    std::size_t receivedCount();
    /// How many objects had come when a connection was first about to use this access token.
    std::size_t receivedBefore(const std::string &token);

    /// Asks once more for what the server refused. False if it refused nothing.
    bool fillQueueAgain(const std::vector<Instance> &instances);
    /// Asks for the series of which the server lists too little as a whole. False if there is none.
    bool fillQueueWithShortSeries();

    RetrievalReport report();
    const ObjectFolder &folder() const { return m_folder; }

private:
    void fillQueue(const std::vector<Instance> &instances);
    bool isEnough(std::size_t connections) const;
    bool noteCorrections(const StoredObject &object);
    void compare(const StoredObject &object);
    bool takeUnlisted(const StoredObject &object);

    const ObjectFolder &m_folder;
    const RetrievalObserver &m_observer;
    const std::size_t m_connections;
    const Patient m_patient; ///< as the server lists it
    const std::string m_studyDate;
    Patient m_named; ///< by the first object of another patient
    std::vector<Correction> m_corrections;
    std::size_t m_corrected = 0;
    mutable std::mutex m_mutex;
    std::condition_variable m_received;
    std::map<std::string, Instance> m_missing;
    std::vector<ShortSeries> m_short; ///< and what is still missing of it
    const Existing m_existing;
    std::set<std::string> m_known; ///< listed, or here without having been listed
    std::set<std::string> m_whole; ///< series of them that came as a whole; "": the study
    std::optional<task::Reason> m_whyUnlisted, m_whyGivenUp;
    std::map<std::string, task::Reason> m_reasons;
    std::deque<Batch> m_queue;
    RetrievalState m_state;
    std::size_t m_unwanted = 0, m_ofAnotherPatient = 0;
    std::map<std::string, std::size_t> m_receivedBefore; ///< by access token
    double m_waited = 0.0, m_receiving = 0.0;            ///< of all connections, in seconds
    bool m_offersNoGet = false;
    /// How the server is asked for objects: in the next form after it has refused the former.
    enum class Form { list, single, series };
    Form m_form = Form::list;
    bool m_sendsSingle = false;
    std::set<std::string> m_askedWhole; ///< series that were asked for in the last form
    std::exception_ptr m_failure;
};

} // namespace pellucid::archive
