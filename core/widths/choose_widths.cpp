// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/widths/choose_widths.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/plan/cost_model.h"

namespace pellucid::widths {

namespace {

// Diagonals that are measured in a slice, in pairs from one stratum.
constexpr int linesDrawn = 64;
// The margin of the estimated error, in standard errors.
constexpr double standardErrors = 3.0;

// The part of a line that lies in one tile.
struct Part {
    double energy = 0.0; ///< of the tile
    int frequencies = 0; ///< with their mirror images; 0 if its width is not in question
};

struct Drawn {
    SliceLine line;
    std::array<Part, 2> parts;
    double weight = 0.0; ///< of its errors in the sum of all
};

class Drawing {
public:
    // In the best choice, tiles with much more energy than the budget have about equal errors, and
    // tiles with much less are left out. See REFERENCES.md, eq. 6.
    Drawing(const SliceTiles &tiles, std::span<const float> energies, double budgetPerFrequency)
        : m_tiles(tiles), m_energies(energies), m_budgetPerFrequency(budgetPerFrequency) {
        tiles.forEach([&](int strip, int tile) { m_all += chanceOf(strip, tile); });
    }

    std::vector<Drawn> draw() const {
        std::vector<Drawn> drawn;
        double passed = 0.0;
        const auto place = [&] { return (double(drawn.size()) + 0.5) / linesDrawn * m_all; };
        m_tiles.forEach([&](int strip, int tile) {
            const double chance = chanceOf(strip, tile);
            while (chance > 0.0 && place() <= passed + chance)
                drawn.push_back(lineThrough(strip, tile, (place() - passed) / chance));
            passed += chance;
        });
        return drawn;
    }

private:
    double energyOf(int strip, int tile) const {
        return tile >= -m_tiles.perSide && tile < m_tiles.perSide
                   ? double(m_energies[m_tiles.at(strip, tile)])
                   : 0.0;
    }
    double chanceOf(int strip, int tile) const {
        const double energy = energyOf(strip, tile);
        return energy > 0.0 && !SliceTiles::isCentral(strip, tile)
                   ? energy / (energy + m_budgetPerFrequency)
                   : 0.0;
    }
    // The diagonal through a frequency of a tile. `at`: 0 to 1, in the order of the diagonals, each
    // as likely as it is long within the tile. The slope alternates from strip to strip.
    Drawn lineThrough(int strip, int tile, double at) const {
        constexpr int side = SliceTiles::columns;
        static_assert(SliceTiles::rows == side);
        int diagonal = 1 - side;
        for (double before = 0.0; diagonal < side - 1; ++diagonal)
            if ((before += double(side - std::abs(diagonal)) / (side * side)) > at)
                break;
        const int slope = strip % 2 == 0 ? 1 : -1;
        const int first = tile * side + (slope > 0 ? diagonal : side - 1 + diagonal),
                  last = first + slope * (side - 1);
        const auto tileOf = [](int of) { return int(std::floor(double(of) / SliceTiles::rows)); };
        const std::array<int, 2> in{tileOf(first), tileOf(last)};
        const int boundary = SliceTiles::rows * std::max(in[0], in[1]);
        const int split = in[0] == in[1] ? SliceTiles::columns
                                         : (slope > 0 ? boundary - first : first - boundary + 1);
        Drawn drawn{{strip, first, slope, split}, {}, 0.0};
        double chance = 0.0;
        for (std::size_t n = 0; n < 2; ++n) {
            const int columns = n == 0 ? split : SliceTiles::columns - split;
            const double of = chanceOf(strip, in[n]);
            drawn.parts[n] = {energyOf(strip, in[n]), of > 0.0 ? 2 * columns : 0};
            chance += columns * of;
        }
        drawn.weight =
            SliceTiles::columns * SliceTiles::rows * m_all / (chance * double(linesDrawn));
        return drawn;
    }

