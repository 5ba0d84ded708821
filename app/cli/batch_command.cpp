// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/cli/batch_run.h"
#include "app/cli/commands.h"
#include "app/cli/input.h"
#include "core/archive/search.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

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
        if (!known->second->empty())
            throw Error(ErrorCode::usage, because::inWords("--find: '" + text.substr(0, equals) +
                                                           "' is given twice"));
        *known->second = text.substr(equals + 1);
    }
    if (!terms.seriesUid.empty()) { // of one study, as servers need it
        if (texts.size() != 2 || terms.studyUid.empty())
            throw Error(
                ErrorCode::usage,
                because::inWords(
                    "--find: 'series' needs 'study', and cannot be combined with any other term"));
        terms.level = network::Level::series;
    }
    archive::queryOf(terms, 0); // checks the values
    return terms;
}

} // namespace

void addBatchCommand(CLI::App &app, const Context &context) {
    auto o = std::make_shared<BatchOptions>();
    auto terms = std::make_shared<std::vector<std::string>>();
    auto shard = std::make_shared<std::string>();
    CLI::App *c = app.add_subcommand("batch", "Render many studies by one recipe");
    c->add_option("RECIPE", o->recipe, "The recipe, a JSON file; see 'recipe'")
        ->required()
        ->check(notEmpty());
    CLI::Option *paths =
        c->add_option("PATH", o->paths, "Files, folders, DICOMDIRs and ZIP archives with studies");
    CLI::Option *from =
        c->add_option("--from", o->from, "Name of the server to retrieve the studies from")
            ->check(notEmpty())
            ->excludes(paths);
    c->add_option("--find", *terms,
                  "TERM=VALUE: retrieve only the studies that match; TERM is name, id, date, "
                  "modality, study or accession; series (a series UID) may be added to study; "
                  "default: all studies")
        ->needs(from);
    c->add_option("--out", o->out,
                  "Folder for the results; each study gets a folder of its own there")
        ->check(notEmpty());
    c->add_option("--send", o->sendTo, "Name of the server to send the DICOM outputs to")
        ->check(notEmpty());
    c->add_option("--jobs", o->jobs,
                  "Studies at the same time; default 2: one is loaded while "
                  "another is rendered")
        ->check(CLI::Range(1, 256));
    c->add_option("--shard", *shard,
                  "I/N: divide the studies into N parts and render only part I, counted from 0");
    c->add_flag(
        "--resume", o->resumes,
        "Skip studies whose results already exist, if the recipe and the files have not changed");
    c->add_option("--threads", o->threads, "Maximum number of threads; default: all processors")
        ->check(CLI::Range(1, 1024));
    c->add_option("--memory", o->memory,
                  "Memory that all jobs share, in bytes or with a unit (2GB); default: the "
                  "available memory")
        ->transform(CLI::AsSizeValue(false));
    c->add_flag("--json", o->json, "Print a report as one JSON object");
    addProtectionOption(*c, o->allowsUnprotected);
    c->callback([o, terms, shard, context] {
        if (o->paths.empty() && o->from.empty())
            throw CLI::RequiredError("PATH or --from");
        if (o->out.empty() && o->sendTo.empty())
            throw CLI::RequiredError("--out or --send");
        o->terms = termsFrom(*terms);
        o->shard = shardFrom(*shard);
        runBatch(*o, context);
    });
}

} // namespace pellucid::cli
