// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/volume/lattice.h"

namespace pellucid::bench {

/// The machine of a run.
struct Machine {
    std::string processor, system;
    int threads = 1;
    double memoryGiB = 0.0;
};
Machine thisMachine();

/// One measurement: time and error. Figures that were not measured stay empty.
struct Row {
    std::string suite, name;
    volume::GridSize size;
    std::string engine, kernel;
    int taps = 0;
    double padding = 0.0;
    std::string storage;
    int threads = 1;
    std::optional<double> prepareMs = {}, fft3dMs = {}, sliceMs = {}, transformMs = {},
                          frameMs = {};
    std::optional<double> bytes = {}, predictedError = {}, relativeL2 = {}, maxError = {},
                          psnrDb = {};
    std::optional<double> raySumMs = {}, raySumMsamplesPerSecond = {}, raySumRelativeL2 = {},
                          shearWarpMs = {};
    /// On a card: the time to submit a frame, and the time of a frame of one pixel.
    std::optional<double> submitMs = {}, leastFrameMs = {};
    std::optional<double> tolerance = {};
    std::string note = {};
};

/// A readable table, line by line.
std::string tableHead(const Machine &machine);
std::string tableLine(const Row &row);
/// {"machine": ..., "rows": [...]}; a figure that was not measured is null.
std::string jsonText(const Machine &machine, const std::vector<Row> &rows);
std::string csvText(const std::vector<Row> &rows);
/// Creates the folder of a report if it does not exist. *Throws* Error{output}.
void makeReportFolder(const std::filesystem::path &folder);
/// Writes report.html, the data of its plots, and plots.gp, from which gnuplot draws them. *Throws*
/// Error{output}.
void writeHtmlReport(const std::filesystem::path &folder, const Machine &machine,
                     const std::vector<Row> &rows);

} // namespace pellucid::bench
