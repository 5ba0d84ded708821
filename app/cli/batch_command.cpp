// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include <CLI/CLI.hpp>

#include "app/cli/batch_run.h"
#include "app/cli/commands.h"
#include "app/cli/input.h"

namespace pellucid::cli {

void addBatchCommand(CLI::App &app, const Context &context) {
    auto o = std::make_shared<BatchOptions>();
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
    c->add_option("--find", o->terms,
                  "TERM=VALUE: which studies of the server: name, id, date, modality, study, "
                  "accession; or, with study, the UID of one series of it: series; default: all")
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
    c->add_option("--shard", o->shard, "I/N: only part I, from 0, of the studies in N parts");
    c->add_flag("--resume", o->resumes,
                "Skip the studies whose results are there, made by this recipe of the same files");
    c->add_option("--threads", o->threads, "Maximum number of threads; default: all processors")
        ->check(CLI::Range(1, 1024));
    c->add_option("--memory", o->memory,
                  "Memory that all jobs share, in bytes or with a unit (2GB); default: the "
                  "available memory")
        ->transform(CLI::AsSizeValue(false));
    c->add_flag("--json", o->json, "Print a report as one JSON object");
    c->callback([o, context] {
        if (o->paths.empty() && o->from.empty())
            throw CLI::RequiredError("PATH or --from");
        if (o->out.empty() && o->sendTo.empty())
            throw CLI::RequiredError("--out or --send");
        runBatch(*o, context);
    });
}

} // namespace pellucid::cli
