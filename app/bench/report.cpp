// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bench/report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/files/table_cell.h"

namespace pellucid::bench {

namespace {

using nlohmann::json;

std::optional<double> framesPerSecond(const Row &r) {
    return r.frameMs && *r.frameMs > 0.0 ? std::optional(1000.0 / *r.frameMs) : std::nullopt;
}

json figure(const std::optional<double> &value) {
    return value ? json(*value) : json(nullptr);
}

json rowJson(const Row &r) {
    return {{"suite", r.suite},
            {"case", r.name},
            {"n", {r.size.i, r.size.j, r.size.k}},
            {"engine", r.engine},
            {"kernel", r.kernel},
            {"taps", r.taps},
            {"padding", r.padding},
            {"storage", r.storage},
            {"threads", r.threads},
            {"prepare_ms", figure(r.prepareMs)},
            {"fft3d_ms", figure(r.fft3dMs)},
            {"slice_ms", figure(r.sliceMs)},
            {"transform_ms", figure(r.transformMs)},
            {"frame_ms", figure(r.frameMs)},
            {"fps", figure(framesPerSecond(r))},
            {"bytes", figure(r.bytes)},
            {"predicted_error", figure(r.predictedError)},
            {"rel_l2", figure(r.relativeL2)},
            {"max_error", figure(r.maxError)},
            {"psnr_db", figure(r.psnrDb)},
            {"ray_sum_ms", figure(r.raySumMs)},
            {"ray_sum_msamples_per_s", figure(r.raySumMsamplesPerSecond)},
            {"ray_sum_rel_l2", figure(r.raySumRelativeL2)},
            {"shear_warp_ms", figure(r.shearWarpMs)},
            {"submit_ms", figure(r.submitMs)},
            {"least_frame_ms", figure(r.leastFrameMs)},
            {"tolerance", figure(r.tolerance)},
            {"note", r.note}};
}

std::string cell(const std::optional<double> &value, const char *format) {
    return value ? fmt::format(fmt::runtime(format), *value) : std::string("-");
}

} // namespace

std::string tableHead(const Machine &machine) {
    constexpr const char *columns = "{:<34} {:>11} {:>12} {:>4} {:>7} {:>3} {:>8} {:>8} {:>9} "
                                    "{:>8} {:>6} {:>9} {:>9} {:>8} {:>6}\n";
    return fmt::format("{}, {} threads, {:.0f} GiB, {}\n\n", machine.processor, machine.threads,
                       machine.memoryGiB, machine.system) +
           fmt::format(fmt::runtime(columns), "case", "size", "kernel", "taps", "padding", "",
                       "prepare", "slice", "transform", "frame", "MB", "predicted", "measured",
                       "max", "PSNR") +
           fmt::format(fmt::runtime(columns), "", "", "", "", "", "", "ms", "ms", "ms", "ms", "",
                       "rel. L2", "rel. L2", "of peak", "dB");
}

std::string tableLine(const Row &r) {
    const auto megabytes = r.bytes ? std::optional(*r.bytes / 1048576.0) : std::nullopt;
    std::string text = fmt::format(
        "{:<34} {:>11} {:>12} {:>4} {:>7.2f} {:>3} {:>8} {:>8} {:>9} {:>8} {:>6} {:>9} {:>9} "
        "{:>8} {:>6}\n",
        r.name, fmt::format("{}x{}x{}", r.size.i, r.size.j, r.size.k), r.kernel, r.taps, r.padding,
        r.storage, cell(r.prepareMs, "{:.1f}"), cell(r.sliceMs, "{:.2f}"),
        cell(r.transformMs, "{:.2f}"), cell(r.frameMs, "{:.2f}"), cell(megabytes, "{:.0f}"),
        cell(r.predictedError, "{:.2e}"), cell(r.relativeL2, "{:.2e}"), cell(r.maxError, "{:.1e}"),
        cell(r.psnrDb, "{:.1f}"));
    if (r.raySumMs && r.name.rfind("default", 0) == 0) { // once per field
        text += fmt::format("    ray sum {:.1f} ms, rel. L2 {}", *r.raySumMs,
                            cell(r.raySumRelativeL2, "{:.2e}"));
        if (r.raySumMsamplesPerSecond)
            text += fmt::format(", {:.0f} million samples/s", *r.raySumMsamplesPerSecond);
        if (r.shearWarpMs)
            text += fmt::format("; shear-warp sum {:.2f} ms", *r.shearWarpMs);
        text += "\n";
    }
    if (!r.note.empty())
        text += "    " + r.note + "\n";
    return text;
}

std::string jsonText(const Machine &machine, const std::vector<Row> &rows) {
    json list = json::array();
    for (const Row &r : rows)
        list.push_back(rowJson(r));
    return json{{"machine",
                 {{"processor", machine.processor},
                  {"system", machine.system},
                  {"threads", machine.threads},
                  {"memory_gib", machine.memoryGiB}}},
                {"rows", list}}
        .dump(2);
}

std::string csvText(const std::vector<Row> &rows) {
    std::string text;
    for (const Row &r : rows) {
        json row = rowJson(r);
        row["n"] = fmt::format("{}x{}x{}", r.size.i, r.size.j, r.size.k);
        if (text.empty()) {
            for (const auto &[key, value] : row.items())
                text += (text.empty() ? "" : ",") + key;
            text += '\n';
        }
        std::string line;
        for (const auto &[key, value] : row.items())
            line +=
                (line.empty() ? "" : ",") +
                (value.is_null()     ? std::string()
                 : value.is_string() ? files::csvField(files::tableCell(value.get<std::string>()))
                                     : value.dump());
        text += line + '\n';
    }
    return text;
}

} // namespace pellucid::bench
