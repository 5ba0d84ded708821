// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/retrieval_work.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <utility>

#include "core/archive/reasons.h"
#include "core/network/client/reasons.h"
#include "core/task/error.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

constexpr std::size_t maxBatchSize = 32;
constexpr std::size_t maxUnwanted = 1000; // objects

// The objects of a series in a folder that are not known.
std::vector<StoredObject> unlistedIn(const ObjectFolder &folder, const ShortSeries &series,
                                     const std::set<std::string> &known) {
    namespace fs = std::filesystem;
    std::vector<StoredObject> objects;
    std::error_code none;
    const fs::path study = folder.folder() / series.studyUid;
    fs::recursive_directory_iterator it(series.seriesUid.empty() ? study : study / series.seriesUid,
                                        none);
    for (; !none && it != fs::recursive_directory_iterator(); it.increment(none)) {
        const std::string uid = it->path().stem().string();
        if (it->path().extension() != ".dcm" || known.contains(uid))
            continue;
        if (auto object =
                folder.find(series.studyUid, it->path().parent_path().filename().string(), uid))
            objects.push_back(std::move(*object));
    }
    return objects;
}

} // namespace

RetrievalWork::RetrievalWork(const Listing &listing, const ObjectFolder &folder,
                             const RetrievalObserver &observer, int connections, Existing existing)
    : m_folder(folder), m_observer(observer), m_connections(std::size_t(connections)),
      m_patient(listing.patient), m_studyDate(listing.studyDate), m_short(listing.shortSeries),
      m_existing(existing) {
    m_state.wanted = listing.instances.size();
    for (const Instance &instance : listing.instances) {
        m_known.insert(instance.sopInstanceUid);
        const auto object =
            folder.find(instance.studyUid, instance.seriesUid, instance.sopInstanceUid);
        if (object && !(noteCorrections(*object) && existing == Existing::isReplaced)) {
            ++m_state.present;
            compare(*object);
        } else {
            m_missing.emplace(instance.sopInstanceUid, instance);
        }
    }
    for (const ShortSeries &series : m_short) {
        m_state.wanted += series.unlisted;
        for (const StoredObject &object : unlistedIn(m_folder, series, m_known))
            if (takeUnlisted(object))
                compare(object);
    }
    m_state.present += std::exchange(m_state.received, 0);
    fillQueue(listing.instances);
}

// Counts an object that the server has not listed. False if it is none.
bool RetrievalWork::takeUnlisted(const StoredObject &object) {
    const auto isOf = [&](const ShortSeries &series) {
        return series.studyUid == object.studyUid &&
               (series.seriesUid.empty() || series.seriesUid == object.seriesUid);
    };
    const auto series = std::find_if(m_short.begin(), m_short.end(), isOf);
    if (series == m_short.end() || !m_known.insert(object.sopInstanceUid).second)
        return false;
    ++m_state.received;
    if (series->unlisted > 0)
        --series->unlisted;
    else
        ++m_state.wanted; // the server did not say how many there are
    return true;
}

// False if the server lists the object as it is here.
bool RetrievalWork::noteCorrections(const StoredObject &object) {
    std::vector<Correction> found = correctionsOf(m_patient, m_studyDate, object);
    if (found.empty())
        return false;
    if (m_corrected++ == 0)
        m_corrections = std::move(found);
    return true;
}

// A server may send anybody's images under the UIDs that it was asked for.
void RetrievalWork::compare(const StoredObject &object) {
    if (!isOfAnother(m_patient, object.patient)) {
        if (m_observer.matches)
            m_observer.matches(object);
    } else if (m_ofAnotherPatient++ == 0) {
        m_named = object.patient;
    }
}

std::size_t RetrievalWork::missing() const {
    const std::lock_guard lock(m_mutex);
    return m_missing.size();
}

std::size_t RetrievalWork::wholeBatches() const {
    const std::lock_guard lock(m_mutex);
    return std::size_t(std::count_if(m_queue.begin(), m_queue.end(),
                                     [](const Batch &batch) { return batch.uids.empty(); }));
}

bool RetrievalWork::hasBatches() const {
    const std::lock_guard lock(m_mutex);
    return !m_queue.empty() && !m_failure && !m_offersNoGet;
}

