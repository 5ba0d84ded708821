// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/commands.h"
#include "app/cli/input.h"
#include "core/dicom/write_series.h"
#include "core/files/atomic_file.h"
#include "core/phantom/phantom.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::cli {

namespace {

struct Options {
    std::string folder, kind = "head", size, spacing, syntax = "explicit";
    double tiltDeg = 0.0;
};

void run(const Options &o, const CLI::App &command, const Context &context) {
    namespace because = task::because;
    using task::Error;
    using task::ErrorCode;
    const phantom::Kind kind = phantom::kindFromName(o.kind);
    const dicom::TransferSyntax syntax = dicom::transferSyntaxFromName(o.syntax);
    phantom::Sampling sampling;
    if (command.count("--size") > 0) {
        if (o.size.find_first_not_of("0123456789x") != std::string::npos)
            throw Error(ErrorCode::usage, because::inWords("--size: '" + o.size +
                                                           "' is not integers separated by 'x'"));
        const auto n = parseNumbers("--size", o.size, 'x', 3);
        for (const double v : n)
            if (v != std::round(v) || v < 1 || v > 4096)
                throw Error(ErrorCode::usage,
                            because::inWords("--size: '" + o.size +
                                             "' is not COLUMNSxROWSxSLICES of 1 to 4096"));
        sampling.size = volume::GridSize{int(n[0]), int(n[1]), int(n[2])};
    }
    if (command.count("--spacing") > 0) {
        const auto s = parseNumbers("--spacing", o.spacing, ',', 3);
        sampling.spacingMm = glm::dvec3(s[0], s[1], s[2]);
    }
    sampling.tiltRad = o.tiltDeg * 3.14159265358979323846 / 180.0;
    files::requireWritable(o.folder);
    const task::Progress progress(context.stop);
    const auto volume = phantom::makePhantom(kind, phantom::phantomLattice(kind, sampling),
                                             progress.part(0.0, 0.6));
    dicom::SeriesLabels labels;
    labels.patientName =
        "Phantom^" + std::string(1, char(std::toupper(o.kind[0]))) + o.kind.substr(1);
    labels.patientId = "PHANTOM-" + o.kind;
    labels.studyDescription = "Pellucid phantom";
    labels.seriesDescription = volume.notes().title;
    labels.bodyPart = kind == phantom::Kind::head    ? "HEAD"
                      : kind == phantom::Kind::chest ? "CHEST"
                                                     : "PHANTOM";
    labels.windows = volume.notes().windows;
    dicom::writeCtSeries(o.folder, volume, labels, syntax, progress.part(0.6, 1.0));
}

} // namespace

void addPhantomCommand(CLI::App &app, const Context &context) {
    auto o = std::make_shared<Options>();
    CLI::App *c = app.add_subcommand("phantom", "Write a phantom as a DICOM series");
    c->add_option("DIR", o->folder, "Folder to write to")->required()->check(notEmpty());
    c->add_option("--kind", o->kind, "Kind of phantom; default head")
        ->check(CLI::IsMember(phantom::kindNames()));
    c->add_option("--size", o->size, "Number of samples: COLUMNSxROWSxSLICES");
    c->add_option("--spacing", o->spacing, "Spacing of columns, rows and slices in mm: a,b,c");
    c->add_option("--tilt", o->tiltDeg, "Gantry tilt in degrees")->check(CLI::Range(-57.0, 57.0));
    c->add_option("--transfer-syntax", o->syntax,
                  fmt::format("{}, or a UID; default explicit",
                              fmt::join(dicom::transferSyntaxNames(), ", ")));
    c->callback([o, c, context] { run(*o, *c, context); });
}

} // namespace pellucid::cli
