// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/segment/stored_masks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/task/error.h"

namespace pellucid {
namespace {

using segment::MaskPlane;
using segment::StoredMasks;
using volume::Coverage;
using volume::GridSize;
using volume::Lattice;
using volume::VoxelIndex;

// A tilted lattice with three different steps.
Lattice tilted(const GridSize &size) {
    const double angle = 0.31;
    return Lattice::make(size, {glm::dvec3(-31.0, 12.5, 103.0)},
                         {glm::dvec3(0.7, 0.0, 0.0),
                          glm::dvec3(0.0, 0.9 * std::cos(angle), -0.9 * std::sin(angle)),
                          glm::dvec3(0.0, 0.0, 2.5)});
}

// A random mask on a lattice, and the same as planes in any of its axes' orders and directions.
struct Scrambled {
    std::vector<std::uint8_t> truth; // by sample of the lattice
    std::vector<std::byte> bits;
    StoredMasks masks;
};

Scrambled scrambled(const Lattice &lattice, std::array<int, 3> axes, std::array<bool, 3> flips,
                    unsigned seed) {
    const GridSize size = lattice.size();
    std::mt19937 random(seed);
    Scrambled made;
    made.truth.resize(size.count());
    for (std::uint8_t &sample : made.truth)
        sample = random() % 3 == 0 ? 255 : 0;
    const std::array<int, 3> counts{size[axes[0]], size[axes[1]], size[axes[2]]};
    made.masks.columns = counts[0];
    made.masks.rows = counts[1];
    const auto sampleAt = [&](int c, int r, int p) {
        std::array<int, 3> n{};
        const std::array<int, 3> along{c, r, p};
        for (std::size_t d = 0; d < 3; ++d)
            n[std::size_t(axes[d])] = flips[d] ? counts[d] - 1 - along[d] : along[d];
        return VoxelIndex{n[0], n[1], n[2]};
    };
    made.bits.resize((size.count() + 7) / 8);
    std::size_t bit = 0;
    for (int p = 0; p < counts[2]; ++p) {
        const glm::dvec3 origin = lattice.patient(sampleAt(0, 0, p)).mm;
        made.masks.planes.push_back({origin, lattice.patient(sampleAt(1, 0, p)).mm - origin,
                                     lattice.patient(sampleAt(0, 1, p)).mm - origin, 0});
        for (int r = 0; r < counts[1]; ++r)
            for (int c = 0; c < counts[0]; ++c, ++bit) {
                const VoxelIndex n = sampleAt(c, r, p);
                if (made.truth[size.offsetOf(n.i, n.j, n.k)] != 0)
                    made.bits[bit / 8] |= std::byte(1U << (bit % 8));
            }
    }
    made.masks.pixels = made.bits;
    return made;
}

void expectSame(const Coverage &got, const std::vector<std::uint8_t> &truth, const GridSize &size) {
    std::size_t differing = 0;
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i)
                differing += got.at({i, j, k}) != truth[size.offsetOf(i, j, k)];
    EXPECT_EQ(differing, 0U);
}

TEST(StoredMasks, LandOnTheirSamplesInEveryOrderAndDirectionOfAxes) {
    const GridSize size{11, 7, 13}; // no row is a whole number of bytes
    const Lattice lattice = tilted(size);
    std::array<int, 3> axes{0, 1, 2};
    unsigned seed = 1;
    do
        for (int flip = 0; flip < 8; ++flip) {
            const Scrambled made = scrambled(
                lattice, axes, {(flip & 1) != 0, (flip & 2) != 0, (flip & 4) != 0}, seed++);
            const auto placed = segment::placed(made.masks, lattice);
            EXPECT_FALSE(placed.isResampled);
            expectSame(placed.coverages.at(0), made.truth, size);
        }
    while (std::next_permutation(axes.begin(), axes.end()));
}

TEST(StoredMasks, ShuffledAndMissingPlanesAndRoundedPositionsDoNotMatter) {
    const GridSize size{9, 8, 10};
    const Lattice lattice = tilted(size);
    Scrambled made = scrambled(lattice, {0, 1, 2}, {false, false, false}, 5);
    // Planes 2 and 7 are empty and left out; the others come in another order, and positions have
    // three digits.
    const std::size_t plane = std::size_t(size.i) * std::size_t(size.j);
    const std::array<int, 8> order{9, 0, 4, 1, 8, 3, 6, 5};
    std::vector<std::byte> bits((plane * order.size() + 7) / 8);
    std::vector<MaskPlane> planes;
    std::size_t bit = 0;
    for (const int p : order) {
        MaskPlane moved = made.masks.planes[std::size_t(p)];
        moved.origin = glm::round(moved.origin * 1000.0) / 1000.0;
        planes.push_back(moved);
        for (std::size_t n = 0; n < plane; ++n, ++bit)
            if (made.truth[std::size_t(p) * plane + n] != 0)
                bits[bit / 8] |= std::byte(1U << (bit % 8));
    }
    for (const int p : {2, 7})
        std::fill_n(made.truth.begin() + std::ptrdiff_t(std::size_t(p) * plane), plane,
                    std::uint8_t(0));
    made.masks.planes = planes;
    made.masks.pixels = bits;
    made.masks.thicknessMm = 2.5;
    const auto placed = segment::placed(made.masks, lattice);
    EXPECT_FALSE(placed.isResampled);
    expectSame(placed.coverages.at(0), made.truth, size);
}

TEST(StoredMasks, APartOutsideTheLatticeIsLeftOut) {
    const Lattice large = tilted({12, 12, 12});
    const Scrambled made = scrambled(large, {0, 1, 2}, {false, false, false}, 3);
    const volume::VoxelBox box{{2, 3, 4}, {9, 10, 11}};
    const auto placed = segment::placed(made.masks, large.cropped(box));
    EXPECT_FALSE(placed.isResampled);
    for (int k = 0; k < 7; ++k)
        for (int j = 0; j < 7; ++j)
            for (int i = 0; i < 7; ++i)
                ASSERT_EQ(placed.coverages[0].at({i, j, k}),
                          made.truth[large.size().offsetOf(i + 2, j + 3, k + 4)]);
}

TEST(StoredMasks, FractionsAndLabelsGoToTheirSegments) {
    const GridSize size{6, 5, 3};
    const Lattice lattice = Lattice::centred(size, {1.0, 1.0, 1.0});
    std::vector<std::uint16_t> words(size.count());
    for (std::size_t n = 0; n < words.size(); ++n)
        words[n] = std::uint16_t(n % 5);
    StoredMasks masks;
    masks.columns = size.i;
    masks.rows = size.j;
    masks.pixels = std::as_bytes(std::span(words));
    for (int k = 0; k < size.k; ++k)
        masks.planes.push_back(
            {lattice.patient(VoxelIndex{0, 0, k}).mm, lattice.step(0), lattice.step(1), 0});
    masks.kind = StoredMasks::Pixels::fractions;
    masks.largestFraction = 4;
    const auto fractions = segment::placed(masks, lattice);
    masks.kind = StoredMasks::Pixels::labels;
    masks.segments = 2;
    masks.segmentOfLabel.assign(65536, -1);
    masks.segmentOfLabel[3] = 0;
    masks.segmentOfLabel[1] = 1; // labels 2 and 4 are not described
    const auto labels = segment::placed(masks, lattice);
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i) {
                const int word = words[size.offsetOf(i, j, k)];
                ASSERT_EQ(fractions.coverages[0].at({i, j, k}), std::lround(255.0 * word / 4.0));
                ASSERT_EQ(labels.coverages[0].at({i, j, k}), word == 3 ? 255 : 0);
                ASSERT_EQ(labels.coverages[1].at({i, j, k}), word == 1 ? 255 : 0);
            }
}