std::set<std::string> RetrievalWork::classes() const {
    std::set<std::string> found;
    for (const auto &[uid, instance] : m_missing)
        found.insert(instance.sopClassUid);
    return found;
}

bool RetrievalWork::awaitNeed(std::size_t index) {
    constexpr std::chrono::milliseconds moment(150);
    std::unique_lock lock(m_mutex);
    for (;;) {
        if (m_queue.empty() || m_failure || m_offersNoGet)
            return false;
        const bool isMeasured = m_state.received >= m_connections;
        if (m_whyGivenUp || (isMeasured && !isEnough(index))) // nobody else may be left
            return true;
        m_received.wait_for(lock, moment);
    }
}

// Requires the lock.
bool RetrievalWork::isEnough(std::size_t connections) const {
    return m_receiving > 0.0 && double(connections) >= (m_waited + m_receiving) / m_receiving;
}

void RetrievalWork::worked(double waited, double received) {
    const std::lock_guard lock(m_mutex);
    m_waited += waited;
    m_receiving += received;
}

std::optional<Batch> RetrievalWork::next() {
    const std::lock_guard lock(m_mutex);
    while (!m_queue.empty() && !m_failure && !m_offersNoGet) {
        Batch batch = std::move(m_queue.front());
        m_queue.pop_front();
        // Some have come with others.
        const bool isWhole = batch.uids.empty();
        std::erase_if(batch.uids, [&](const std::string &uid) { return !m_missing.contains(uid); });
        if (m_form == Form::single && batch.uids.size() > 1) {
            Batch rest = batch;
            rest.uids.erase(rest.uids.begin());
            m_queue.push_front(std::move(rest));
            batch.uids.resize(1);
        }
        if (isWhole || !batch.uids.empty())
            return batch;
    }
    return std::nullopt;
}

void RetrievalWork::putBack(Batch batch) {
    const std::lock_guard lock(m_mutex);
    m_queue.push_front(std::move(batch));
}

std::vector<ObjectFolder::Place> RetrievalWork::placesOf(const std::string &uid) {
    const std::lock_guard lock(m_mutex);
    const auto missing = m_missing.find(uid);
    if (missing != m_missing.end())
        return {{missing->second.studyUid, missing->second.seriesUid}};
    std::vector<ObjectFolder::Place> places;
    if (!m_known.contains(uid) && m_known.size() < maxObjectsOfStudy)
        for (const ShortSeries &series : m_short)
            places.push_back({series.studyUid, series.seriesUid});
    // Objects that are here come again with their whole series.
    if (places.empty() && ++m_unwanted > maxUnwanted + 2 * m_state.wanted)
        throw Error(ErrorCode::unusable, because::serverSendsTooMuch);
    return places;
}

void RetrievalWork::stored(const StoredObject &object) {
    const std::lock_guard lock(m_mutex);
    if (m_missing.erase(object.sopInstanceUid) > 0)
        ++m_state.received;
    else if (!takeUnlisted(object))
        return;
    m_sendsSingle = m_sendsSingle || m_form == Form::single;
    m_reasons.erase(object.sopInstanceUid);
    m_received.notify_all();
    if (m_observer.stored)
        m_observer.stored(object);
    compare(object);
    if (m_observer.changed)
        m_observer.changed(m_state);
}

void RetrievalWork::refused(const std::string &uid, const task::Reason &reason) {
    const std::lock_guard lock(m_mutex);
    if (m_missing.contains(uid))
        m_reasons.insert_or_assign(uid, reason);
    else if (++m_unwanted > maxUnwanted + 2 * m_state.wanted)
        throw Error(ErrorCode::unusable, because::serverSendsTooMuch);
}

void RetrievalWork::findHere(const Batch &batch) {
    if (batch.uids.empty()) {
        std::set<std::string> known;
        {
            const std::lock_guard lock(m_mutex);
            known = m_known;
        }
        for (const StoredObject &object :
             unlistedIn(m_folder, {batch.studyUid, batch.seriesUid}, known)) {
            moved(std::int64_t(object.bytes));
            stored(object);
        }
    }
    for (const std::string &uid : batch.uids) {
        const std::optional<Instance> awaited = [&]() -> std::optional<Instance> {
            const std::lock_guard lock(m_mutex);
            const auto missing = m_missing.find(uid);
            return missing == m_missing.end() ? std::nullopt : std::optional(missing->second);
        }();
        if (!awaited)
            continue;
        if (const auto object = m_folder.find(awaited->studyUid, awaited->seriesUid, uid)) {
            moved(std::int64_t(object->bytes));
            stored(*object);
        }
    }
}

