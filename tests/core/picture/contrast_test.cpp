// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/picture/contrast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace pellucid::picture {

namespace {

// The same processing by its definition, in double precision.
struct Grid {
    int width, height;
    std::vector<double> values;
    double at(int r, int c) const {
        return values[std::size_t(std::clamp(r, 0, height - 1)) * std::size_t(width) +
                      std::size_t(std::clamp(c, 0, width - 1))];
    }
    static Grid of(int width, int height, const std::function<double(int, int)> &value) {
        Grid grid{width, height, {}};
        for (int r = 0; r < height; ++r)
            for (int c = 0; c < width; ++c)
                grid.values.push_back(value(r, c));
        return grid;
    }
};

Grid halved(const Grid &fine) {
    constexpr double weights[] = {0.125, 0.375, 0.375, 0.125};
    return Grid::of((fine.width + 1) / 2, (fine.height + 1) / 2, [&](int r, int c) {
        double sum = 0.0;
        for (int dr = 0; dr < 4; ++dr)
            for (int dc = 0; dc < 4; ++dc)
                sum += weights[dr] * weights[dc] * fine.at(2 * r - 1 + dr, 2 * c - 1 + dc);
        return sum;
    });
}

// Linear interpolation at the middle of a pixel of a grid `factor` times finer.
double between(const Grid &coarse, int factor, int r, int c) {
    const double y = (r + 0.5) / factor - 0.5, x = (c + 0.5) / factor - 0.5;
    const int r0 = int(std::floor(y)), c0 = int(std::floor(x));
    const double dy = y - r0, dx = x - c0;
    return (1 - dy) * ((1 - dx) * coarse.at(r0, c0) + dx * coarse.at(r0, c0 + 1)) +
           dy * ((1 - dx) * coarse.at(r0 + 1, c0) + dx * coarse.at(r0 + 1, c0 + 1));
}

Grid expectedCorrection(const ProjectionImage &image, const Display &display) {
    const Contrast &contrast = display.contrast;
    const ContrastGrids grids(image.width, image.height, image.pixelMm, contrast);
    const auto &finest = grids.grids.front();
    const Grid picture = Grid::of(image.width, image.height, [&](int r, int c) {
        const float *const pixel =
            image.samples.data() + (std::size_t(r) * std::size_t(image.width) + std::size_t(c)) *
                                       std::size_t(image.channels);
        return *std::max_element(pixel, pixel + image.channels);
    });
    const Grid values = Grid::of(finest.width, finest.height, [&](int r, int c) {
        double sum = 0.0;
        for (int dr = 0; dr < grids.factor; ++dr)
            for (int dc = 0; dc < grids.factor; ++dc)
                sum += picture.at(grids.factor * r + dr, grids.factor * c + dc);
        return sum / (grids.factor * grids.factor);
    });
    const auto share = [&](double value) {
        return std::clamp((value - display.air) / display.airFade, 0.0, 1.0);
    };
    const auto compressed = [&](double value) {
        return contrast.middle + std::exp2(-1.5 * contrast.latitude) * (value - contrast.middle);
    };
    std::vector<Grid> sums, shares;
    for (std::size_t n = 1; n < grids.grids.size(); ++n) {
        const auto weighted = [&](const Grid &grid, bool isShare) {
            return Grid::of(grid.width, grid.height, [&](int r, int c) {
                const double value = grid.at(r, c);
                return isShare ? share(value) : share(value) * value;
            });
        };
        sums.push_back(halved(n == 1 ? weighted(values, false) : sums.back()));
        shares.push_back(halved(n == 1 ? weighted(values, true) : shares.back()));
    }
    if (sums.empty())
        return Grid::of(finest.width, finest.height, [&](int r, int c) {
            return compressed(values.at(r, c)) - values.at(r, c);
        });
    const auto curved = [&](double band, double sizeMm) {
        const double t = std::clamp(std::log2(sizeMm / contrast.fineMm) / 4.0, 0.0, 1.0);
        const double large = t * t * (3.0 - 2.0 * t), x = band / contrast.bright / 0.01;
        return band *
               std::exp2((1.0 - large) * 2.0 * contrast.detail - large * 1.5 * contrast.latitude) *
               std::pow(1.0 + x * x, -(1.0 - large) * 0.3 * contrast.detail);
    };
    Grid mean = Grid::of(sums.back().width, sums.back().height, [&](int r, int c) {
        return (sums.back().at(r, c) + 0.001 * contrast.middle) / (shares.back().at(r, c) + 0.001);
    });
    Grid processed =
        Grid::of(mean.width, mean.height, [&](int r, int c) { return compressed(mean.at(r, c)); });
    for (std::size_t n = sums.size() - 1; n-- > 0;) {
        const double size = grids.grids[n + 1].pixelMm;
        const auto own = [&](int r, int c) {
            return sums[n].at(r, c) + (1.0 - shares[n].at(r, c)) * between(mean, 2, r, c);
        };
        const Grid next = Grid::of(sums[n].width, sums[n].height, own);
        processed = Grid::of(next.width, next.height, [&](int r, int c) {
            return between(processed, 2, r, c) + curved(own(r, c) - between(mean, 2, r, c), size);
        });
        mean = next;
    }
    return Grid::of(finest.width, finest.height, [&](int r, int c) {
        const double value = values.at(r, c);
        return between(processed, 2, r, c) +
               curved(share(value) * (value - between(mean, 2, r, c)), finest.pixelMm) - value;
    });
}

// A body with bumps of every size beside air.
ProjectionImage body(int width, int height, double pixelMm, int channels = 1) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> noise(0.0F, 8.0F);
    ProjectionImage image{width, height, pixelMm, {}, channels};
    for (int r = 0; r < height; ++r)
        for (int c = 0; c < width; ++c)
            for (int k = 0; k < channels; ++k) {
                const double x = c * pixelMm, y = r * pixelMm;
                image.samples.push_back(c < width / 5 ? 0.0F
                                                      : float(60.0 + 30.0 * std::sin(x / 15.0) +
                                                              9.0 * std::sin(y / 3.0)) +
                                                            noise(random));
            }
    return image;
}

