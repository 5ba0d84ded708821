// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/picture/contrast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/picture/contrast_rows.h"

namespace pellucid::picture {

namespace {

// Fine structures are amplified by up to 4, the largest differences weakened to a third.
constexpr double maxAmplification = 2.0, maxCompression = 1.5; // exponents of 2
constexpr double maxBend = 0.3;
// From fine to large structures, in octaves.
constexpr double octaves = 4.0;
constexpr double pixelsPerFineDetail = 2.5;
constexpr int smallestGrid = 4; // pixels a side

// Rows of one grid, which may be written beyond their width.
class Plane {
public:
    Plane(int width, int height)
        : m_stride(std::size_t(width) + rowSlack), m_height(height),
          m_values(m_stride * std::size_t(height)) {}
    float *row(int at) { return m_values.data() + std::size_t(at) * m_stride; }
    // Rows beyond the edge are repeated.
    const float *nearest(int at) const {
        return m_values.data() + std::size_t(std::clamp(at, 0, m_height - 1)) * m_stride;
    }

private:
    std::size_t m_stride;
    int m_height;
    Samples m_values;
};

template <class F> void forRows(int rows, const F &each) {
    constexpr int grain = 16;
    tbb::parallel_for(tbb::blocked_range<int>(0, rows, grain), [&](const auto &range) {
        for (int row = range.begin(); row < range.end(); ++row)
            each(row);
    });
}

FourRows aroundTwice(const Plane &plane, int row) {
    return {plane.nearest(2 * row - 1), plane.nearest(2 * row), plane.nearest(2 * row + 1),
            plane.nearest(2 * row + 2)};
}

} // namespace

BandCurve bandCurve(const Contrast &contrast, double sizeMm) {
    const double t = std::clamp(std::log2(sizeMm / contrast.fineMm) / octaves, 0.0, 1.0);
    const double large = t * t * (3.0 - 2.0 * t);
    return {std::exp2((1.0 - large) * maxAmplification * contrast.detail -
                      large * maxCompression * contrast.latitude),
            (1.0 - large) * maxBend * contrast.detail};
}

AirRamp airRampOf(const Display &display) {
    // Without air, every pixel above zero is body.
    constexpr double tiny = 1e-9;
    return {
        float(display.air),
        float(1.0 / std::max({display.airFade, tiny * std::abs(display.contrast.bright), 1e-30}))};
}

double largestScaleFactor(const Contrast &contrast) {
    return std::exp2(-maxCompression * contrast.latitude);
}

ContrastGrids::ContrastGrids(int imageWidth, int imageHeight, double pixelMm,
                             const Contrast &contrast) {
    while (factor < 4 && 2.0 * factor * pixelMm <= contrast.fineMm / pixelsPerFineDetail)
        factor *= 2;
    Grid grid{(imageWidth + factor - 1) / factor, (imageHeight + factor - 1) / factor,
              pixelMm * factor};
    grids.push_back(grid);
    while (grid.pixelMm < contrast.fineMm * std::exp2(octaves) &&
           std::min(grid.width, grid.height) > smallestGrid) {
        grid = {(grid.width + 1) / 2, (grid.height + 1) / 2, 2.0 * grid.pixelMm};
        grids.push_back(grid);
    }
}

// The pyramid of one picture, from its second grid on.
class ContrastCorrection::Pyramid {
public:
    Pyramid(const ProjectionImage &image, const Display &display)
        : m_image(image), m_contrast(display.contrast),
          m_grids(image.width, image.height, image.pixelMm, display.contrast),
          m_air(airRampOf(display)) {
        // If the finest grid is that of a grey image, it need not be copied.
        if (m_grids.factor > 1 || image.channels > 1)
            takeFinest();
        else
            copyLastRow();
        m_levels.reserve(m_grids.grids.size());
        for (std::size_t n = 1; n < m_grids.grids.size(); ++n)
            addLevel(n);
        for (std::size_t n = m_levels.size(); n-- > 0;)
            processLevel(n);
        m_factors = factorsOf(0);
        if (m_grids.factor == 1)
            return;
        m_correction.emplace(grid(0).width, grid(0).height);
        forRows(grid(0).height, [&](int row) { correct(row, m_correction->row(row)); });
    }

    void row(int row, float *to) const {
        if (!m_correction) {
            correct(row, to);
            return;
        }
        // The middle of a pixel, in pixels of the grid.
        const double at = (row + 0.5) / m_grids.factor - 0.5;
        const int above = int(std::floor(at));
        interpolate(m_correction->nearest(above), m_correction->nearest(above + 1),
                    float(at - above), grid(0).width, m_grids.factor, to, m_image.width);
    }

private:
    struct Level {
        Level(int width, int height)
            : values(width, height), shares(width, height), processed(width, height) {}
        Plane values; ///< weighted by the shares; later the means
        Plane shares;
        Plane processed;
    };

    const ContrastGrids::Grid &grid(std::size_t n) const { return m_grids.grids[n]; }
    static int neighbor(int row) { return row % 2 == 0 ? row / 2 - 1 : row / 2 + 1; }

    BandFactors factorsOf(std::size_t n) const {
        const BandCurve curve = bandCurve(m_contrast, grid(n).pixelMm);
        return {float(1.0 / (m_contrast.bright * BandCurve::knee)), float(curve.amplification),
                float(curve.bend)};
    }