void RetrievalWork::ended(const Batch &batch, const network::RetrievalEnd &end) {
    const std::lock_guard lock(m_mutex);
    if (batch.uids.empty()) {
        const bool hasFailed =
            std::any_of(end.failedInstances.begin(), end.failedInstances.end(),
                        [&](const std::string &uid) { return !m_known.contains(uid); });
        if (!end.reason.empty())
            m_whyUnlisted = task::Reason::decoded(end.reason);
        else if (hasFailed)
            m_whyUnlisted = because::serverCouldNotSendIt;
        else
            m_whole.insert(batch.seriesUid);
    }
    for (const std::string &uid : batch.uids)
        if (m_missing.contains(uid) && !m_reasons.contains(uid))
            m_reasons.emplace(
                uid, !end.reason.empty()
                         ? task::Reason::decoded(end.reason).value_or(because::serverLeftItOut)
                     : std::find(end.failedInstances.begin(), end.failedInstances.end(), uid) !=
                             end.failedInstances.end()
                         ? task::Reason(because::serverCouldNotSendIt)
                         : task::Reason(because::serverLeftItOut));
}

void RetrievalWork::failed(const Batch &batch, const task::Reason &reason) {
    const std::lock_guard lock(m_mutex);
    if (batch.uids.empty())
        m_whyUnlisted = reason;
    for (const std::string &uid : batch.uids)
        if (m_missing.contains(uid))
            m_reasons.insert_or_assign(uid, reason);
}

void RetrievalWork::moved(std::int64_t bytes) {
    const std::lock_guard lock(m_mutex);
    m_state.bytes = std::uint64_t(std::int64_t(m_state.bytes) + bytes);
    if (m_observer.changed)
        m_observer.changed(m_state);
}

bool RetrievalWork::askDifferently(const Batch &batch) {
    const std::lock_guard lock(m_mutex);
    if (batch.uids.size() > 1 && m_form != Form::series) {
        m_form = Form::single;
        m_queue.push_front(batch);
        return true;
    }
    if (batch.uids.size() == 1 && m_form == Form::single && !m_sendsSingle)
        m_form = Form::series;
    if (batch.uids.empty() || m_form != Form::series ||
        !m_askedWhole.insert(batch.seriesUid).second)
        return false;
    m_queue.push_front({batch.studyUid, batch.seriesUid, {}});
    return true;
}

void RetrievalWork::gaveUp(const task::Reason &reason) {
    const std::lock_guard lock(m_mutex);
    m_whyGivenUp = reason;
    m_received.notify_all();
}

std::map<std::string, task::Reason> RetrievalWork::reasons() const {
    const std::lock_guard lock(m_mutex);
    return m_reasons;
}

void RetrievalWork::restoreReasons(const std::map<std::string, task::Reason> &before) {
    const std::lock_guard lock(m_mutex);
    for (const auto &[uid, reason] : before)
        if (m_missing.contains(uid))
            m_reasons.insert_or_assign(uid, reason);
}

void RetrievalWork::refuseMissing(const task::Reason &reason) {
    const std::lock_guard lock(m_mutex);
    for (const auto &[uid, instance] : m_missing)
        m_reasons.insert_or_assign(uid, reason);
}

void RetrievalWork::refuseAll(const Batch &batch, const task::Reason &reason) {
    failed(batch, reason);
    const std::lock_guard lock(m_mutex);
    for (const Batch &waiting : m_queue)
        for (const std::string &uid : waiting.uids)
            m_reasons.insert_or_assign(uid, reason);
    m_queue.clear();
}

void RetrievalWork::offersNoGet() {
    const std::lock_guard lock(m_mutex);
    m_offersNoGet = true;
    m_received.notify_all();
}