// A ball on its own lattice, which is turned and has other steps than the volume's.
TEST(StoredMasks, OtherLatticesGetTheSameBall) {
    const glm::dvec3 centre(3.0, -2.0, 5.0);
    const double radius = 9.0;
    const auto ballOn = [&](const Lattice &own, std::vector<std::uint16_t> &words) {
        const GridSize size = own.size();
        words.assign(size.count(), 0);
        for (int k = 0; k < size.k; ++k)
            for (int j = 0; j < size.j; ++j)
                for (int i = 0; i < size.i; ++i)
                    words[size.offsetOf(i, j, k)] =
                        glm::length(own.patient(VoxelIndex{i, j, k}).mm - centre) <= radius ? 1 : 0;
        StoredMasks masks;
        masks.kind = StoredMasks::Pixels::fractions;
        masks.largestFraction = 1;
        masks.columns = size.i;
        masks.rows = size.j;
        masks.pixels = std::as_bytes(std::span(words));
        for (int k = 0; k < size.k; ++k)
            masks.planes.push_back(
                {own.patient(VoxelIndex{0, 0, k}).mm, own.step(0), own.step(1), 0});
        return masks;
    };
    const glm::dvec3 a = glm::normalize(glm::dvec3(1.0, 0.4, -0.2)),
                     b = glm::normalize(glm::cross(glm::dvec3(0.1, 0.2, 1.0), a)),
                     c = glm::cross(a, b);
    for (const double step : {0.6, 1.0, 2.2}) {
        const Lattice own =
            Lattice::make({int(30 / step), int(30 / step), int(30 / step)},
                          {centre - 15.0 * (a + b + c)}, {step * a, step * b, step * c});
        std::vector<std::uint16_t> words;
        const StoredMasks masks = ballOn(own, words);
        const double ball = double(std::count(words.begin(), words.end(), 1)) * own.cellVolumeMm3();
        for (const glm::dvec3 spacing :
             {glm::dvec3(1.0, 1.0, 1.0), glm::dvec3(0.8, 0.8, 3.0), glm::dvec3(2.5, 2.5, 2.5)}) {
            const Lattice volume = Lattice::centred(
                {int(40 / spacing.x), int(40 / spacing.y), int(40 / spacing.z)}, spacing);
            const auto placed = segment::placed(masks, volume);
            EXPECT_TRUE(placed.isResampled);
            double sum = 0.0;
            glm::dvec3 moment(0.0);
            const Coverage &coverage = placed.coverages.at(0);
            for (int k = coverage.box.lo.k; k < coverage.box.hi.k; ++k)
                for (int j = coverage.box.lo.j; j < coverage.box.hi.j; ++j)
                    for (int i = coverage.box.lo.i; i < coverage.box.hi.i; ++i) {
                        const double share = coverage.at({i, j, k}) / 255.0;
                        sum += share;
                        moment += share * volume.patient(VoxelIndex{i, j, k}).mm;
                    }
            EXPECT_NEAR(sum * volume.cellVolumeMm3() / ball, 1.0, 0.01) << step;
            EXPECT_LT(glm::length(moment / sum - centre), 0.2 * step) << step;
        }
    }
}

