// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/edges.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <itkCannyEdgeDetectionImageFilter.h>
#include <itkImage.h>

#include "core/phantom/phantom.h"
#include "core/preprocess/morphology.h"
#include "core/task/error.h"
#include "tests/support/fields.h"

namespace pellucid {
namespace {

using preprocess::Mask;

// The edges that ITK's own filter finds in the same samples.
Mask itkEdges(const volume::Volume &volume, double variance, double low, double high) {
    using Image = itk::Image<float, 3>;
    const volume::GridSize n = volume.lattice().size();
    auto image = Image::New();
    image->SetRegions(Image::RegionType(
        {itk::SizeValueType(n.i), itk::SizeValueType(n.j), itk::SizeValueType(n.k)}));
    Image::SpacingType spacing;
    spacing.Fill(volume.lattice().spacingMm(0));
    image->SetSpacing(spacing);
    image->Allocate();
    for (int k = 0; k < n.k; ++k)
        for (int j = 0; j < n.j; ++j)
            for (int i = 0; i < n.i; ++i)
                image->SetPixel({i, j, k}, float(volume.value({i, j, k})));
    auto filter = itk::CannyEdgeDetectionImageFilter<Image, Image>::New();
    filter->SetInput(image);
    filter->SetVariance(variance);
    filter->SetMaximumError(0.01);
    filter->SetLowerThreshold(float(low));
    filter->SetUpperThreshold(float(high));
    filter->Update();
    Mask edges;
    const float *const samples = filter->GetOutput()->GetBufferPointer();
    for (std::size_t index = 0; index < n.count(); ++index)
        edges.push_back(samples[index] > 0.0F);
    return edges;
}

TEST(CannyEdges, AreThoseOfItkOnIsotropicLattices) {
    for (const double spacing : {1.0, 0.7}) {
        const auto lattice = volume::Lattice::centred({40, 36, 32}, glm::dvec3(spacing));
        std::mt19937 random(3);
        std::normal_distribution<double> noise(0.0, 15.0);
        const auto volume = test::volumeOf(lattice, [&](glm::dvec3 p) {
            const double shell = glm::length(p / spacing) - 11.0;
            return 400.0 / (1.0 + std::exp(1.5 * shell)) + noise(random);
        });
        const double sigma = 1.2 * spacing;
        const Mask ours = preprocess::cannyEdges(volume, {sigma, 10.0 / spacing, 40.0 / spacing});
        const Mask theirs = itkEdges(volume, sigma * sigma, 10.0, 40.0);
        std::size_t count = 0, different = 0;
        for (std::size_t n = 0; n < ours.size(); ++n) {
            count += theirs[n];
            different += ours[n] != theirs[n];
        }
        EXPECT_GT(count, 1000U);
        // Sums in a different order move a sample or two across a threshold or a tie.
        EXPECT_LE(different, count / 500) << "spacing " << spacing;
    }
}

double dice(const Mask &a, const Mask &b) {
    double both = 0.0, all = 0.0;
    for (std::size_t n = 0; n < a.size(); ++n) {
        both += a[n] & b[n];
        all += a[n] + b[n];
    }
    return 2.0 * both / all;
}

// A detector built from ITK's derivatives, zero crossings and double threshold finds the same
// edges, on thick slices too.
TEST(CannyEdges, AreThoseOfTheMethodOfItk) {
    for (const double thickness : {1.0, 3.0}) {
        const auto lattice = volume::Lattice::centred({48, 48, int(48 / thickness)},
                                                      glm::dvec3(1.0, 1.0, thickness));
        const auto volume = test::volumeOf(lattice, [&](glm::dvec3 p) {
            return 400.0 / (1.0 + std::exp(1.5 * (glm::length(p) - 15.0)));
        });
        const preprocess::CannyOptions options{1.5 * thickness, 5.0, 15.0};
        const Mask fast = preprocess::cannyEdges(volume, options),
                   itk = preprocess::cannyEdgesByItk(volume, options);
        EXPECT_GT(std::count(itk.begin(), itk.end(), 1), 300) << thickness;
        EXPECT_GT(dice(fast, itk), 0.9) << thickness;
    }
}

TEST(CannyEdges, OfItkNeedFourSlices) {
    const auto volume = test::volumeOf(volume::Lattice::centred({16, 16, 3}, {1, 1, 1}),
                                       [](glm::dvec3 p) { return p.x; });
    EXPECT_THROW(preprocess::cannyEdgesByItk(volume, {1.0, 1.0, 2.0}), task::Error);
    EXPECT_NO_THROW(preprocess::cannyEdges(volume, {1.0, 1.0, 2.0}));
}

TEST(Morphology, OfItkIsThatOfDistances) {
    const auto lattice = volume::Lattice::centred({30, 30, 15}, {1, 1, 2});
    std::mt19937 random(5);
    Mask mask(lattice.size().count());
    for (int k = 3; k < 12; ++k)
        for (int j = 6; j < 24; ++j)
            for (int i = 6; i < 24; ++i)
                mask[(std::size_t(k) * 30 + j) * 30 + i] = random() % 20 != 0;
    for (const double radius : {1.0, 2.3}) {
        EXPECT_EQ(preprocess::openingByItk(lattice, mask, radius),
                  preprocess::opening(lattice, mask, radius))
            << radius;
        EXPECT_EQ(preprocess::closingByItk(lattice, mask, radius),
                  preprocess::closing(lattice, mask, radius))
            << radius;
    }
}

TEST(CannyEdges, DoNotDependOnTheScaleOfTheValues) {
    const auto lattice = volume::Lattice::centred({32, 32, 24}, {1, 1, 1.5});
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0.0, 10.0);
    const auto large = test::volumeOf(lattice, [&](glm::dvec3 p) {
        return (glm::length(p) < 9.0 ? 300.0 : 0.0) + noise(random);
    });
    // Scaling by a power of two changes only the exponents.
    constexpr float scale = 1.0F / 16384.0F;
    std::vector<float> samples;
    large.visit([&](auto values) {
        for (const auto value : values)
            samples.push_back(scale * float(value));
    });
    const volume::Volume small(lattice, std::move(samples), volume::ValueUnit::none);
    const Mask edges = preprocess::cannyEdges(large, {1.0, 15.0, 40.0});
    EXPECT_GT(std::count(edges.begin(), edges.end(), 1), 300);
    EXPECT_EQ(preprocess::cannyEdges(small, {1.0, 15.0 * scale, 40.0 * scale}), edges);
}

// The surface of a ball in thick, tilted slices. The derivatives are per mm, not per sample, so
// edges are found equally well in every direction.
TEST(CannyEdges, LieOnABallInThickTiltedSlices) {
    const auto lattice = test::tiltedLattice({80, 80, 26}, {0.8, 0.8, 2.4}, 20.0);
    constexpr double radius = 22.0;
    const glm::dvec3 center = lattice.center().mm;
    const auto volume = test::volumeOf(lattice, [&](glm::dvec3 p) {
        return 1000.0 / (1.0 + std::exp(1.5 * (glm::length(p - center) - radius)));
    });
    const Mask edges = preprocess::cannyEdges(volume, {1.0, 60.0, 120.0});
    double worst = 0.0;
    std::array<int, 3> along{};
    for (std::size_t n = 0; n < edges.size(); ++n) {
        if (edges[n] == 0)
            continue;
        const int i = int(n % 80), j = int(n / 80 % 80), k = int(n / 6400);
        const glm::dvec3 p = lattice.patient(volume::VoxelIndex{i, j, k}).mm - center;
        worst = std::max(worst, std::abs(glm::length(p) - radius));
        for (int d = 0; d < 3; ++d)
            along[std::size_t(d)] += std::abs(p[d]) > 0.8 * radius;
    }
    // At most half a step of the lattice along its longest axis.
    EXPECT_LE(worst, 0.5 * lattice.spacingMm(2) + 0.05);
    for (const int caps : along)
        EXPECT_GT(caps, 100);
}

TEST(GradientMagnitude, OfALinearFieldIsItsSlopeOnAnyLattice) {
    for (const double tilt : {0.0, 25.0}) {
        const auto lattice = test::tiltedLattice({9, 8, 7}, {0.7, 0.9, 4.0}, tilt);
        const glm::dvec3 slope(3.0, -5.0, 7.0);
        const auto volume =
            test::volumeOf(lattice, [&](glm::dvec3 p) { return glm::dot(slope, p); });
        const auto gradient = preprocess::gradientMagnitude(volume);
        // Only inside: differences at the border span half the distance.
        for (int k = 1; k < 6; ++k)
            EXPECT_NEAR(gradient.value({4, 4, k}), glm::length(slope), 1e-4);
    }
}

TEST(CannyEdges, AreCancelled) {
    std::stop_source stop;
    stop.request_stop();
    const auto volume = test::volumeOf(volume::Lattice::centred({16, 16, 16}, {1, 1, 1}),
                                       [](glm::dvec3 p) { return p.x; });
    EXPECT_THROW(preprocess::cannyEdges(volume, {1.0, 1.0, 2.0}, task::Progress(stop.get_token())),
                 task::Cancelled);
}

} // namespace
} // namespace pellucid
