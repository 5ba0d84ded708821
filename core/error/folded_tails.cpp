// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error/folded_tails.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <tbb/parallel_for.h>

namespace pellucid::error {

namespace {

constexpr int directions = 64; // of half the plane
constexpr int side = 16;       // blocks of pixels along an axis

int directionOf(double u, double v) {
    const double angle = std::atan2(v, u) / std::numbers::pi; // opposite ones are alike
    return int((angle < 0.0 ? angle + 1.0 : angle) * directions) % directions;
}

// |A|^2 in a direction, in the half of the roll-off where it reduces little.
struct EdgeEnergy {
    double mean = 0.0, most = 0.0;
};
std::array<EdgeEnergy, directions> edgeEnergies(const PictureSlice &slice, double rollOff) {
    std::array<EdgeEnergy, directions> edge;
    std::array<double, directions> counts{};
    const int columns = slice.columns(), rows = slice.rows();
    // At least two frequencies wide.
    const double width = std::max(0.5 * rollOff, 4.0 / std::min(columns, rows));
    const double first = std::max(0.0, 1.0 - rollOff - width), last = 1.0 - 0.5 * rollOff;
    for (int row = -rows / 2 + 1; row < rows / 2; ++row)
        for (int column = 0; column < columns / 2; ++column) {
            const double u = 2.0 * column / columns, v = 2.0 * row / rows,
                         radius = std::sqrt(u * u + v * v);
            const double factor = scene::rollOffFactor(rollOff, radius);
            if (radius < first || radius > last || factor == 0.0)
                continue;
            const auto n = std::size_t(directionOf(u, v));
            const double energy = slice.energy(column, row) / (factor * factor);
            edge[n].mean += energy;
            edge[n].most = std::max(edge[n].most, energy);
            counts[n] += 1.0;
        }
    // A small grid has no frequency in some directions.
    EdgeEnergy all;
    double count = 0.0;
    for (std::size_t n = 0; n < edge.size(); ++n) {
        all = {all.mean + edge[n].mean, std::max(all.most, edge[n].most)};
        count += counts[n];
    }
    for (std::size_t n = 0; n < edge.size(); ++n)
        if (counts[n] > 0.0)
            edge[n].mean /= counts[n];
        else if (count > 0.0)
            edge[n] = {all.mean / count, all.most};
    // A regular pattern of n pixels is bright over 2/n radians of the edge, which may be two
    // directions, and the sources of a block are not all in its middle.
    const auto alone = edge;
    for (std::size_t n = 0; n < edge.size(); ++n)
        for (const std::size_t next : {n + 1, n + directions - 1})
            edge[n].most = std::max(edge[n].most, alone[next % directions].most);
    return edge;
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
    // A row of blocks at a time.
    tbb::parallel_for(0, side, [&](int blockRow) {
        const auto firstOf = [&](int block) { return (block * rows + side - 1) / side; };
        for (int row = firstOf(blockRow); row < firstOf(blockRow + 1); ++row) {
            const auto at = [&](int r) {
                return period.image.samples.data() +
                       std::size_t((r + rows) % rows) * std::size_t(columns) * channels;
            };
            const float *const above = at(row - 1), *const here = at(row),
                               *const below = at(row + 1);
            for (int column = 0; column < columns; ++column) {
                const auto left = std::size_t(column > 0 ? column - 1 : columns - 1) * channels,
                           middle = std::size_t(column) * channels,
                           right = std::size_t(column + 1 < columns ? column + 1 : 0) * channels;
                double energy = 0.0;
                for (std::size_t c = 0; c < channels; ++c) {
                    const double twice = 2.0 * double(here[middle + c]),
                                 across = double(here[left + c]) + double(here[right + c]) - twice,
                                 down =
                                     double(above[middle + c]) + double(below[middle + c]) - twice;
                    energy += across * across + down * down;
                }
                Source &block =
                    blocks[std::size_t(blockRow) * side + std::size_t(column * side / columns)];
                block.x += energy * column;
                block.y += energy * row;
                block.share += energy;
            }
        }
    });
    double all = 0.0;
    for (const Source &block : blocks)
        all += block.share;
    std::vector<Source> sources;
    for (const Source &block : blocks)
        if (block.share > 1e-9 * all)
            sources.push_back({block.x / block.share, block.y / block.share, block.share / all});
    return sources;
}

double fade(double x) {
    const double beyond = x * x - 1.0;
    return x > 1.0 ? std::min(1.0, 0.5 / (beyond * beyond)) : 1.0;
}

// The band of the lattice along one of its axes, as a picture shows it.
struct LatticeBand {
    glm::dvec2 along{0.0};     ///< the projected axis, of length 1; y downward
    double samplePixels = 0.0; ///< the length of its projected step
    double energy = 0.0;       ///< |A|^2 in the roll-off, summed across
};

std::vector<LatticeBand> latticeBands(const picture::PeriodPicture &period,
                                      const PictureSlice &slice,
                                      const scene::ImageDefinition &image,
                                      const volume::Lattice &lattice) {
    std::vector<LatticeBand> bands;
    if (image.reconstruction != scene::Reconstruction::bandLimited)
        return bands;
    const glm::dmat3 axes = period.camera.axes();
    const double pixel = period.camera.pixelMm;
    for (int d = 0; d < 3; ++d) {
        const glm::dvec2 step(glm::dot(lattice.step(d), axes[0]) / pixel,
                              -glm::dot(lattice.step(d), axes[1]) / pixel);
        LatticeBand band{glm::normalize(step), glm::length(step), 0.0};
        if (band.samplePixels <= 1.0)
            continue; // its band ends beyond that of the picture
        // As for the disc, the half of the roll-off that reduces little, and as much before it.
        const double first = 1.0 - 1.5 * image.rollOff, last = 1.0 - 0.5 * image.rollOff;
        slice.forEach([&](int column, int row, double weight, double radius) {
            const double turns = step.x * column / slice.columns() + step.y * row / slice.rows(),
                         q = 2.0 * std::abs(turns);
            const double factor = scene::rollOffFactor(image.rollOff, q);
            if (radius >= 1.0 - image.rollOff || q < first || q > last || factor == 0.0)
                return;
            band.energy += weight * slice.energy(column, row) / (factor * factor);
        });
        // From the sum over the grid to the integral across, at one frequency along.
        const double width = (last - first) * 0.5 / band.samplePixels;
        band.energy /= width * double(slice.columns()) * slice.rows();
        bands.push_back(band);
    }
    return bands;
}

} // namespace

FoldedTails foldedTails(const picture::PeriodPicture &period, const PictureSlice &slice,
                        const scene::ImageDefinition &image, const volume::Lattice &lattice) {
    const auto edge = edgeEnergies(slice, image.rollOff);
    const auto bands = latticeBands(period, slice, image, lattice);
    const auto sources = sourcesOf(period);
    const double width = double(period.width) / side, height = double(period.height) / side;
    // The energy of the tails of one copy of the sources in a block of the picture around (x, y).
    const auto tailsAt = [&](double x, double y) {
        FoldedTails sum;
        for (const Source &source : sources) {
            const glm::dvec2 away(x - source.x, y - source.y);
            const double r = std::max(1.0, glm::length(away));
            const EdgeEnergy &there = edge[std::size_t(directionOf(away.x, away.y))];
            const double fading =
                fade(image.rollOff * r) / (4.0 * std::numbers::pi * std::numbers::pi * r * r * r);
            double ofBands = 0.0;
            for (const LatticeBand &band : bands) {
                const double along = std::max(1.0, std::abs(glm::dot(away, band.along))),
                             across = std::abs(away.x * band.along.y - away.y * band.along.x),
                             half = 0.5 * (width * std::abs(band.along.y) +
                                           height * std::abs(band.along.x) + 1.0);
                if (across < half)
                    ofBands += band.energy * fade(image.rollOff * along / band.samplePixels) /
                               (4.0 * std::numbers::pi * std::numbers::pi * along * along) /
                               (2.0 * half);
            }
            const double pixels = source.share * width * height;
            sum.expected += pixels * (there.mean * fading + ofBands);
            sum.most += pixels * (there.most * fading + ofBands);
        }
        return sum;
    };
    std::array<FoldedTails, side> ofRows;
    tbb::parallel_for(0, side, [&](int row) {
        FoldedTails &tails = ofRows[std::size_t(row)];
        for (int column = 0; column < side; ++column) {
            double amplitudes = 0.0;
            for (int down = -1; down <= 1; ++down)
                for (int across = -1; across <= 1; ++across) {
                    if (down == 0 && across == 0)
                        continue;
                    const FoldedTails energy =
                        tailsAt(period.left + (column + 0.5) * width + across * period.image.width,
                                period.top + (row + 0.5) * height + down * period.image.height);
                    tails.expected += energy.expected;
                    amplitudes += std::sqrt(energy.most);
                }
            tails.most += 2.0 * amplitudes * amplitudes;
        }
    });
    FoldedTails tails;
    for (const FoldedTails &row : ofRows) {
        tails.expected += row.expected;
        tails.most += row.most;
    }
    // |P|^2 is in units of the picture squared times mm^4, of a pixel's area squared.
    const double pixel = period.camera.pixelMm;
    tails.expected /= pixel * pixel;
    tails.most /= pixel * pixel;
    return tails;
}

} // namespace pellucid::error
