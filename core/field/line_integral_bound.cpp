// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/field/line_integral_bound.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

namespace pellucid::field {

namespace {

// Sums over blocks of side x side x side samples: `side` layers and a square of each. A line that
// runs mainly along the axis stays within two by two blocks while it crosses `side` layers, so each
// layer contributes at most its maximum over two by two squares.
class BlockSums {
public:
    BlockSums(const LayerMaxima &layers, int side)
        : m_layers((layers.samples + side - 1) / side), m_columns(layers.columns),
          m_rows(layers.rows) {
        std::vector<float> sums(std::size_t(m_layers) * std::size_t(m_rows) *
                                std::size_t(m_columns));
        const float *square = layers.values.data();
        for (int n = 0; n < layers.samples; ++n)
            for (int row = 0; row < m_rows; ++row)
                for (int column = 0; column < m_columns; ++column, ++square) {
                    const int right = column + 1 < m_columns ? 1 : 0,
                              below = row + 1 < m_rows ? m_columns : 0;
                    sums[at(n / side, row, column)] +=
                        std::max({square[0], square[right], square[below], square[below + right]});
                }
        m_levels.push_back(std::move(sums));
        for (int reach = 1; reach < std::max(m_columns, m_rows); reach *= 2) {
            const std::vector<float> &fine = m_levels.back();
            std::vector<float> coarse(fine.size());
            for (int layer = 0; layer < m_layers; ++layer)
                for (int row = 0; row < m_rows; ++row)
                    for (int column = 0; column < m_columns; ++column) {
                        const int right = std::min(m_columns - 1, column + reach),
                                  below = std::min(m_rows - 1, row + reach);
                        coarse[at(layer, row, column)] = std::max(
                            {fine[at(layer, row, column)], fine[at(layer, row, right)],
                             fine[at(layer, below, column)], fine[at(layer, below, right)]});
                    }
            m_levels.push_back(std::move(coarse));
        }
    }

    int layers() const { return m_layers; }
    int columns() const { return m_columns; }
    int rows() const { return m_rows; }

    // An upper bound on the integral of a line in a layer of blocks while it stays within these
    // rows and columns, both ends included.
    float most(int layer, int firstRow, int lastRow, int firstColumn, int lastColumn) const {
        if (firstRow >= m_rows || firstColumn >= m_columns || lastRow < 0 || lastColumn < 0)
            return 0.0F;
        firstRow = std::max(0, firstRow);
        firstColumn = std::max(0, firstColumn);
        // Each sum already covers the next block.
        lastRow = std::max(firstRow, std::min(m_rows - 1, lastRow) - 1);
        lastColumn = std::max(firstColumn, std::min(m_columns - 1, lastColumn) - 1);
        const int width = std::max(lastRow - firstRow, lastColumn - firstColumn) + 1;
        std::size_t level = 0;
        while ((2 << level) <= width)
            ++level;
        const int reach = 1 << level, row = std::max(firstRow, lastRow + 1 - reach),
                  column = std::max(firstColumn, lastColumn + 1 - reach);
        const std::vector<float> &sums = m_levels[level];
        return std::max({sums[at(layer, firstRow, firstColumn)], sums[at(layer, firstRow, column)],
                         sums[at(layer, row, firstColumn)], sums[at(layer, row, column)]});
    }

private:
    std::size_t at(int layer, int row, int column) const {
        return (std::size_t(layer) * std::size_t(m_rows) + std::size_t(row)) *
                   std::size_t(m_columns) +
               std::size_t(column);
    }

    int m_layers, m_columns, m_rows;
    std::vector<std::vector<float>> m_levels; // maxima over squares of 1, 2, 4 .. sums a side
};

struct Interval {
    double lo = 0.0, hi = 0.0;
    double width() const { return hi - lo; }
};

// A set of lines that run mainly along an axis, given by their position in the middle of the box
// and their shift for each sample along the axis. *Units*: samples from the corner of the box. Here
// a sample's value holds from its position up to the next sample: interpolated values are means
// over such lines.
struct Bundle {
    std::array<Interval, 2> middle, slope;
    double bound = 0.0;
    bool operator<(const Bundle &other) const { return bound < other.bound; }
};

class LinesAlong {
public:
    LinesAlong(const LayerMaxima &layers, int axis, int side, const volume::Lattice &lattice)
        : m_blocks(layers, side), m_samples(layers.samples), m_side(side),
          m_along(lattice.step(axis)), m_across{lattice.step((axis + 1) % 3),
                                                lattice.step((axis + 2) % 3)} {}

