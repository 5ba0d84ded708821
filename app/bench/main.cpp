// SPDX-License-Identifier: GPL-3.0-or-later
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/bench/suites.h"
#include "app/exit_code.h"
#include "core/decoder/read_volume_file.h"
#include "core/files/atomic_file.h"
#include "core/reference/wide_kernel.h"
#include "core/system/memory.h"
#include "core/task/error.h"

namespace {

// Refuses at once what could only be said after minutes of measuring.
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
    const auto volume = decoder::readVolumeFile(path);
    bench::Subject subject{std::filesystem::path(path).stem().string(),
                           classify::densityField(volume, classify::defaultFieldWindow(volume))};
    // The exact reference that errors are taken against is the largest thing by far.
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

struct Search {
    double minutes = 1.0;
    int pictures = 300;
    std::uint64_t seed = 1;
};

void run(const std::string &suite, const pellucid::bench::Report &report,
         const pellucid::bench::Subject *subject, const Search &search) {
    using namespace pellucid::bench;
    if (suite == "quick")
        runQuickSuite(report);
    else if (suite == "kernels")
        runKernelsSuite(report, subject);
    else if (suite == "hard")
        runHardSuite(report);
    else if (suite == "scaling")
        runScalingSuite(report, subject);
    else if (suite == "thesis")
        runThesisSuite(report);
    else if (suite == "shading")
        runShadingSuite(report);
    else if (suite == "planes")
        runPlanesSuite(report);
    else if (suite == "gpu")
        runGpuSuite(report);
    else if (suite == "classes")
        runClassesSuite(report);
    else if (suite == "search")
        runSearchSuite(report, search.minutes, search.seed);
    else if (suite == "pictures")
        runPicturesSuite(report, search.pictures, search.seed);
    else
        runTotsukaSuite(report);
}

} // namespace

int main(int argc, char **argv) {
    using namespace pellucid;
    std::signal(SIGXFSZ, SIG_IGN);
    CLI::App app("Speed and error, side by side", "pellucid-bench");
    app.set_version_flag("--version", "pellucid-bench " PELLUCID_VERSION);
    std::vector<std::string> suites{"quick"};
    std::string json, csv, file, reportFolder;
    app.add_option("--suite", suites, "What to measure; several with commas between")
        ->delimiter(',')
        ->check(CLI::IsMember({"quick", "kernels", "hard", "scaling", "thesis", "totsuka",
                               "classes", "shading", "planes", "gpu", "search", "pictures"}));
    Search search;
    app.add_option("--minutes", search.minutes, "How long --suite search looks")
        ->check(CLI::Range(0.01, 10000.0));
    app.add_option("--pictures", search.pictures, "How many pictures --suite pictures makes")
        ->check(CLI::Range(1, 100000));
    app.add_option("--seed", search.seed, "Where the suites search and pictures begin");
    app.add_option("--volume", file,
                   "An NRRD volume in place of the fields of the suites kernels and scaling");
    app.add_option("--json", json, "Write the rows as JSON");
    app.add_option("--csv", csv, "Write the rows as CSV");
    app.add_option("--report", reportFolder,
                   "Write an HTML report into a folder, and the gnuplot script of its plots");
    try {
        app.parse(argc, argv);
        checkWritable(json);
        checkWritable(csv);
        if (!reportFolder.empty()) {
            bench::makeReportFolder(reportFolder);
            checkWritable(std::filesystem::path(reportFolder) / "report.html");
        }
        std::optional<bench::Subject> given;
        if (!file.empty()) {
            for (const std::string &suite : suites)
                if (suite != "kernels" && suite != "scaling")
                    throw task::Error(
                        task::ErrorCode::usage,
                        task::because::inWords("--volume goes with --suite kernels or scaling"));
            given = readSubject(file);
        }
        const auto machine = bench::thisMachine();
        std::vector<bench::Row> rows;
        const auto report = [&](const bench::Row &row) {
            if (rows.empty())
                std::fputs(bench::tableHead(machine).c_str(), stdout);
            std::fputs(bench::tableLine(row).c_str(), stdout);
            std::fflush(stdout);
            rows.push_back(row);
        };
        const bench::Subject *const subject = given ? &*given : nullptr;
        for (const std::string &suite : suites)
            run(suite, report, subject, search);
        save(json, bench::jsonText(machine, rows));
        save(csv, bench::csvText(rows));
        if (!reportFolder.empty())
            bench::writeHtmlReport(reportFolder, machine, rows);
    } catch (const CLI::Success &success) {
        return app.exit(success);
    } catch (const CLI::ParseError &error) {
        std::fprintf(stderr, "pellucid-bench: %s\n", error.what());
        return exitCode(task::ErrorCode::usage);
    } catch (const task::Error &error) {
        std::fprintf(stderr, "pellucid-bench: %s\n", error.what());
        return exitCode(error.code());
    } catch (const std::exception &error) {
        std::fprintf(stderr, "pellucid-bench: %s\n", error.what());
        return exitCode(task::ErrorCode::internal);
    }
    return 0;
}