Display processing(double detail, double latitude) {
    return {{0.0, 100.0}, false, 1.0, {detail, latitude, 100.0, 55.0, 2.0}, 1.0, 5.0};
}

std::vector<float> correctionOf(const ProjectionImage &image, const Display &display) {
    const ContrastCorrection correction(image, display);
    std::vector<float> all, row(std::size_t(image.width + ContrastCorrection::slack));
    for (int r = 0; r < image.height; ++r) {
        correction.row(r, row.data());
        all.insert(all.end(), row.begin(), row.begin() + image.width);
    }
    return all;
}

} // namespace

TEST(Contrast, IsTheDefinition) {
    for (const auto &[width, height] : {std::pair(211, 97), {96, 64}, {33, 150}, {6, 3}, {1, 1}})
        for (const double pixelMm : {0.1, 0.25, 0.8, 5.0, 60.0})
            for (const int channels : {1, 3}) {
                const ProjectionImage image = body(width, height, pixelMm, channels);
                const Display display = processing(0.7, 0.6);
                const Grid expected = expectedCorrection(image, display);
                const int factor = ContrastGrids(width, height, pixelMm, display.contrast).factor;
                const auto found = correctionOf(image, display);
                double largest = 0.0;
                for (int r = 0; r < height; ++r)
                    for (int c = 0; c < width; ++c)
                        largest =
                            std::max(largest, std::abs(double(found[std::size_t(r * width + c)]) -
                                                       between(expected, factor, r, c)));
                // Single precision: a dozen sums of values up to 100, and a power by its logarithm.
                EXPECT_LT(largest, 1e-3)
                    << width << " x " << height << ", " << pixelMm << " mm, " << channels;
            }
}

TEST(Contrast, WithoutDetailAndLatitudeNothingChanges) {
    // Not off, but as good as.
    const auto correction = correctionOf(body(120, 90, 0.8), processing(1e-12, 0.0));
    for (int r = 0; r < 90; ++r)
        for (int c = 40; c < 120; ++c) // away from air, whose correction means nothing
            ASSERT_NEAR(correction[std::size_t(r * 120 + c)], 0.0, 1e-3);
}

// A large uniform body keeps its grey up to its very edge, where other pyramids have a halo.
TEST(Contrast, TheEdgeOfABodyHasNoHalo) {
    ProjectionImage image{200, 120, 0.8};
    for (int r = 0; r < 120; ++r)
        for (int c = 0; c < 200; ++c)
            image.samples.push_back(c < 60 ? 0.0F : 80.0F);
    const auto correction = correctionOf(image, processing(0.8, 0.8));
    const float inside = correction[60 * 200 + 150];
    for (int c = 60; c < 200; ++c)
        EXPECT_NEAR(correction[std::size_t(60 * 200 + c)], inside, 0.5) << c;
}

// The same body in pixels of another size looks the same: bands are sizes in mm.
TEST(Contrast, ZoomingKeepsTheLook) {
    const auto waves = [](int width, double pixelMm) {
        ProjectionImage image{width, width, pixelMm};
        for (int r = 0; r < width; ++r)
            for (int c = 0; c < width; ++c) {
                const double x = (c + 0.5) * pixelMm, y = (r + 0.5) * pixelMm;
                image.samples.push_back(
                    float(60.0 + 20.0 * std::sin(x / 20.0) + 6.0 * std::sin(y / 4.0)));
            }
        return image;
    };
    const Display display = processing(0.7, 0.7);
    const ProjectionImage coarse = waves(160, 1.0), fine = waves(400, 0.4);
    const auto coarseCorrection = correctionOf(coarse, display),
               fineCorrection = correctionOf(fine, display);
    double squares = 0.0, differences = 0.0;
    for (int r = 20; r < 140; r += 2)
        for (int c = 20; c < 140; c += 2) {
            // The middles of both pixels are at 2.5 r + 0.75 of the fine ones.
            const auto n = std::size_t(int(2.5 * r + 1) * 400 + int(2.5 * c + 1));
            const double a = coarse.samples[std::size_t(r * 160 + c)] +
                             coarseCorrection[std::size_t(r * 160 + c)];
            const double b = fine.samples[n] + fineCorrection[n];
            squares += (a - 55.0) * (a - 55.0);
            differences += (a - b) * (a - b);
        }
    EXPECT_LT(std::sqrt(differences / squares), 0.15);
}

TEST(Contrast, WeakDetailIsAmplifiedMoreThanStrong) {
    const Contrast contrast = processing(0.5, 0.5).contrast;
    const BandCurve fine = bandCurve(contrast, 1.0), large = bandCurve(contrast, 32.0);
    EXPECT_DOUBLE_EQ(fine.amplification, 2.0);
    EXPECT_GT(fine.bend, 0.0);
    EXPECT_DOUBLE_EQ(large.amplification, largestScaleFactor(contrast));
    EXPECT_EQ(large.bend, 0.0);
}

} // namespace pellucid::picture
