// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/widths/choose_widths.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/plan/cost_model.h"

namespace pellucid::widths {

namespace {

// Lines that are measured in a slice, in pairs from one stratum.
constexpr int linesDrawn = 64;
// The margin of the estimated error, in standard errors: 1 of 740 normal estimates exceeds it.
constexpr double standardErrors = 3.0;
// If none of n lines is bright, at most this many in n of all lines are, with 99 % confidence:
// -ln .01.
constexpr double unseenLines = 4.6;

struct Drawn {
    SliceLine line;
    double energy = 0.0; ///< of its tile
    double weight = 0.0; ///< of its errors in the sum of all
};

class Drawing {
public:
    Drawing(const SliceTiles &tiles, std::span<const float> energies, double budgetPerFrequency)
        : m_tiles(tiles), m_energies(energies), m_budgetPerFrequency(budgetPerFrequency) {
        double all = 0.0, roots = 0.0;
        tiles.forEach([&](int strip, int tile) {
            const double energy = energyOf(strip, tile);
            all += evenly(energy);
            roots += std::sqrt(energy);
        });
        m_perRoot = all > 0.0 ? all / roots : 0.0;
        m_all = 2.0 * all;
    }

    std::vector<Drawn> draw() const {
        std::vector<Drawn> drawn;
        double passed = 0.0;
        const auto place = [&] { return (double(drawn.size()) + 0.5) / linesDrawn * m_all; };
        m_tiles.forEach([&](int strip, int tile) {
            const double energy = energyOf(strip, tile), chance = chanceOf(energy);
            while (chance > 0.0 && place() <= passed + chance) {
                // All lines of a tile are equally likely.
                const int first = std::min(int((place() - passed) / chance * SliceTiles::rows),
                                           SliceTiles::rows - 1);
                drawn.push_back({{strip, tile, first, rises[std::size_t(strip + tile) & 3U]},
                                 energy,
                                 SliceTiles::rows * m_all / (chance * linesDrawn)});
            }
            passed += chance;
        });
        return drawn;
    }

private:
    // These rises put one frequency in each row and spread all 16 best.
    static constexpr std::array<int, 4> rises{3, 5, 11, 13};

    // 0 in the tiles that the widest kernel always reads.
    double energyOf(int strip, int tile) const {
        return SliceTiles::isCentral(strip, tile) ? 0.0
                                                  : double(m_energies[m_tiles.at(strip, tile)]);
    }
    // In the best choice, tiles with much more energy than the budget have about equal errors, and
    // tiles with much less are left out.
    double evenly(double energy) const {
        return energy > 0.0 ? energy / (energy + m_budgetPerFrequency) : 0.0;
    }
    // The other half of the lines finds a few tiles that are much brighter than the rest. See
    // REFERENCES.md, eq. 6.
    double chanceOf(double energy) const { return evenly(energy) + m_perRoot * std::sqrt(energy); }