void RetrievalWork::stop(std::exception_ptr failure) {
    const std::lock_guard lock(m_mutex);
    if (!m_failure)
        m_failure = std::move(failure);
    m_received.notify_all();
}

void RetrievalWork::rethrow() {
    const std::lock_guard lock(m_mutex);
    if (m_failure)
        std::rethrow_exception(m_failure);
}

std::size_t RetrievalWork::receivedCount() {
    const std::lock_guard lock(m_mutex);
    return m_state.received;
}

std::size_t RetrievalWork::receivedBefore(const std::string &token) {
    const std::lock_guard lock(m_mutex);
    return m_receivedBefore.try_emplace(token, m_state.received).first->second;
}

bool RetrievalWork::fillQueueAgain(const std::vector<Instance> &instances) {
    const std::lock_guard lock(m_mutex);
    const bool isRefused = std::any_of(m_reasons.begin(), m_reasons.end(), [](const auto &reason) {
        return reason.second.is(because::serverStatus) ||
               reason.second.is(because::serverStatusWithComment) ||
               reason.second.is(because::serverCouldNotSendIt);
    });
    if (!isRefused || m_missing.empty())
        return false;
    fillQueue(instances);
    return true;
}

bool RetrievalWork::fillQueueWithShortSeries() {
    const std::lock_guard lock(m_mutex);
    m_queue.clear(); // what connections that gave up have left
    for (const ShortSeries &series : m_short)
        if (series.unlisted > 0 || series.mayHaveMore)
            m_queue.push_back({series.studyUid, series.seriesUid, {}});
    return !m_queue.empty();
}

RetrievalReport RetrievalWork::report() {
    const std::lock_guard lock(m_mutex);
    RetrievalReport report{m_state, 0.0, {}, m_unwanted, m_ofAnotherPatient, m_patient, m_named};
    if (m_existing == Existing::stays) {
        report.corrected = m_corrected;
        report.corrections = m_corrections;
    }
    for (const auto &[uid, instance] : m_missing) {
        const auto reason = m_reasons.find(uid);
        report.missing.push_back({uid, reason != m_reasons.end()
                                           ? reason->second
                                           : m_whyGivenUp.value_or(because::serverLeftItOut)});
    }
    for (const ShortSeries &series : m_short) {
        // The number is unknown, and the series was not received as a whole.
        const bool isUncertain = series.mayHaveMore && !m_whole.contains(series.seriesUid);
        const std::size_t count = series.unlisted > 0 ? series.unlisted : isUncertain ? 1 : 0;
        for (std::size_t n = 0; n < count; ++n)
            report.missing.push_back({"", n < series.invalid
                                              ? task::Reason(because::hasNoValidUids)
                                              : m_whyUnlisted.value_or(because::wasNotListed)});
    }
    return report;
}

void RetrievalWork::fillQueue(const std::vector<Instance> &instances) {
    for (std::size_t begin = 0; begin < instances.size();) {
        std::size_t end = begin;
        while (end < instances.size() && instances[end].seriesUid == instances[begin].seriesUid)
            ++end;
        const std::size_t count = end - begin;
        const std::size_t largest = std::clamp(count / 16, firstBatchSize, maxBatchSize);
        // Dealt out among the connections: together they bring coarse slices before fine ones.
        const Batch empty{instances[begin].studyUid, instances[begin].seriesUid, {}};
        std::vector<Batch> hands(m_connections, empty);
        std::size_t dealt = 0, taken = 0;
        const auto flush = [&] {
            for (Batch &hand : hands)
                if (!hand.uids.empty())
                    m_queue.push_back(std::exchange(hand, empty));
            dealt = 0;
        };
        for (const std::size_t index : coarseToFine(count)) {
            const std::string &uid = instances[begin + index].sopInstanceUid;
            if (!m_missing.contains(uid))
                continue;
            hands[dealt++ % hands.size()].uids.push_back(uid);
            // Small ones first: what is shown is coarse at first, and must not wait.
            const std::size_t size = ++taken <= count / 8 + 2 ? firstBatchSize : largest;
            if (dealt >= size * hands.size())
                flush();
        }
        flush();
        begin = end;
    }
}

} // namespace pellucid::archive
