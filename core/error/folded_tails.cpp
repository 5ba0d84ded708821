// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error/folded_tails.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/scene/image_definition.h"

namespace pellucid::error {

namespace {

constexpr int directions = 64; // of half the plane
constexpr int side = 16;       // blocks of pixels along an axis

int directionOf(double u, double v) {
    const double angle = std::atan2(v, u) / std::numbers::pi; // opposite ones are alike
    return int((angle < 0.0 ? angle + 1.0 : angle) * directions) % directions;
}

// The mean of |A|^2 in each direction, in the half of the roll-off where it reduces little.
std::array<double, directions> edgeEnergies(const PictureSlice &slice, double rollOff) {
    std::array<double, directions> sums{}, counts{};
    const int columns = slice.columns(), rows = slice.rows();
    // At least two frequencies wide.
    const double width = std::max(0.5 * rollOff, 4.0 / std::min(columns, rows));
    const double first = std::max(0.0, 1.0 - rollOff - width), last = 1.0 - 0.5 * rollOff;
    for (int row = -rows / 2 + 1; row < rows / 2; ++row)
        for (int column = 0; column < columns / 2; ++column) {
            const double u = 2.0 * column / columns, v = 2.0 * row / rows,
                         radius = std::hypot(u, v);
            if (radius < first || radius > last)
                continue;
            const double factor = scene::rollOffFactor(rollOff, radius);
            const auto n = std::size_t(directionOf(u, v));
            sums[n] += slice.energy(column, row) / (factor * factor);
            counts[n] += 1.0;
        }
    // A small grid has no frequency in some directions.
    double all = 0.0, count = 0.0;
    for (std::size_t n = 0; n < sums.size(); ++n) {
        all += sums[n];
        count += counts[n];
    }
    for (std::size_t n = 0; n < sums.size(); ++n)
        sums[n] = counts[n] > 0.0 ? sums[n] / counts[n] : count > 0.0 ? all / count : 0.0;
    return sums;
}

struct Source {
    double x = 0.0, y = 0.0; ///< pixels
    double share = 0.0;
};

// Where second differences have their energy: they pass what the edge of the band has.
std::vector<Source> sourcesOf(const picture::PeriodPicture &period) {
    const int columns = period.image.width, rows = period.image.height;
    const auto channels = std::size_t(period.image.channels);
    std::array<Source, std::size_t(side) * side> blocks{};
    const auto at = [&](int row, int column, std::size_t c) {
        return double(
            period.image.samples[(std::size_t((row + rows) % rows) * std::size_t(columns) +
                                  std::size_t((column + columns) % columns)) *
                                     channels +
                                 c]);
    };
    double all = 0.0;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            double energy = 0.0;
            for (std::size_t c = 0; c < channels; ++c) {
                const double here = 2.0 * at(row, column, c),
                             across = at(row, column - 1, c) + at(row, column + 1, c) - here,
                             down = at(row - 1, column, c) + at(row + 1, column, c) - here;
                energy += across * across + down * down;
            }
            Source &block = blocks[std::size_t(row * side / rows) * side +
                                   std::size_t(column * side / columns)];
            block.x += energy * column;
            block.y += energy * row;
            block.share += energy;
            all += energy;
        }
    std::vector<Source> sources;
    for (const Source &block : blocks)
        if (block.share > 1e-9 * all)
            sources.push_back({block.x / block.share, block.y / block.share, block.share / all});
    return sources;
}

double tailAt(double r, double rollOff) {
    const double x = rollOff * r, beyond = x * x - 1.0,
                 fade = x > 1.0 ? std::min(1.0, 0.5 / (beyond * beyond)) : 1.0;
    return fade / (4.0 * std::numbers::pi * std::numbers::pi * r * r * r);
}

} // namespace

double foldedTailEnergy(const picture::PeriodPicture &period, const PictureSlice &slice,
                        double rollOff) {
    const auto edge = edgeEnergies(slice, rollOff);
    const auto sources = sourcesOf(period);
    const int columns = period.image.width, rows = period.image.height;
    const double area = double(period.width) * period.height / (double(side) * side);
    double sum = 0.0;
    for (int copyRow = -1; copyRow <= 1; ++copyRow)
        for (int copyColumn = -1; copyColumn <= 1; ++copyColumn) {
            if (copyRow == 0 && copyColumn == 0)
                continue;
            for (int row = 0; row < side; ++row)
                for (int column = 0; column < side; ++column) {
                    const double x = period.left + (column + 0.5) * period.width / side +
                                     copyColumn * columns,
                                 y = period.top + (row + 0.5) * period.height / side +
                                     copyRow * rows;
                    for (const Source &source : sources) {
                        const double u = x - source.x, v = y - source.y,
                                     r = std::max(1.0, std::hypot(u, v));
                        sum += source.share * area * edge[std::size_t(directionOf(u, v))] *
                               tailAt(r, rollOff);
                    }
                }
        }
    // |P|^2 is in units of the picture squared times mm^4, of a pixel's area squared.
    const double pixel = period.camera.pixelMm;
    return sum / (pixel * pixel);
}

} // namespace pellucid::error