    const SliceTiles &m_tiles;
    std::span<const float> m_energies;
    double m_budgetPerFrequency;
    double m_all = 0.0;
};

// A narrower width.
struct Step {
    int width = 0;
    double share = 0.0;     ///< of its errors in the energies, root mean square
    double perEnergy = 0.0; ///< the error that it adds for each unit of time saved
};

// The convex hull of time against error, from the widest kernel on: each step adds more error per
// unit of time saved than the one before.
std::vector<Step> stepsFor(std::span<const Drawn> drawn, std::span<const LineErrors> errors,
                           double budgetPerFrequency, std::span<const int> widths) {
    ErrorsByWidth shares{}, squares{};
    double all = 0.0;
    for (std::size_t n = 0; n < drawn.size(); ++n)
        for (std::size_t part = 0; part < 2; ++part) {
            const auto [energy, frequencies] = drawn[n].parts[part];
            if (frequencies == 0)
                continue;
            all += frequencies;
            for (const int width : widths) {
                const double of =
                    errors[n][part][std::size_t(width)] / (energy + budgetPerFrequency);
                shares[std::size_t(width)] += of;
                squares[std::size_t(width)] += of * of / frequencies;
            }
        }
    std::vector<Step> steps;
    for (auto from = widths.size() - 1; from > 0;) {
        Step best;
        std::size_t next = 0;
        for (std::size_t to = from; to-- > 0;) {
            const auto width = std::size_t(widths[to]), wider = std::size_t(widths[from]);
            const double price = std::max(0.0, shares[width] - shares[wider]) /
                                 (plan::readTime(int(wider)) - plan::readTime(int(width)));
            if (to + 1 == from || price <= best.perEnergy) {
                // A tile that is left out loses all of its energy, however dark its lines are.
                best = {int(width),
                        width == 0 ? 1.0 : std::sqrt(squares[width] / std::max(all, 1.0)), price};
                next = to;
            }
        }
        steps.push_back(best);
        from = next;
    }
    return steps;
}

// An upper limit on a choice's error, estimated from the diagonals as their widths become narrower.
class Estimate {
public:
    explicit Estimate(std::size_t lines) : m_lines(lines + lines % 2) {}
    void add(std::size_t line, double error, double expected) {
        Line &of = m_lines[line];
        const double before = of.error - m_lines[line ^ 1U].error;
        // The sum of a pair from one stratum has this variance.
        m_spread += (before + error) * (before + error) - before * before;
        m_expected +=
            (of.expected + expected) * (of.expected + expected) - of.expected * of.expected;
        of.error += error;
        of.expected += expected;
        m_sum += error;
    }
    // If all lines are dark by chance, assume that their errors spread as the energies do.
    double limit() const {
        return m_sum + standardErrors * std::sqrt(std::max(m_spread, m_expected));
    }

private:
    struct Line {
        double error = 0.0, expected = 0.0;
    };
    std::vector<Line> m_lines;
    double m_sum = 0.0, m_spread = 0.0, m_expected = 0.0;
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
    const std::vector<LineErrors> errors = measure(lines);
    const std::vector<Step> steps = stepsFor(drawn, errors, budgetPerFrequency, widths);

    // The parts of the diagonals become narrower in the order of their prices.
    struct Change {
        double price = 0.0, error = 0.0, expected = 0.0;
        std::size_t line = 0;
    };
    std::vector<Change> changes;
    for (std::size_t n = 0; n < drawn.size(); ++n)
        for (std::size_t part = 0; part < 2; ++part) {
            const auto [energy, frequencies] = drawn[n].parts[part];
            if (frequencies == 0)
                continue;
            double before = 0.0, shareBefore = 0.0;
            for (const Step &step : steps) {
                const double error = errors[n][part][std::size_t(step.width)];
                changes.push_back({step.perEnergy * energy, drawn[n].weight * (error - before),
                                   drawn[n].weight * std::max(0.0, step.share - shareBefore) *
                                       energy * frequencies,
                                   n});
                before = error;
                shareBefore = std::max(shareBefore, step.share);
            }
        }
    std::stable_sort(changes.begin(), changes.end(),
                     [](const Change &a, const Change &b) { return a.price < b.price; });
    // The highest price that is within the budget. Tiles change as a whole.
    Estimate estimate(drawn.size());
    double highest = 0.0;
    for (std::size_t n = 0; n < changes.size(); ++n) {
        estimate.add(changes[n].line, changes[n].error, changes[n].expected);
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
                if (step.perEnergy * double(energies[tiles.at(strip, tile)]) <= highest)
                    width = step.width;
        map.widths[tiles.at(strip, tile)] = std::uint8_t(width);
        if (width > 0)
            map.strips = std::max(map.strips, strip + 1);
    });
    return map;
}

} // namespace pellucid::widths
