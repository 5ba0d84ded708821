// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <fnmatch.h>
#include <functional>
#include <future>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/archive/object_folder.h"
#include "core/archive/retrieval.h"
#include "core/archive/search.h"
#include "core/archive/sending.h"
#include "core/task/error.h"
#include "core/task/progress.h"
#include "tests/network/pacs.h"

/// What the tables of odd servers share: outcomes in words, such as "8 of 8".
namespace pellucid::test {

inline std::string searched(const archive::Server &server, const task::Progress &progress) {
    const auto result = archive::search({server}, {}, {}, progress);
    const archive::ServerOutcome &outcome = result.outcomes.at(0);
    std::string text = std::to_string(result.entries.size()) + " studies";
    if (outcome.mayBeIncomplete || outcome.reachedLimit)
        text += ", may be incomplete";
    if (outcome.withoutUid > 0)
        text += ", " + std::to_string(outcome.withoutUid) + " without a UID";
    for (const std::string &warning : outcome.warnings)
        text += ", warning: " + warning;
    if (!outcome.failure)
        return text;
    return (result.entries.empty() ? "" : text + ", then: ") + outcome.failure->english();
}

/// `to`: a new folder.
inline std::string retrieved(const archive::Server &server, const std::string &study,
                             const fs::path &to, const task::Progress &progress,
                             const archive::MoveDestination &destination = {}) {
    const archive::ObjectFolder folder(to, archive::ObjectFolder::Durability::cached);
    const auto report = archive::retrieve(server, {study, {}}, folder, {}, progress, destination);
    std::string text =
        std::to_string(report.state.received) + " of " + std::to_string(report.state.wanted);
    if (!report.isComplete())
        text += " incomplete: " + report.missing.front().reason.english();
    if (const std::size_t files = filesIn(to).size(); files != report.state.received)
        text += ", but " + std::to_string(files) + " files";
    if (report.ofAnotherPatient > 0)
        text += ", " + std::to_string(report.ofAnotherPatient) + " of another patient";
    return text;
}

inline std::string sent(const archive::Server &server, const std::vector<fs::path> &files,
                        const task::Progress &progress) {
    try {
        const auto report = archive::send(server, files, {}, progress);
        std::string text = std::to_string(report.state.sent) + " sent";
        if (!report.notSent.empty())
            text += ": " + report.notSent.front().reason.english();
        if (!report.withChanges.empty())
            text += ", " + std::to_string(report.withChanges.size()) +
                    " changed: " + report.withChanges.front().reason.english();
        return text;
    } catch (const task::Error &error) {
        return "0 sent: " + error.reason().english();
    }
}

/// What a task comes to, also if it fails or takes longer than `patience`.
inline std::string outcomeWithin(std::chrono::seconds patience,
                                 const std::function<std::string(const task::Progress &)> &task) {
    std::stop_source stop;
    const task::Progress progress(stop.get_token());
    auto outcome = std::async(std::launch::async, [&]() -> std::string {
        try {
            return task(progress);
        } catch (const task::Error &error) {
            return error.reason().english();
        } catch (const task::Cancelled &) {
            return "hangs";
        } catch (const std::exception &error) {
            return std::string("throws ") + error.what();
        }
    });
    if (outcome.wait_for(patience) != std::future_status::ready)
        stop.request_stop();
    return outcome.get();
}

/// Compares the outcome of each row, a pattern of fnmatch, with what `outcomeOf` makes of the row
/// and its number. *Returns* the outcomes. Some rows run at the same time: most of it, they wait.
template <class Row, class F>
std::vector<std::string> expectOutcomes(const std::vector<Row> &rows, F &&outcomeOf) {
    std::vector<std::string> outcomes(rows.size());
    {
        std::atomic<std::size_t> next = 0;
        std::vector<std::jthread> threads;
        for (int n = 0; n < 4; ++n)
            threads.emplace_back([&] {
                for (std::size_t row = next++; row < rows.size(); row = next++)
                    outcomes[row] = outcomeOf(rows[row], row);
            });
    }
    for (std::size_t n = 0; n < rows.size(); ++n)
        EXPECT_EQ(::fnmatch(rows[n].outcome, outcomes[n].c_str(), 0), 0)
            << rows[n].quirk << "\nexpected: " << rows[n].outcome << "\noutcome:  " << outcomes[n];
    return outcomes;
}

/// A user who has entered a login: eva, secret.
inline void hasPassword(archive::Server &server) {
    server.peer.authentication = network::Authentication::basic;
    server.peer.user = "eva";
    server.peer.secret = "secret";
}

} // namespace pellucid::test