// Slices of 5 mm on a volume of 1 mm: each covers five, and a gap of three slices stays empty.
TEST(StoredMasks, ThickPlanesAreInterpolatedButNotAcrossAGap) {
    const Lattice volume = Lattice::centred({8, 8, 60}, {1.0, 1.0, 1.0});
    std::vector<std::byte> bits(8 * 4, std::byte(0xFF));
    StoredMasks masks;
    masks.columns = masks.rows = 8;
    masks.pixels = bits;
    masks.thicknessMm = 5.0;
    const auto at = [&](int k) { return volume.patient(VoxelIndex{0, 0, k}).mm; };
    for (const int k : {10, 15, 35, 40})
        masks.planes.push_back({at(k), volume.step(0), volume.step(1), 0});
    const auto placed = segment::placed(masks, volume);
    EXPECT_TRUE(placed.isResampled);
    const auto share = [&](int k) { return int(placed.coverages[0].at({4, 4, k})); };
    for (const int k : {10, 12, 15, 35, 40})
        EXPECT_EQ(share(k), 255) << k;
    for (const int k : {5, 20, 25, 30, 45, 50})
        EXPECT_EQ(share(k), 0) << k;
    EXPECT_NEAR(share(7), 255 * 2 / 5, 1); // half of it 2.5 mm beyond the outermost plane
    EXPECT_NEAR(share(18), 255 * 2 / 5, 1);
}

