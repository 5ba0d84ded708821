// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/bench/suites.h"
#include "app/exit_code.h"
#include "core/decoding/client/read_volume_file.h"
#include "core/files/atomic_file.h"
#include "core/platform/process.h"
#include "core/reference/wide_kernel.h"
#include "core/system/memory.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace {

// Refuses an unwritable path now, not after minutes of measuring.
void checkWritable(const std::filesystem::path &path) {
    if (path.empty())
        return;
    if (std::filesystem::is_directory(path))
        throw pellucid::task::Error(pellucid::task::ErrorCode::output,
                                    pellucid::task::because::inWords("is a folder"), path);
    pellucid::files::AtomicFile{path};
}

void save(const std::string &path, const std::string &text) {
    if (path.empty())
        return;
    pellucid::files::AtomicFile file(path);
    file.write(text);
    file.commit();
}

pellucid::bench::Subject readSubject(const std::string &path) {
    using namespace pellucid;
    const auto volume = decoding::readVolumeFile(path);
    bench::Subject subject{std::filesystem::path(path).stem().string(),
                           classify::densityField(volume, classify::defaultFieldWindow(volume))};
    // The exact reference needs by far the most memory.
    const std::size_t needed = reference::WideKernel::bytes(subject.field.support);
    const std::size_t available = system::availableMemoryBytes();
    if (needed > available)
        throw task::Error(task::ErrorCode::outOfMemory,
                          task::because::inWords(
                              fmt::format("its exact projection needs {} MB, {} MB are available",
                                          (needed >> 20) + 1, available >> 20)),
                          path);
    return subject;
}

struct Options {
    std::vector<std::string> suites{"quick"};
    double minutes = 1.0, within = std::numeric_limits<double>::infinity();
    int pictures = 300, fields = 200;
    std::uint64_t seed = 1;
    std::string volume, json, csv, reportFolder;
};

// Runs a suite. The subject is null if no volume was given.
using RunSuite = std::function<void(const pellucid::bench::Report &,
                                    const pellucid::bench::Subject *, const Options &)>;

const std::vector<std::pair<std::string, RunSuite>> &suites() {
    using namespace pellucid::bench;
    const auto alone = [](void (*run)(const Report &)) {
        return [run](const Report &report, const Subject *, const Options &) { run(report); };
    };
    const auto ofSubject = [](void (*run)(const Report &, const Subject *)) {
        return [run](const Report &report, const Subject *subject, const Options &) {
            run(report, subject);
        };
    };
    static const std::vector<std::pair<std::string, RunSuite>> all{
        {"quick", alone(runQuickSuite)},
        {"kernels", ofSubject(runKernelsSuite)},
        {"hard", alone(runHardSuite)},
        {"scaling", ofSubject(runScalingSuite)},
        {"thesis", alone(runThesisSuite)},
        {"totsuka", alone(runTotsukaSuite)},
        {"classes", alone(runClassesSuite)},
        {"shading", alone(runShadingSuite)},
        {"planes", alone(runPlanesSuite)},
        {"panes", alone(runPanesSuite)},
        {"radiograph", alone(runRadiographSuite)},
        {"check", alone(runCheckSuite)},
        {"gpu", alone(runGpuSuite)},
        {"search",
         [](const Report &report, const Subject *, const Options &options) {
             runSearchSuite(report, options.minutes, options.seed);
         }},
        {"pictures",
         [](const Report &report, const Subject *, const Options &options) {
             runPicturesSuite(report, options.pictures, options.seed);
         }},
        {"sweep",
         [](const Report &report, const Subject *, const Options &options) {
             runSweepSuite(report, options.fields, options.seed);
         }},
    };
    return all;
}

