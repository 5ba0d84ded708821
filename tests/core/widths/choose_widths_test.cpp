// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "core/widths/choose_widths.h"

namespace pellucid {

namespace {

using widths::SliceTiles;

// The energy of a frequency of a slice of 320 x 320.
struct Spectrum {
    const char *name;
    std::function<double(int column, int row)> energy;
    double table = 0.0; ///< the least energy that the table has of a tile
};

double near(double distance, double width) {
    return std::exp(-distance * distance / (2.0 * width * width));
}

const Spectrum spectra[] = {
    {"noise", [](int, int) { return 1.0; }},
    {"falling", [](int column, int row) { return std::pow(1.0 + std::hypot(column, row), -4.0); }},
    {"fallingSteeply", [](int column, int row) { return near(std::hypot(column, row), 12.0); }},
    {"row", [](int, int row) { return near(row - 3, 0.7); }},
    {"column", [](int column, int) { return near(column - 37, 0.7); }},
    {"shallowLine", [](int column, int row) { return near(row - 0.04 * column, 0.7); }},
    // Between the frequencies of a line, and in the corner of a tile.
    {"peaks",
     [](int column, int row) {
         return near(std::hypot(column - 40, row - 64), 1.5) +
                near(std::hypot(column - 95, row + 49), 2.0) + 1e-9;
     }},
    {"diagonal",
     [](int column, int row) {
         return near(column - row - 3, 0.7) * std::pow(1.0 + std::hypot(column, row), -4.0);
     }},
    // Along the frequencies that a line has.
    {"steepLine",
     [](int column, int row) {
         return near((3 * column - row - 3) / 3.2, 0.7) *
                std::pow(1.0 + std::hypot(column, row), -4.0);
     }},
    // A texture that cancels along the view: the table is bright, the slice is dark but for a peak.
    {"peakInTheDark",
     [](int column, int row) { return 1e-9 + near(std::hypot(column - 24, row - 104), 3.0); }, 0.5},
    {"peakInNothing",
     [](int column, int row) {
         const double distance = std::hypot(column - 24, row - 104);
         return distance < 8.0 ? near(distance, 3.0) : 0.0;
     },
     0.5},
};

// The error of a width as a share of the energy.
double shareOf(int width) {
    constexpr std::array<double, 5> shares{1.0, 0.0, 2e-2, 1e-3, 0.0};
    return shares[std::size_t(width)];
}

class ChooseWidths : public testing::TestWithParam<Spectrum> {
protected:
    static double energyAt(int column, int row) {
        return std::hypot(column, row) < 160.0 ? GetParam().energy(column, row) : 0.0;
    }
    std::vector<float> energies() const {
        std::vector<float> all(m_tiles.count(), 0.0F);
        m_tiles.forEach([&](int strip, int tile) {
            double sum = 0.0;
            visit(strip, tile, [&](double energy) { sum += energy; });
            all[m_tiles.at(strip, tile)] =
                float(std::max(GetParam().table, sum / (SliceTiles::columns * SliceTiles::rows)));
        });
        return all;
    }
    template <class Visit> static void visit(int strip, int tile, const Visit &visit) {
        for (int column = 0; column < SliceTiles::columns; ++column)
            for (int row = 0; row < SliceTiles::rows; ++row)
                visit(
                    energyAt(strip * SliceTiles::columns + column, tile * SliceTiles::rows + row));
    }
    static std::vector<widths::ErrorsByWidth> measured(std::span<const widths::SliceLine> lines,
                                                       std::span<const int> by) {
        std::vector<widths::ErrorsByWidth> errors(lines.size());
        for (std::size_t n = 0; n < lines.size(); ++n)
            for (int lane = 0; lane < SliceTiles::columns; ++lane)
                for (const int width : by)
                    errors[n][std::size_t(width)] +=
                        2.0 * shareOf(width) *
                        energyAt(lines[n].strip * SliceTiles::columns + lane, lines[n].rowOf(lane));
        return errors;
    }
    widths::WidthMap choose(double budget, std::span<const int> by) const {
        return widths::chooseWidths(m_tiles, energies(), budget, by,
                                    [&](auto lines) { return measured(lines, by); });
    }
    double errorOf(const widths::WidthMap &map) const {
        double error = 0.0;
        m_tiles.forEach([&](int strip, int tile) {
            visit(strip, tile, [&](double energy) {
                error += 2.0 * shareOf(map.widths[m_tiles.at(strip, tile)]) * energy;
            });
        });
        return error;
    }
    double energyOfAll() const {
        double all = 0.0;
        m_tiles.forEach([&](int strip, int tile) {
            visit(strip, tile, [&](double energy) { all += 2.0 * energy; });
        });
        return all;
    }

    widths::SlicePlane m_plane{320, 320, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
    SliceTiles m_tiles{m_plane};
};

// The estimate from a few lines is good for every distribution of the error in tiles.
TEST_P(ChooseWidths, SpendTheBudgetButNoMore) {
    constexpr std::array<int, 4> all{0, 2, 3, 4};
    constexpr std::array<int, 2> one{0, 4};
    for (const std::span<const int> by : {std::span<const int>(all), std::span<const int>(one)})
        for (const double tolerance : {0.1, 1e-2, 1e-3}) {
            const double budget = tolerance * tolerance * energyOfAll();
            const widths::WidthMap map = choose(budget, by);
            // The estimate may be off by a fifth for peaks that few lines cross.
            EXPECT_LE(errorOf(map), 1.2 * budget) << by.size() << " widths, " << tolerance;
            EXPECT_EQ(map.widths[m_tiles.at(0, 0)], 4);
            EXPECT_EQ(map.widths[m_tiles.at(0, -1)], 4);
        }
    if (GetParam().name == std::string("falling")) {
        const double budget = 1e-4 * energyOfAll();
        const widths::WidthMap map = choose(budget, all);
        EXPECT_GT(errorOf(map), 0.2 * budget);
        EXPECT_GT(map.shares(m_plane)[0], 0.5);
    }
}

TEST_P(ChooseWidths, MakeNoErrorWithoutABudget) {
    constexpr std::array<int, 4> all{0, 2, 3, 4};
    const widths::WidthMap map = choose(0.0, all);
    EXPECT_LE(errorOf(map), 1e-30 * energyOfAll());
}

INSTANTIATE_TEST_SUITE_P(Spectra, ChooseWidths, testing::ValuesIn(spectra),
                         [](const auto &spectrum) { return std::string(spectrum.param.name); });

// A slice without energy beside its center is not read.
TEST(ChooseNoWidths, WhereThereIsNoEnergy) {
    const SliceTiles tiles({160, 160, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}});
    const std::vector<float> dark(tiles.count(), 0.0F);
    constexpr std::array<int, 3> by{0, 2, 3};
    const widths::WidthMap map = widths::chooseWidths(tiles, dark, 1.0, by, [](auto lines) {
        return std::vector<widths::ErrorsByWidth>(lines.size());
    });
    EXPECT_EQ(std::count(map.widths.begin(), map.widths.end(), 3), 2);
    EXPECT_EQ(std::size_t(std::count(map.widths.begin(), map.widths.end(), 0)), tiles.count() - 2);
    EXPECT_EQ(map.strips, 1);
}

} // namespace

} // namespace pellucid