    // A row of the finest grid; rows beyond the edge are repeated. What follows its last pixel can
    // be read, too.
    const float *finest(int row) const {
        if (m_finest)
            return m_finest->nearest(row);
        const int at = std::clamp(row, 0, m_image.height - 1);
        return at == m_image.height - 1
                   ? m_lastRow.data()
                   : m_image.samples.data() + std::size_t(at) * std::size_t(m_image.width);
    }
    FourRows finestAroundTwice(int row) const {
        return {finest(2 * row - 1), finest(2 * row), finest(2 * row + 1), finest(2 * row + 2)};
    }

    // Vector code reads up to a vector beyond a row: in other rows of the image, or here.
    void copyLastRow() {
        const auto width = std::size_t(m_image.width);
        constexpr std::size_t narrow = 64; // one row does not hold what is read beyond another
        if (width < narrow) {
            takeFinest();
            return;
        }
        m_lastRow.assign(m_image.samples.end() - std::ptrdiff_t(width), m_image.samples.end());
        m_lastRow.resize(width + rowSlack, 0.0F);
    }

    void takeFinest() {
        const int factor = m_grids.factor, width = m_image.width, channels = m_image.channels;
        m_finest.emplace(grid(0).width, grid(0).height);
        forRows(grid(0).height, [&](int row) {
            std::array<const float *, 4> rows{};
            std::vector<float> grey;
            if (channels > 1)
                grey.resize(std::size_t(factor) * std::size_t(width) + rowSlack);
            for (int k = 0; k < factor; ++k) {
                const int at = std::min(row * factor + k, m_image.height - 1);
                const float *&pixels = rows[std::size_t(k)];
                pixels = m_image.samples.data() +
                         std::size_t(at) * std::size_t(width) * std::size_t(channels);
                if (channels > 1) {
                    float *const to = grey.data() + std::size_t(k) * std::size_t(width);
                    brightest(pixels, width, channels, to);
                    pixels = to;
                }
            }
            average(rows.data(), factor, width, m_finest->row(row));
        });
    }

    void addLevel(std::size_t n) {
        const int width = grid(n - 1).width;
        Level level(grid(n).width, grid(n).height);
        forRows(grid(n).height, [&](int row) {
            if (n == 1) {
                halveBody(finestAroundTwice(row), width, m_air, level.values.row(row),
                          level.shares.row(row));
            } else {
                const Level &finer = m_levels.back();
                halve(aroundTwice(finer.values, row), width, level.values.row(row));
                halve(aroundTwice(finer.shares, row), width, level.shares.row(row));
            }
        });
        m_levels.push_back(std::move(level));
    }

    float compressed(float mean) const {
        return float(m_contrast.middle +
                     largestScaleFactor(m_contrast) * (double(mean) - m_contrast.middle));
    }

    void processLevel(std::size_t n) {
        Level &level = m_levels[n];
        const int width = grid(n + 1).width, height = grid(n + 1).height;
        if (n + 1 == m_levels.size()) {
            // Where there is no body, the middle is as good a mean as any.
            const float few = float(middleWeight), middle = few * float(m_contrast.middle);
            forRows(height, [&](int row) {
                float *const values = level.values.row(row), *const to = level.processed.row(row);
                const float *const shares = level.shares.row(row);
                for (int at = 0; at < width; ++at) {
                    values[at] = (values[at] + middle) / (shares[at] + few);
                    to[at] = compressed(values[at]);
                }
            });
            return;
        }
        const BandFactors factors = factorsOf(n + 1);
        forRows(height, [&](int row) {
            RowBuffer means;
            expandAbove(n + 1, row, width, means.data(), level.processed.row(row));
            combine(level.values.row(row), level.shares.row(row), means.data(),
                    level.processed.row(row), width, factors, level.values.row(row));
        });
    }

    // The means and the processed picture of a level, at a row of the finer grid.
    void expandAbove(std::size_t level, int row, int width, float *means, float *processed) const {
        const Level &coarser = m_levels[level];
        const int near = row / 2, far = neighbor(row), coarseWidth = grid(level + 1).width;
        expand(coarser.values.nearest(near), coarser.values.nearest(far), coarseWidth, means,
               width);
        expand(coarser.processed.nearest(near), coarser.processed.nearest(far), coarseWidth,
               processed, width);
    }

    // A row of the correction on the finest grid.
    void correct(int row, float *to) const {
        const float *const values = finest(row);
        const int width = grid(0).width;
        if (m_levels.empty()) { // the picture is as small as its largest structures
            for (int n = 0; n < width; ++n)
                to[n] = compressed(values[n]) - values[n];
            return;
        }
        RowBuffer means;
        expandAbove(0, row, width, means.data(), to);
        combineFinest(values, m_air, means.data(), to, width, m_factors);
    }

    using RowBuffer = std::array<float, maxRowWidth + rowSlack>; // filled at once

    const ProjectionImage &m_image;
    const Contrast m_contrast;
    ContrastGrids m_grids;
    AirRamp m_air;
    std::optional<Plane> m_finest;
    std::vector<float> m_lastRow; ///< of the image, if it is the finest grid
    std::vector<Level> m_levels;
    BandFactors m_factors{};
    std::optional<Plane> m_correction; ///< if the finest grid is not that of the image
};

ContrastCorrection::ContrastCorrection(const ProjectionImage &image, const Display &display)
    : m_pyramid(std::make_unique<const Pyramid>(image, display)) {}

ContrastCorrection::~ContrastCorrection() = default;

void ContrastCorrection::row(int row, float *to) const {
    m_pyramid->row(row, to);
}

} // namespace pellucid::picture
