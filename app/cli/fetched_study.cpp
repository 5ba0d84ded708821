// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/fetched_study.h"

#include "app/cli/input.h"
#include "app/cli/servers.h"
#include "core/archive/reasons.h"
#include "core/archive/retrieval.h"
#include "core/archive/search.h"
#include "core/task/error.h"
#include "core/task/naming.h"
#include "core/task/reasons.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;
namespace tag = network::tag;
using task::Error;
using task::ErrorCode;

// The UIDs of the series with this number. Numbers are not unique.
std::vector<std::string> seriesNumbered(const archive::Server &server, const std::string &studyUid,
                                        const std::string &number, const task::Progress &progress) {
    archive::SearchTerms terms;
    terms.studyUid = studyUid;
    terms.level = network::Level::series;
    archive::Server all = server;
    all.limit = 0;
    const archive::SearchResult found = archive::search({all}, terms, {}, progress);
    for (const archive::ServerOutcome &outcome : found.outcomes)
        if (outcome.failure)
            throw Error(outcome.code, *outcome.failure);
    std::vector<std::string> uids;
    for (const archive::FoundEntry &entry : found.entries)
        if (entry.text(tag::seriesNumber) == number)
            uids.push_back(entry.text(tag::seriesUid));
    if (uids.empty())
        throw Error(ErrorCode::unusable,
                    because::inWords("the study on the server has no series " + number));
    return uids;
}

} // namespace

void addRemoteOptions(CLI::App &command, RemoteOptions &options, CLI::Option &path) {
    CLI::Option *const from =
        command
            .add_option("--from", options.server,
                        "Name of the server to retrieve the study from, instead of PATH")
            ->check(notEmpty())
            ->excludes(&path);
    CLI::Option *const study =
        command.add_option("--study", options.studyUid, "UID of the study on that server")
            ->check(notEmpty());
    from->needs(study);
    study->needs(from);
}

void requirePathOrServer(bool hasPath, const RemoteOptions &options) {
    if (!hasPath && !options.isGiven())
        throw Error(ErrorCode::usage, because::inWords("PATH or --from is required"));
}

FetchedStudy::FetchedStudy(const RemoteOptions &remote, const std::string &series,
                           const Context &context) {
    if (!network::isUid(remote.studyUid))
        throw Error(ErrorCode::usage, because::isNoUid(remote.studyUid));
    if (!series.empty() && !network::isUid(series)) // a number has the form of a UID, too
        throw Error(ErrorCode::usage, because::isNoUid(series));
    const archive::Server server = serverNamed(remote.server, context);
    const task::Progress progress(context.stop);
    task::naming(server.name, [&] {
        archive::Wanted wanted{remote.studyUid, {}};
        const bool isNumber =
            !series.empty() && series.find_first_not_of("0123456789") == std::string::npos;
        if (isNumber)
            wanted.seriesUids = seriesNumbered(server, remote.studyUid, series, progress);
        else if (!series.empty())
            wanted.seriesUids = {series};
        const archive::ObjectFolder objects(m_folder.path(),
                                            archive::ObjectFolder::Durability::cached);
        const auto report = watched([&](const archive::RetrievalObserver &observer) {
            return archive::retrieve(server, wanted, objects, observer, progress);
        });
        warnOfObjects(report);
        requireComplete(report, server.name);
    });
}

} // namespace pellucid::cli
