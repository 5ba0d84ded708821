// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cctype>
#include <limits>
#include <map>
#include <span>

#include <fmt/format.h>

#include "app/bench/report.h"
#include "core/files/atomic_file.h"
#include "core/task/error.h"

namespace pellucid::bench {

namespace {

void save(const std::filesystem::path &path, const std::string &text) {
    files::AtomicFile file(path);
    file.write(text);
    file.commit();
}

std::string escaped(const std::string &text) {
    std::string result;
    for (const char c : text)
        result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    return result;
}

std::string cell(const std::optional<double> &value, const char *format) {
    return "<td>" + (value ? fmt::format(fmt::runtime(format), *value) : std::string()) + "</td>";
}

std::string tableOf(const std::vector<Row> &rows) {
    std::string html =
        "<table><tr><th>case</th><th>size</th><th>kernel</th><th>taps</th><th>padding</th>"
        "<th>storage</th><th>threads</th><th>prepare ms</th><th>slice ms</th><th>transform ms</th>"
        "<th>frame ms</th><th>frames/s</th><th>MB</th><th>predicted</th><th>measured</th>"
        "<th>largest</th><th>PSNR dB</th><th>ray sum ms</th><th>its error</th>"
        "<th>shear-warp ms</th><th>note</th></tr>\n";
    for (const Row &r : rows) {
        const auto rate = r.frameMs ? std::optional(1000.0 / *r.frameMs) : std::nullopt;
        const auto megabytes = r.bytes ? std::optional(*r.bytes / 1048576.0) : std::nullopt;
        html += fmt::format("<tr><td>{}</td><td>{} x {} x {}</td><td>{}</td><td>{}</td>"
                            "<td>{:.2f}</td><td>{}</td><td>{}</td>",
                            escaped(r.name), r.size.i, r.size.j, r.size.k, escaped(r.kernel),
                            r.taps, r.padding, r.storage, r.threads);
        html += cell(r.prepareMs, "{:.1f}") + cell(r.sliceMs, "{:.3f}") +
                cell(r.transformMs, "{:.3f}") + cell(r.frameMs, "{:.3f}") + cell(rate, "{:.0f}") +
                cell(megabytes, "{:.0f}") + cell(r.predictedError, "{:.2e}") +
                cell(r.relativeL2, "{:.2e}") + cell(r.maxError, "{:.1e}") +
                cell(r.psnrDb, "{:.1f}") + cell(r.raySumMs, "{:.1f}") +
                cell(r.raySumRelativeL2, "{:.2e}") + cell(r.shearWarpMs, "{:.2f}");
        html += "<td class=\"note\">" + escaped(r.note) + "</td></tr>\n";
    }
    return html + "</table>\n";
}

// The field of a row: the name of its case without the setting.
std::string fieldOf(const Row &row) {
    std::string name = row.name;
    if (name.rfind("default ", 0) == 0)
        name.erase(0, std::string("default ").size());
    const auto comma = name.rfind(", "); // a tolerance, or "one thread"
    return comma == std::string::npos ? name : name.substr(0, comma);
}

// The rows that no other row beats in both time and error.
std::vector<const Row *> paretoFront(const std::vector<const Row *> &rows) {
    std::vector<const Row *> measured = rows;
    std::sort(measured.begin(), measured.end(),
              [](const Row *a, const Row *b) { return *a->frameMs < *b->frameMs; });
    std::vector<const Row *> front;
    double best = std::numeric_limits<double>::infinity();
    for (const Row *r : measured)
        if (*r->relativeL2 < best) {
            best = *r->relativeL2;
            front.push_back(r);
        }
    return front;
}

// A point of a plot: time, error, and the kernel, padding and storage.
std::string point(const Row &row) {
    return fmt::format("{} {} \"{} {:.3g} {}\"\n", *row.frameMs, *row.relativeL2, row.kernel,
                       row.padding, row.storage);
}

// Plots a suite's error against its time: one plot for each field with many rows, and one for all
// other fields together. A Pareto front belongs to one field.
std::vector<std::string> errorPlots(const std::filesystem::path &folder, const std::string &suite,
                                    const std::vector<Row> &rows, std::string &script) {
    constexpr std::size_t manyRows = 12;
    std::map<std::string, std::vector<const Row *>> fields;
    for (const Row &r : rows)
        if (r.frameMs && r.relativeL2 && *r.relativeL2 > 0.0)
            fields[fieldOf(r)].push_back(&r);
    std::vector<std::string> pictures;
    std::string together;
    int number = 0;
    for (const auto &[field, list] : fields) {
        const std::string base = fmt::format("{}_{}", suite, number++);
        std::map<std::string, std::string> families;
        std::string front;
        for (const Row *r : list) {
            std::string family = r->kernel;
            while (family.size() > 1 && std::isdigit(static_cast<unsigned char>(family.back())))
                family.pop_back();
            families[family] += point(*r);
        }
        for (const Row *r : paretoFront(list))
            front += point(*r);
        save(folder / (base + "_front.dat"), front);
        if (list.size() < manyRows) {
            together += fmt::format("{}'{}_front.dat' title \"{}\" with linespoints pt 7 ps 0.5",
                                    together.empty() ? "" : ", ", base, field);
            continue;
        }
        script += fmt::format("set output '{}.svg'\nset title \"{}: {}\"\n", base, suite, field);
        std::string plot;
        for (const auto &[family, points] : families) {
            save(folder / fmt::format("{}_{}.dat", base, family), points);
            plot += fmt::format("'{0}_{1}.dat' title '{1}' pt 7 ps 0.5, ", base, family);
        }
        script += "plot " + plot +
                  fmt::format("'{0}_front.dat' title 'Pareto front' with lines lc rgb 'black', "
                              "'{0}_front.dat' using 1:2:3 notitle with labels left offset 0.6,0.6 "
                              "font ',9'\n",
                              base);
        pictures.push_back(base);
    }
    if (!together.empty()) {
        script += fmt::format("set output '{0}.svg'\nset title '{0}'\nplot {1}\n", suite, together);
        pictures.push_back(suite);
    }
    return pictures;
}

// Plots time against size, with the fitted power of the size for each series.
std::string growthPlot(const std::filesystem::path &folder, const std::vector<Row> &rows) {
    std::string data;
    int sizes = 0;
    for (const Row &r : rows)
        if (r.suite == "scaling" && r.frameMs && r.raySumMs && r.shearWarpMs &&
            r.name.find("noise") != std::string::npos) {
            data += fmt::format("{} {} {} {}\n", r.size.i, *r.frameMs, *r.raySumMs, *r.shearWarpMs);
            ++sizes;
        }
    if (sizes < 2)
        return {};
    save(folder / "growth.dat", data);
    std::string script = "set output 'growth.svg'\nset title 'time against size'\nset logscale "
                         "xy\nset xlabel 'side, voxels'\n"
                         "set ylabel 'ms'\nset fit quiet\nset fit nolog\n";
    const char *const names[] = {"frame", "ray sum", "shear-warp sum"};
    for (int n = 0; n < 3; ++n)
        script +=
            fmt::format("f{0}(x) = a{0} + b{0} * x\na{0} = -8; b{0} = 2\n"
                        "fit f{0}(x) 'growth.dat' using (log($1)):(log(${1})) via a{0}, b{0}\n",
                        n, n + 2);
    script += "plot ";
    for (int n = 0; n < 3; ++n)
        script += fmt::format("{}'growth.dat' using 1:{} title '{}' pt 7 lc {}, "
                              "exp(f{}(log(x))) title sprintf('side^{{%.2f}}', b{}) lc {}",
                              n > 0 ? ", " : "", n + 2, names[n], n + 1, n, n, n + 1);
    return script + "\nunset logscale\n";
}

} // namespace

void makeReportFolder(const std::filesystem::path &folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw task::Error(task::ErrorCode::output, task::systemReason(error), folder);
}

void writeHtmlReport(const std::filesystem::path &folder, const Machine &machine,
                     const std::vector<Row> &rows) {
    makeReportFolder(folder);
    std::map<std::string, std::vector<Row>> suites;
    for (const Row &r : rows)
        suites[r.suite].push_back(r);
    std::string html = fmt::format(
        "<!doctype html><html><head><meta charset=\"utf-8\"><title>Pellucid: speed and "
        "error</title>"
        "<style>body{{font:13px sans-serif;margin:24px;color:#20262B}}"
        "table{{border-collapse:collapse}}td,th{{border-bottom:1px solid #ccc;padding:3px 8px;"
        "text-align:right}}td:first-child,td.note{{text-align:left}}td.note{{max-width:40em}}"
        "</style></head><body><h1>Speed and error</h1><p>{}, {} threads, {:.0f} GiB, {}</p>\n",
        escaped(machine.processor), machine.threads, machine.memoryGiB, escaped(machine.system));
    std::string script = "set terminal svg size 980,620 background rgb 'white'\nset grid\n"
                         "set key outside right\nset format y '%.0e'\n";
    for (const auto &[suite, list] : suites) {
        html += "<h2>" + escaped(suite) + "</h2>\n";
        script += "set logscale xy\nset xlabel 'frame, ms'\nset ylabel 'relative L2 error'\n";
        for (const std::string &picture : errorPlots(folder, suite, list, script))
            html += "<p><img src=\"" + picture + ".svg\" alt=\"error against time\"></p>\n";
        const std::string growth = growthPlot(folder, list);
        if (!growth.empty())
            html += "<p><img src=\"growth.svg\" alt=\"time against size\"></p>\n";
        script += growth;
        html += tableOf(list);
    }
    save(folder / "plots.gp", script);
    save(folder / "report.html", html + "</body></html>\n");
}

} // namespace pellucid::bench