    const SliceTiles &m_tiles;
    std::span<const float> m_energies;
    double m_budgetPerFrequency;
    double m_all = 0.0;     ///< the chances of all tiles together
    double m_perRoot = 0.0; ///< c of eq. 6
};

// A narrower width.
struct Step {
    int width = 0;
    double share = 0.0;     ///< its error over that of leaving the lines out
    double perEnergy = 0.0; ///< the error that it adds for each unit of time saved
};

// The convex hull of time against error, from the widest kernel on: each step adds more error per
// unit of time saved than the one before.
std::vector<Step> stepsFor(std::span<const Drawn> drawn, std::span<const ErrorsByWidth> errors,
                           double budgetPerFrequency, std::span<const int> widths) {
    ErrorsByWidth shares{};
    for (std::size_t n = 0; n < drawn.size(); ++n)
        for (const int width : widths)
            shares[std::size_t(width)] +=
                errors[n][std::size_t(width)] / (drawn[n].energy + budgetPerFrequency);
    std::vector<Step> steps;
    for (auto from = widths.size() - 1; from > 0;) {
        Step best;
        std::size_t next = 0;
        for (std::size_t to = from; to-- > 0;) {
            const auto width = std::size_t(widths[to]), wider = std::size_t(widths[from]);
            const double price = std::max(0.0, shares[width] - shares[wider]) /
                                 (plan::readTime(int(wider)) - plan::readTime(int(width)));
            if (to + 1 == from || price <= best.perEnergy) {
                best = {int(width), shares.front() > 0.0 ? shares[width] / shares.front() : 1.0,
                        price};
                next = to;
            }
        }
        steps.push_back(best);
        from = next;
    }
    return steps;
}

// The error that a line adds to a choice.
struct LineError {
    double measured = 0.0;
    double unseen = 0.0; ///< if the line is as bright as the table has it
};

// An upper limit on a choice's error, estimated from the lines as their widths become narrower.
class Estimate {
public:
    explicit Estimate(std::size_t lines) : m_lines(lines + lines % 2) {}
    void add(std::size_t line, const LineError &more) {
        LineError &of = m_lines[line];
        const double apart = of.measured - m_lines[line ^ 1U].measured;
        // By how much the square of a sum grows.
        const auto growth = [](double sum, double by) { return by * (2.0 * sum + by); };
        m_sum += more.measured;
        // The sum of a pair from one stratum has this variance.
        m_spread += growth(apart, more.measured);
        m_unseen += more.unseen;
        m_unseenSquares += growth(of.unseen, more.unseen);
        of.measured += more.measured;
        of.unseen += more.unseen;
        // The mean error of the lines that matter, each weighted by its own.
        if (m_unseen > 0.0)
            m_largestUnseen = std::max(m_largestUnseen, m_unseenSquares / m_unseen);
    }
    // If all lines are dark by chance, others may be as bright as the table has them.
    double limit() const {
        return m_sum + std::max(standardErrors * std::sqrt(std::max(m_spread, 0.0)),
                                unseenLines * m_largestUnseen);
    }

private:
    std::vector<LineError> m_lines;
    double m_sum = 0.0, m_unseen = 0.0, m_largestUnseen = 0.0;
    double m_spread = 0.0, m_unseenSquares = 0.0; ///< sums of squares
};

} // namespace

WidthMap chooseWidths(const SliceTiles &tiles, std::span<const float> energies, double budget,
                      std::span<const int> widths, const MeasureLines &measure) {
    const double budgetPerFrequency =
        budget / (2.0 * double(tiles.count()) * SliceTiles::rows * SliceTiles::columns);
    const std::vector<Drawn> drawn = Drawing(tiles, energies, budgetPerFrequency).draw();
    std::vector<SliceLine> lines;
    for (const Drawn &of : drawn)
        lines.push_back(of.line);
    const std::vector<ErrorsByWidth> errors = measure(lines);
    const std::vector<Step> steps = stepsFor(drawn, errors, budgetPerFrequency, widths);

    // The lines become narrower in the order of their prices.
    struct Change {
        double price = 0.0;
        LineError error;
        std::size_t line = 0;
    };
    std::vector<Change> changes;
    for (std::size_t n = 0; n < drawn.size(); ++n) {
        const auto &[line, energy, weight] = drawn[n];
        const double all = 2.0 * SliceTiles::columns * weight * energy;
        double before = 0.0, shareBefore = 0.0;
        for (const Step &step : steps) {
            const double error = errors[n][std::size_t(step.width)];
            changes.push_back(
                {step.perEnergy * energy,
                 {weight * (error - before), all * std::max(0.0, step.share - shareBefore)},
                 n});
            before = error;
            shareBefore = std::max(shareBefore, step.share);
        }
    }
    std::stable_sort(changes.begin(), changes.end(),
                     [](const Change &a, const Change &b) { return a.price < b.price; });
    // The highest price that is within the budget. Tiles change as a whole.
    Estimate estimate(drawn.size());
    double highest = -1.0;
    for (std::size_t n = 0; n < changes.size(); ++n) {
        estimate.add(changes[n].line, changes[n].error);
        const bool isWhole = n + 1 == changes.size() || changes[n + 1].price > changes[n].price;
        if (isWhole && estimate.limit() <= budget)
            highest = changes[n].price;
    }

    WidthMap map{.tiles = tiles.perSide};
    map.widths.resize(tiles.count(), 0);
    tiles.forEach([&](int strip, int tile) {
        int width = widths.back();
        if (!SliceTiles::isCentral(strip, tile))
            for (const Step &step : steps)
                if (const double energy = energies[tiles.at(strip, tile)];
                    energy == 0.0 || step.perEnergy * energy <= highest)
                    width = step.width;
        map.widths[tiles.at(strip, tile)] = std::uint8_t(width);
        if (width > 0)
            map.strips = std::max(map.strips, strip + 1);
    });
    return map;
}

} // namespace pellucid::widths