    Bundle all() const {
        const double half = 0.5 * m_samples;
        Bundle bundle{{Interval{-half, m_blocks.columns() * m_side + half},
                       Interval{-half, m_blocks.rows() * m_side + half}},
                      {Interval{-1.0, 1.0}, Interval{-1.0, 1.0}}};
        judge(bundle);
        return bundle;
    }

    // Halves the interval over which the lines diverge most at the ends of the box.
    std::array<Bundle, 2> halves(const Bundle &bundle) const {
        std::array<Bundle, 2> both{bundle, bundle};
        double widest = -1.0;
        Interval *first = nullptr, *second = nullptr;
        for (std::size_t n = 0; n < 2; ++n) {
            if (bundle.middle[n].width() > widest) {
                widest = bundle.middle[n].width();
                first = &both[0].middle[n];
                second = &both[1].middle[n];
            }
            if (bundle.slope[n].width() * m_samples > widest) {
                widest = bundle.slope[n].width() * m_samples;
                first = &both[0].slope[n];
                second = &both[1].slope[n];
            }
        }
        first->hi = second->lo = 0.5 * (first->lo + first->hi);
        for (Bundle &half : both)
            judge(half);
        return both;
    }

private:
    void judge(Bundle &bundle) const {
        double longest = 0.0; // of a line between two layers, mm
        for (const double a : {bundle.slope[0].lo, bundle.slope[0].hi})
            for (const double b : {bundle.slope[1].lo, bundle.slope[1].hi})
                longest =
                    std::max(longest, glm::length(m_along + a * m_across[0] + b * m_across[1]));
        double sum = 0.0;
        for (int layer = 0; layer < m_blocks.layers(); ++layer) {
            // Offsets of the first and last samples of this layer of blocks from the middle.
            const double from = layer * m_side - 0.5 * (m_samples - 1),
                         to = std::min(m_samples, (layer + 1) * m_side) - 1 - 0.5 * (m_samples - 1);
            std::array<int, 2> first{}, last{};
            for (std::size_t n = 0; n < 2; ++n) {
                const Interval &middle = bundle.middle[n], &slope = bundle.slope[n];
                const auto moved =
                    std::minmax({slope.lo * from, slope.hi * from, slope.lo * to, slope.hi * to});
                first[n] = int(std::floor((middle.lo + moved.first) / m_side));
                last[n] = int(std::floor((middle.hi + moved.second) / m_side));
            }
            sum += double(m_blocks.most(layer, first[1], last[1], first[0], last[0]));
        }
        bundle.bound = sum * longest;
    }

    BlockSums m_blocks;
    int m_samples, m_side;
    glm::dvec3 m_along;
    std::array<glm::dvec3, 2> m_across;
};

} // namespace

double largestLineIntegral(const std::array<LayerMaxima, 3> &layers, int side,
                           const volume::Lattice &lattice) {
    // Branch and bound: each step halves the bundle with the largest bound. Whenever the search
    // stops, the largest remaining bound holds for all lines.
    constexpr int halvings = 1500;
    std::array<double, 3> largest{};
    tbb::parallel_for(std::size_t(0), largest.size(), [&](std::size_t axis) {
        const LinesAlong lines(layers[axis], int(axis), side, lattice);
        std::priority_queue<Bundle> open;
        open.push(lines.all());
        for (int n = 0; n < halvings && open.top().bound > 0.0; ++n) {
            const Bundle top = open.top();
            open.pop();
            for (const Bundle &half : lines.halves(top))
                open.push(half);
        }
        largest[axis] = open.top().bound;
    });
    return *std::max_element(largest.begin(), largest.end());
}

} // namespace pellucid::field