void addOptions(CLI::App &app, Options &options) {
    std::vector<std::string> names;
    for (const auto &[name, run] : suites())
        names.push_back(name);
    app.set_version_flag("--version", "pellucid-bench " PELLUCID_VERSION);
    app.add_option("--suite", options.suites, "Suites to run, separated by commas")
        ->delimiter(',')
        ->check(CLI::IsMember(names));
    app.add_option("--minutes", options.minutes, "Duration of --suite search")
        ->check(CLI::Range(0.01, 10000.0));
    app.add_option("--pictures", options.pictures, "Number of pictures for --suite pictures")
        ->check(CLI::Range(1, 100000));
    app.add_option("--fields", options.fields, "Number of fields for --suite sweep")
        ->check(CLI::Range(1, 100000));
    app.add_option("--seed", options.seed, "Random seed of the suites search, pictures and sweep");
    app.add_option("--volume", options.volume,
                   "An NRRD volume to measure in the suites kernels and scaling");
    app.add_option("--within", options.within,
                   "Minutes after which no further row is measured; default: no limit")
        ->check(CLI::Range(0.0, 10000.0));
    app.add_option("--json", options.json, "Write the rows as JSON");
    app.add_option("--csv", options.csv, "Write the rows as CSV");
    app.add_option("--report", options.reportFolder,
                   "Write an HTML report and the gnuplot script of its plots into a folder");
}

void checkOutputs(const Options &options) {
    checkWritable(options.json);
    checkWritable(options.csv);
    if (options.reportFolder.empty())
        return;
    pellucid::bench::makeReportFolder(options.reportFolder);
    checkWritable(std::filesystem::path(options.reportFolder) / "report.html");
}

// The subject of --volume, if given.
std::optional<pellucid::bench::Subject> givenSubject(const Options &options) {
    using namespace pellucid;
    if (options.volume.empty())
        return std::nullopt;
    for (const std::string &suite : options.suites)
        if (suite != "kernels" && suite != "scaling")
            throw task::Error(task::ErrorCode::usage,
                              task::because::inWords("--volume needs --suite kernels or scaling"));
    return readSubject(options.volume);
}

// Runs the suites and writes the requested files.
void measureSuites(const Options &options) {
    using namespace pellucid;
    checkOutputs(options);
    const std::optional<bench::Subject> subject = givenSubject(options);
    const auto machine = bench::thisMachine();
    std::vector<bench::Row> rows;
    struct TimeIsUp {};
    const double end = bench::millisecondsNow() + 60e3 * options.within;
    const auto report = [&](const bench::Row &row) {
        if (rows.empty())
            std::fputs(bench::tableHead(machine).c_str(), stdout);
        std::fputs(bench::tableLine(row).c_str(), stdout);
        std::fflush(stdout);
        rows.push_back(row);
        if (bench::millisecondsNow() > end)
            throw TimeIsUp();
    };
    std::optional<task::Error> noCard; // other suites do without
    try {
        for (const std::string &wanted : options.suites)
            for (const auto &[name, run] : suites())
                if (name == wanted)
                    try {
                        run(report, subject ? &*subject : nullptr, options);
                    } catch (const task::Error &error) {
                        if (error.code() != task::ErrorCode::noSuchDevice)
                            throw;
                        noCard = error;
                    }
    } catch (const TimeIsUp &) {
        std::puts("the time is up: not everything was measured");
    }
    save(options.json, bench::jsonText(machine, rows));
    save(options.csv, bench::csvText(rows));
    if (!options.reportFolder.empty())
        bench::writeHtmlReport(options.reportFolder, machine, rows);
    if (noCard)
        throw task::Error(*noCard);
}

int fail(const std::exception &error, pellucid::task::ErrorCode code) {
    std::fprintf(stderr, "pellucid-bench: %s\n", error.what());
    return pellucid::exitCode(code);
}

} // namespace

int main(int argc, char **argv) {
    using namespace pellucid;
    platform::letLongFilesFail();
    CLI::App app("Speed and error of projections", "pellucid-bench");
    app.allow_windows_style_options(false); // a path may begin with a slash
    Options options;
    addOptions(app, options);
    try {
        app.parse(argc, argv);
        measureSuites(options);
    } catch (const CLI::Success &success) {
        return app.exit(success);
    } catch (const CLI::ParseError &error) {
        return fail(error, task::ErrorCode::usage);
    } catch (const task::Error &error) {
        return fail(error, error.code());
    } catch (const std::exception &error) {
        return fail(error, task::ErrorCode::internal);
    }
    return 0;
}
