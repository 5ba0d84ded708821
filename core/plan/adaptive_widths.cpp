// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/adaptive_widths.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <tbb/parallel_for.h>

#include "core/plan/cost_model.h"

namespace pellucid::plan {

namespace {

constexpr int tileColumns = WidthMap::tileColumns, tileRows = WidthMap::tileRows;
// Margin for the errors by blocks, as energy. A tile whose error was underestimated is among the
// first to get a narrow kernel.
constexpr double blockMargin = 2.0;

using Errors = SpectrumEnergies::Errors;

// The tiles of a slice within the largest circle. The Nyquist row is on its edge, where the
// roll-off is 0.
struct Circle {
    explicit Circle(const SlicePlane &plane)
        : strips((plane.columns / 2 + tileColumns - 1) / tileColumns),
          tiles((plane.rows / 2 + tileRows - 1) / tileRows) {
        for (int strip = 0; strip < strips; ++strip) {
            const double u = 2.0 * tileColumns * strip / plane.columns;
            const double last = std::sqrt(std::max(0.0, 1.0 - u * u)) * plane.rows / 2.0;
            sides.push_back(std::min(tiles, int(std::ceil(last / tileRows))));
        }
    }

    int strips, tiles;      ///< tiles: on each side of row 0
    std::vector<int> sides; ///< of them within the circle, by strip
};

// Finds the tiles with enough energy to be read.
class Tiles {
public:
    struct Tile {
        int strip = 0, row = 0; ///< row: of the tile, from -tiles to tiles - 1
        /// The error of all its frequencies together, by entry, as shares of the budget. Infinite
        /// where the frequencies are low, which the widest kernel always reads.
        Errors errors{};
    };

    // A source and what is known of its spectrum.
    struct Measured {
        SliceSource source;
        const SpectrumEnergies *energies = nullptr;
    };

    // The tiles of a few strips.
    struct Found {
        std::vector<Tile> bright;
        double leftOutError = 0.0; ///< of the others
        // By source, of the last patch.
        std::vector<Errors> errors;
        std::vector<std::array<double, 3>> amplitudes;
    };

    Tiles(const SlicePlane &plane, const Circle &circle, std::vector<Measured> sources, int widest,
          double budget)
        : m_circle(circle), m_sources(std::move(sources)), m_patch{plane.perColumn, plane.perRow,
                                                                   tileColumns, tileRows},
          m_points(m_patch), m_entries(SpectrumEnergies::entryOf(widest)),
          m_area(2.0 * tileColumns * tileRows * plane.columnPerMm * plane.rowPerMm * blockMargin /
                 budget),
          m_dark(darkShare / (2.0 * circle.strips * circle.tiles)) {}

    int parts() const { return (m_circle.strips + groupSide - 1) / groupSide; }
    // Room for the tiles of a part: `find` takes no more memory.
    Found room() const {
        Found found;
        found.bright.reserve(2 * std::size_t(groupSide) * std::size_t(m_circle.tiles));
        found.errors.resize(m_sources.size());
        found.amplitudes.resize(m_sources.size());
        return found;
    }
    void find(int part, Found &found) const {
        for (int row = -m_circle.tiles; row < m_circle.tiles; row += groupSide)
            addGroup(part * groupSide, row, found);
    }

private:
    // Tiles that together take less than this share of the budget are not measured.
    static constexpr double darkShare = 0.02;
    // Tiles are tried together first.
    static constexpr int groupSide = 4;

    void addGroup(int firstStrip, int firstRow, Found &found) const {
        const int lastStrip = std::min(firstStrip + groupSide, m_circle.strips);
        const int side = m_circle.sides[std::size_t(firstStrip)];
        if (firstRow >= side || firstRow + groupSide <= -side)
            return;
        PlanePatch group = patchAt(firstStrip, firstRow);
        group.columns *= groupSide;
        group.rows *= groupSide;
        if (!isLow(group)) {
            if (const double bound = boundOf(group, found); bound <= m_dark) {
                found.leftOutError += groupSide * groupSide * bound;
                return;
            }
        }
        for (int strip = firstStrip; strip < lastStrip; ++strip) {
            const int tiles = m_circle.sides[std::size_t(strip)];
            for (int row = std::max(firstRow, -tiles); row < std::min(firstRow + groupSide, tiles);
                 ++row)
                addTile(strip, row, found);
        }
    }

    void addTile(int strip, int row, Found &found) const {
        Tile tile{strip, row, {}};
        const PlanePatch patch = patchAt(strip, row);
        if (isLow(patch)) {
            tile.errors.fill(std::numeric_limits<float>::infinity());
        } else if (const double bound = boundOf(patch, found); bound <= m_dark) {
            found.leftOutError += bound;
            return;
        } else {
            for (std::size_t s = 0; s < m_sources.size(); ++s)
                found.errors[s] =
                    m_sources[s].energies->errorsIn(offsetBy(patch, m_sources[s].source), m_points);
            for (std::size_t n = 0; n <= m_entries; ++n)
                tile.errors[n] = float(sumOf(n, found));
        }
        found.bright.push_back(tile);
    }

