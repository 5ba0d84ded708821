// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/archive/server.h"
#include "core/network/client/query.h"
#include "core/task/error.h"
#include "core/task/progress.h"
#include "core/task/reason.h"

namespace pellucid::archive {

/// What is searched for; empty texts restrict nothing. `*` and `?` are wildcards. Patient,
/// accession number and date apply to studies, the modality to studies and series.
struct SearchTerms {
    std::string patientName, patientId, accession;
    std::string modality; ///< one or, with commas between, several
    std::string studyUid;
    /// YYYYMMDD, or a range FROM-TO either end may be open.
    std::string date;
    network::Level level = network::Level::study;
    std::string seriesUid; ///< for series and images
};

/// A study, series or image, as one or more servers describe it.
struct FoundEntry {
    network::Attributes attributes; ///< of the first server that has it
    std::vector<std::string> servers;

    std::string text(std::uint32_t tag) const;
};

/// How the search ended at a server.
struct ServerOutcome {
    std::string server;
    bool reachedLimit = false;
    bool mayBeIncomplete = false; ///< the server has a limit of its own
    std::size_t withoutUid = 0;   ///< entries that cannot be opened, and are not in the result
    std::vector<std::string> warnings;
    std::optional<task::Reason> failure;
    task::ErrorCode code = task::ErrorCode::unreachable; ///< of the failure
    double seconds = 0.0;
};

struct SearchResult {
    std::vector<FoundEntry> entries; ///< folded by their UID, in the order of their arrival
    std::vector<ServerOutcome> outcomes;
};

/// Told of each entry as it arrives, from one thread at a time: a new one, or a known one that
/// another server also has; and of each server when it has ended.
struct SearchObserver {
    std::function<void(const FoundEntry &entry, std::size_t index)> found;
    std::function<void(const ServerOutcome &)> ended;
};

/// Searches servers at the same time. A server that fails is an outcome; the others go on. *Throws*
/// Error{usage} if the terms make no sense; Cancelled.
SearchResult search(const std::vector<Server> &servers, const SearchTerms &terms,
                    const SearchObserver &observer = {}, const task::Progress &progress = {});

/// Whether the text is a day of the calendar, YYYYMMDD.
bool isDay(const std::string &text);

/// The query of these terms, and the attributes it asks for. *Throws* Error{usage}.
network::Query queryOf(const SearchTerms &terms, std::uint32_t limit);

} // namespace pellucid::archive
