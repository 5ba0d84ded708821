// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/cli/json_text.h"
#include "app/cli/reasons.h"
#include "app/cli/servers.h"
#include "app/cli/terminal.h"
#include "core/archive/search.h"
#include "core/task/error.h"

namespace pellucid::cli {

namespace {

namespace tag = network::tag;
using network::Level;

struct Options {
    std::vector<std::string> names;
    archive::SearchTerms terms;
    std::string level = "study";
    std::uint32_t limit = 0;
    bool hasLimit = false, json = false;
};

// The names of attributes in JSON, as of `info --json` where it has them.
constexpr std::pair<std::uint32_t, const char *> names[]{
    {tag::studyUid, "study_uid"},
    {tag::seriesUid, "series_uid"},
    {tag::sopInstanceUid, "instance_uid"},
    {tag::patientName, "patient_name"},
    {tag::patientId, "patient_id"},
    {tag::birthDate, "birth_date"},
    {tag::sex, "sex"},
    {tag::studyDate, "date"},
    {tag::studyTime, "time"},
    {tag::studyDescription, "description"},
    {tag::accessionNumber, "accession"},
    {tag::modalitiesInStudy, "modalities"},
    {tag::seriesInStudy, "series_count"},
    {tag::instancesInStudy, "instance_count"},
    {tag::seriesNumber, "series_number"},
    {tag::seriesDescription, "series_description"},
    {tag::modality, "modality"},
    {tag::bodyPart, "body_part"},
    {tag::instancesInSeries, "series_instance_count"},
    {tag::sopClassUid, "class_uid"},
    {tag::instanceNumber, "instance_number"},
};

nlohmann::json jsonOf(const archive::FoundEntry &entry) {
    nlohmann::json out{{"servers", entry.servers}};
    for (const auto &[tag, name] : names)
        if (const std::string text = entry.text(tag); !text.empty())
            out[name] = text;
    return out;
}

// Empty if the server does not count them.
std::string imagesOf(const archive::FoundEntry &entry) {
    const std::string count = entry.text(tag::instancesInSeries);
    return count.empty() ? count : count + (count == "1" ? " image" : " images");
}

std::string lineOf(const archive::FoundEntry &entry, Level level) {
    std::string servers;
    for (const std::string &server : entry.servers)
        servers += (servers.empty() ? "" : ", ") + server;
    switch (level) {
    case Level::study:
        return fmt::format("{}  {:<10}  {} ({})  {}  {}  [{}]", entry.text(tag::studyDate),
                           entry.text(tag::modalitiesInStudy), entry.text(tag::patientName),
                           entry.text(tag::patientId), entry.text(tag::studyDescription),
                           entry.text(tag::studyUid), servers);
    case Level::series:
        return fmt::format("{:>4}  {:<4}  {}  {}  {}  [{}]", entry.text(tag::seriesNumber),
                           entry.text(tag::modality), entry.text(tag::seriesDescription),
                           imagesOf(entry), entry.text(tag::seriesUid), servers);
    case Level::image:
        return fmt::format("{:>5}  {}  [{}]", entry.text(tag::instanceNumber),
                           entry.text(tag::sopInstanceUid), servers);
    }
    return {};
}

void find(const Options &o, const Context &context) {
    std::vector<archive::Server> servers = serversNamed(o.names, context);
    if (o.hasLimit)
        for (archive::Server &server : servers)
            server.limit = o.limit;
    const archive::SearchResult result =
        archive::search(servers, o.terms, {}, task::Progress(context.stop));
    std::optional<task::Error> failure;
    for (const archive::ServerOutcome &outcome : result.outcomes) {
        if (outcome.failure) {
            failure.emplace(outcome.code, *outcome.failure, outcome.server);
            if (servers.size() > 1)
                warn(failure->what());
        }
        if (outcome.reachedLimit)
            warn(outcome.server +
                 ": the server has more results than these; a higher --limit shows them");
        if (outcome.mayBeIncomplete)
            warn(outcome.server + ": " + task::Reason(task::because::listMayBeShort).english());
        if (outcome.withoutUid > 0)
            warn(outcome.server + ": " +
                 task::because::entriesHaveNoUid(outcome.withoutUid).english());
        for (const std::string &warning : outcome.warnings)
            warn(outcome.server + ": " + warning);
    }
    if (o.json) {
        nlohmann::json out = nlohmann::json::array();
        for (const archive::FoundEntry &entry : result.entries)
            out.push_back(jsonOf(entry));
        std::puts(jsonText(out).c_str());
    } else {
        if (result.entries.empty() && !failure)
            warn("nothing matches");
        for (const archive::FoundEntry &entry : result.entries)
            std::puts(printable(lineOf(entry, o.terms.level)).c_str());
    }
    // Prints what some servers answered; the exit code reports that others failed.
    const bool haveAllFailed =
        std::all_of(result.outcomes.begin(), result.outcomes.end(),
                    [](const archive::ServerOutcome &one) { return one.failure.has_value(); });
    if (failure && haveAllFailed)
        throw *failure;
    if (failure)
        throw task::Error(task::ErrorCode::incomplete, task::because::notAllServersAnswered);
}

} // namespace

void addFindCommand(CLI::App &app, const Context &context) {
    auto o = std::make_shared<Options>();
    CLI::App *c = app.add_subcommand("find", "Search servers for studies, series and images");
    c->add_option("NAME", o->names, "Names of servers")->required();
    c->add_option("--level", o->level, "Query level; default study")
        ->check(CLI::IsMember({"study", "series", "image"}));
    c->add_option("--name", o->terms.patientName,
                  "Name of the patient, for studies; * and ? are wildcards");
    c->add_option("--id", o->terms.patientId, "ID of the patient, for studies");
    c->add_option("--accession", o->terms.accession, "Accession number, for studies");
    c->add_option("--date", o->terms.date,
                  "Date YYYYMMDD, or a range YYYYMMDD-YYYYMMDD, for studies");
    c->add_option("--modality", o->terms.modality, "Modality, such as CT, for studies and series");
    c->add_option("--study", o->terms.studyUid, "UID of the study");
    c->add_option("--series", o->terms.seriesUid, "UID of the series, for series and images");
    CLI::Option *limit = c->add_option(
        "--limit", o->limit,
        "Maximum results from each server; default: the limit set by server add; 0: no limit");
    c->add_flag("--json", o->json, "Print a JSON array");
    c->callback([o, context, limit] {
        o->hasLimit = limit->count() > 0;
        o->terms.level = o->level == "series"  ? Level::series
                         : o->level == "image" ? Level::image
                                               : Level::study;
        find(*o, context);
    });
}

} // namespace pellucid::cli