    PlanePatch patchAt(int strip, int row) const {
        PlanePatch patch = m_patch;
        patch.firstColumn = double(strip) * tileColumns - 0.5;
        patch.firstRow = double(row) * tileRows - 0.5;
        return patch;
    }

    // Whether some point of a patch is so close to frequency 0, in some source, that blocks are too
    // coarse for it.
    bool isLow(const PlanePatch &patch) const {
        return std::any_of(m_sources.begin(), m_sources.end(), [&](const Measured &measured) {
            const PlanePatch moved = offsetBy(patch, measured.source);
            double distance = 0.0; // the largest along any axis, at least
            for (std::size_t d = 0; d < 3; ++d)
                distance = std::max(distance, std::abs(moved.middle(d)) - moved.reach(d));
            return distance < SpectrumEnergies::lowCells;
        });
    }

    static PlanePatch offsetBy(PlanePatch patch, const SliceSource &source) {
        patch.offset = source.offset;
        return patch;
    }

    double boundOf(const PlanePatch &patch, Found &found) const {
        for (std::size_t s = 0; s < m_sources.size(); ++s) {
            found.errors[s][0] =
                m_sources[s].energies->energyBound(offsetBy(patch, m_sources[s].source));
            for (std::size_t c = 0; c < 3; ++c)
                found.amplitudes[s][c] = amplitudeOf(m_sources[s], patch, c);
        }
        return sumOf(0, found);
    }

    // Amplitudes of fields without negative samples add up, and so do those of their errors at
    // worst.
    double sumOf(std::size_t entry, const Found &found) const {
        if (m_sources.size() == 1) {
            const auto &a = found.amplitudes.front();
            return m_area * (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) *
                   double(found.errors.front()[entry]);
        }
        std::array<double, 3> amplitudes{};
        for (std::size_t s = 0; s < m_sources.size(); ++s) {
            const double error = std::sqrt(double(found.errors[s][entry]));
            for (std::size_t c = 0; c < 3; ++c)
                amplitudes[c] += found.amplitudes[s][c] * error;
        }
        double sum = 0.0;
        for (const double amplitude : amplitudes)
            sum += amplitude * amplitude;
        return m_area * sum;
    }

    // The most that a source is multiplied by in a patch.
    static double amplitudeOf(const Measured &measured, const PlanePatch &patch, std::size_t c) {
        const SliceSource &source = measured.source;
        double amplitude = source.amplitude[c];
        for (std::size_t d = 0; d < 3; ++d) {
            if (source.perSine[c][d] == 0.0)
                continue;
            const double perCell = 2.0 * std::numbers::pi / measured.energies->padded()[int(d)];
            const double middle = patch.middle(d) + source.offset[d];
            amplitude += source.perSine[c][d] * std::min(1.0, std::abs(std::sin(perCell * middle)) +
                                                                  perCell * patch.reach(d));
        }
        return amplitude;
    }

    const Circle &m_circle;
    std::vector<Measured> m_sources;
    PlanePatch m_patch;
    PatchPoints m_points;
    std::size_t m_entries; ///< the last that is used
    double m_area;         ///< of a tile in both halves of the plane, over the budget
    double m_dark;
};

// The widths of a tile on the convex hull of time against error, from the widest kernel on: each
// adds more error per unit of time saved than the one before.
class Savings {
public:
    struct Saving {
        std::uint16_t price = 0; ///< a class
        std::uint8_t width = 0;
        float error = 0.0F; ///< that it adds
    };

    // *Units*: errors as shares of the budget.
    Savings(int widest, const Errors &errors, AdaptiveWidths::Reduction reduction) {
        int from = widest;
        float error = 0.0F;
        while (from > 0) {
            Saving best;
            float cheapest = std::numeric_limits<float>::infinity();
            const int first =
                reduction == AdaptiveWidths::Reduction::narrowerKernels ? from - 1 : 0;
            for (int width = first; width >= 0; --width) {
                if (width == 1) // no kernel has it
                    continue;
                const float more = std::max(0.0F, errors[SpectrumEnergies::entryOf(width)] - error);
                const float price = more / float(readTime(from) - readTime(width));
                if (price <= cheapest) {
                    cheapest = price;
                    best = {classOf(price), std::uint8_t(width), more};
                }
            }
            m_savings[m_count++] = best;
            error += best.error;
            from = best.width;
        }
    }
    std::span<const Saving> all() const { return std::span(m_savings).first(m_count); }

    // Exponent and first four bits: 16 classes an octave.
    static constexpr std::size_t classes = 1U << 12U;

private:
    static std::uint16_t classOf(float price) {
        return std::uint16_t(std::bit_cast<std::uint32_t>(price) >> 19U);
    }