// Squares of 8 x 8 mm at these depths on a volume with slices of 1 mm.
double millilitresOf(const std::vector<double> &depths, double statedMm) {
    const Lattice volume = Lattice::centred({8, 8, 100}, {1.0, 1.0, 1.0});
    std::vector<std::byte> bits(8 * depths.size(), std::byte(0xFF));
    StoredMasks masks;
    masks.columns = masks.rows = 8;
    masks.pixels = bits;
    masks.thicknessMm = statedMm;
    const glm::dvec3 low = volume.patient(VoxelIndex{0, 0, 0}).mm;
    for (const double depth : depths)
        masks.planes.push_back(
            {low + glm::dvec3(0.0, 0.0, depth), volume.step(0), volume.step(1), 0});
    const auto placed = segment::placed(masks, volume);
    return placed.coverages[0].total() / 1000.0;
}

// The spacing of a scan may change, and planes of one position may be written with other digits.
TEST(StoredMasks, UnevenPlanesFillTheSpaceBetweenThem) {
    const double square = 0.064; // ml for each mm
    // From half of the first distance before to half of the last one behind.
    EXPECT_NEAR(millilitresOf({10.3, 14.3, 18.3, 19.4, 26.4, 33.4, 40.4}, 4.0),
                square * (30.1 + 2.0 + 3.5), 0.1);
    EXPECT_NEAR(millilitresOf({10.5, 13.5, 16.5, 19.5, 22.5}, 3.0), square * 15.0, 0.05);
    EXPECT_NEAR(millilitresOf({10.5, 13.5, 16.5, 19.5, 22.5, 10.61}, 3.0), square * 15.0, 0.05);
    EXPECT_NEAR(millilitresOf({10.5, 12.5, 16.5, 20.5, 22.5}, 0.0), square * 14.0, 0.05);
    // Two parts of a segment are not one.
    EXPECT_NEAR(millilitresOf({10.5, 12.5, 14.5, 40.5, 42.5, 44.5}, 2.0), square * 12.0, 0.05);
}

// Another origin in every plane, on a volume that is turned.
TEST(StoredMasks, ShiftedPlanesAreWhole) {
    const glm::dvec3 a = glm::normalize(glm::dvec3(1, 1, 0)), b(-a.y, a.x, 0.0);
    const Lattice volume =
        Lattice::make({110, 90, 30}, {glm::dvec3(30.0, -60.0, -3.0)}, {a, b, glm::dvec3(0, 0, 1)});
    std::vector<std::byte> bits(20 * 20 * 20 / 8, std::byte(0xFF));
    StoredMasks masks;
    masks.columns = masks.rows = 20;
    masks.pixels = bits;
    for (int n = 0; n < 20; ++n)
        masks.planes.push_back(
            {glm::dvec3(30.0 + n, 10.0 - n, n + 0.5), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), 0});
    EXPECT_NEAR(segment::placed(masks, volume).coverages[0].total(), 8000.0, 80.0);
}

TEST(StoredMasks, PlanesThatAreNotParallelAreRefused) {
    const Lattice volume = Lattice::centred({8, 8, 8}, {1.0, 1.0, 1.0});
    std::vector<std::byte> bits(16, std::byte(0xFF));
    StoredMasks masks;
    masks.columns = masks.rows = 8;
    masks.pixels = bits;
    masks.planes = {{{0.2, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0}, {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0}};
    EXPECT_THROW(segment::placed(masks, volume), task::Error);
}

} // namespace
} // namespace pellucid
