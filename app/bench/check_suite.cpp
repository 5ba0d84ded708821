// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/bench/suites.h"
#include "core/error/exact_frequencies.h"
#include "core/phantom/phantom.h"

namespace pellucid::bench {

namespace {

constexpr int repeats = 5, compared = 4;

// Frequencies of a slice in a general direction, within the band of the finest step.
std::vector<glm::dvec3> frequenciesOf(const volume::Lattice &lattice, int count) {
    const glm::dmat3 axes(glm::mat3_cast(randomViews(1).front()));
    const double band = 0.5 / lattice.shortestStepMm();
    std::mt19937 random(1);
    std::uniform_real_distribution<double> within(-band, band);
    std::vector<glm::dvec3> frequencies;
    for (int n = 0; n < count; ++n) {
        const double u = within(random), v = within(random);
        frequencies.push_back(u * axes[0] + v * axes[1]);
    }
    return frequencies;
}

// The same sum in double precision, sample by sample.
std::complex<double> summedSlowly(const volume::Field &field, const glm::dvec3 &frequency) {
    const volume::Lattice &lattice = field.lattice();
    const volume::GridSize size = lattice.size();
    const auto phase = [&](const glm::dvec3 &mm) {
        return std::polar(1.0, -2.0 * std::numbers::pi * glm::dot(frequency, mm));
    };
    std::vector<std::complex<double>> along;
    for (int i = 0; i < size.i; ++i)
        along.push_back(phase(double(i) * lattice.step(0)));
    std::vector<float> buffer(std::size_t(size.i));
    std::complex<double> sum = 0.0;
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j) {
            const float *const samples = field.row({0, j, k}, size.i, buffer.data());
            std::complex<double> row = 0.0;
            for (std::size_t i = 0; i < along.size(); ++i)
                row += double(samples[i]) * along[i];
            sum +=
                row * phase(lattice.patient(volume::VoxelIndex{0, j, k}).mm - lattice.center().mm);
        }
    return lattice.cellVolumeMm3() * sum;
}

Row measureSums(const volume::GridSize &size, int count) {
    const Subject subject = phantomSubject("chest", phantom::Kind::chest, {.size = size});
    const volume::Lattice &lattice = subject.field.values.lattice();
    const std::array<double, 3> white{1.0, 1.0, 1.0};
    const error::ShownRows rows({&subject.field, 1}, {&white, 1}, {},
                                glm::dmat3(glm::mat3_cast(randomViews(1).front())),
                                shading::shadingScale(lattice));
    const std::vector<glm::dvec3> frequencies = frequenciesOf(lattice, count);
    std::vector<double> times;
    std::vector<std::vector<std::complex<double>>> sums;
    for (int n = 0; n < repeats; ++n) {
        const double start = millisecondsNow();
        sums = error::exactFrequencies(rows, frequencies);
        times.push_back(millisecondsNow() - start);
    }
    double worst = 0.0;
    for (int n = 0; n < compared; ++n)
        worst = std::max(worst,
                         std::abs(sums[0][std::size_t(n)] -
                                  summedSlowly(subject.field.values, frequencies[std::size_t(n)])));
    Row row;
    row.suite = "check";
    row.name = fmt::format("chest, {} frequencies", count);
    row.size = size;
    row.threads = thisMachine().threads;
    row.frameMs = median(times);
    row.maxError = worst / std::abs(summedSlowly(subject.field.values, glm::dvec3(0.0)));
    return row;
}

} // namespace

void runCheckSuite(const Report &report) {
    report(measureSums({256, 256, 256}, 256));
    report(measureSums({512, 512, 512}, 64));
    report(measureSums({512, 512, 800}, 64));
}

} // namespace pellucid::bench