    std::array<Saving, fourier::Kernel::largestWidth> m_savings;
    std::size_t m_count = 0;
};

} // namespace

WidthMap::Shares WidthMap::shares(const SlicePlane &plane) const {
    Shares shares{};
    const Circle circle(plane);
    double all = 0.0;
    for (int column = 0; column < circle.strips; ++column)
        for (int row = -circle.sides[std::size_t(column)]; row < circle.sides[std::size_t(column)];
             ++row, all += 1.0)
            shares[strip(column)[std::size_t(row + tiles)]] += 1.0;
    for (double &share : shares)
        share /= all;
    return shares;
}

void inOrder(int count, const std::function<void(int)> &work) {
    for (int n = 0; n < count; ++n)
        work(n);
}

void onAllThreads(int count, const std::function<void(int)> &work) {
    tbb::parallel_for(0, count, work);
}

WidthMap AdaptiveWidths::mapFor(const glm::dmat3 &axes, const SlicePlane &plane,
                                std::span<const Weights> weights, const ForEach &forEach) const {
    double minEnergy = 0.0;
    std::vector<SliceSource> sources;
    for (std::size_t f = 0; f < m_fields.size(); ++f) {
        if (weights[f] == Weights{})
            continue;
        SliceSource source{.field = f};
        for (std::size_t c = 0; c < 3; ++c) {
            source.amplitude[c] = std::abs(weights[f][c]);
            minEnergy += weights[f][c] * weights[f][c] * m_fields[f]->minEnergy(axes);
        }
        // One channel's amplitudes are enough for a single field.
        if (m_fields.size() == 1)
            source.amplitude = {std::hypot(weights[f][0], weights[f][1], weights[f][2]), 0.0, 0.0};
        sources.push_back(source);
    }
    return mapFor(plane, sources, minEnergy, Reduction::narrowerKernels, forEach);
}

WidthMap AdaptiveWidths::mapFor(const SlicePlane &plane, std::span<const SliceSource> sources,
                                double minEnergy, Reduction reduction,
                                const ForEach &forEach) const {
    const Circle circle(plane);
    // Where little is known to be in the picture, everything is read.
    const double budget =
        std::max(m_tolerance * m_tolerance * minEnergy, std::numeric_limits<double>::min());
    std::vector<Tiles::Measured> measured;
    for (const SliceSource &source : sources)
        measured.push_back(
            {source, (source.isGradient ? m_gradients : m_fields)[source.field].get()});
    const Tiles tiles(plane, circle, std::move(measured), m_kernels->widest(), budget);
    struct Part {
        Tiles::Found found;
        std::vector<Savings> savings; ///< of the bright tiles
    };
    std::vector<Part> parts(std::size_t(tiles.parts()));
    for (Part &part : parts) {
        part.found = tiles.room();
        part.savings.reserve(part.found.bright.capacity());
    }
    forEach(tiles.parts(), [&](int n) {
        Part &part = parts[std::size_t(n)];
        tiles.find(n, part.found);
        for (const Tiles::Tile &tile : part.found.bright)
            part.savings.emplace_back(m_kernels->widest(), tile.errors, reduction);
    });
    std::vector<double> errors(Savings::classes, 0.0);
    double leftOutError = 0.0;
    for (const Part &part : parts) {
        leftOutError += part.found.leftOutError;
        for (const Savings &savings : part.savings)
            for (const Savings::Saving &saving : savings.all())
                errors[saving.price] += double(saving.error);
    }
    // The first class that the budget does not pay in full.
    double spent = leftOutError;
    std::size_t limit = 0;
    while (limit < errors.size() && spent + errors[limit] <= 1.0)
        spent += errors[limit++];

    WidthMap map{.tiles = circle.tiles,
                 .estimatedError = m_tolerance * std::sqrt(spent),
                 .unmeasuredEnergy = budget * leftOutError};
    const auto perStrip = 2 * std::size_t(circle.tiles);
    map.widths.resize(std::size_t(circle.strips) * perStrip, 0);
    map.errors.resize(map.widths.size(), 0.0F);
    for (const Part &part : parts)
        for (std::size_t n = 0; n < part.savings.size(); ++n) {
            const Tiles::Tile &tile = part.found.bright[n];
            int width = m_kernels->widest();
            float error = 0.0F;
            for (const Savings::Saving &saving : part.savings[n].all()) {
                if (saving.price >= limit)
                    break;
                width = saving.width;
                error += saving.error;
            }
            const std::size_t at =
                std::size_t(tile.strip) * perStrip + std::size_t(tile.row + circle.tiles);
            map.widths[at] = std::uint8_t(width);
            map.errors[at] = error;
            if (width > 0)
                map.strips = std::max(map.strips, tile.strip + 1);
        }
    return map;
}

} // namespace pellucid::plan
