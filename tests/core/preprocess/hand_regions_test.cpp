// SPDX-License-Identifier: GPL-3.0-or-later
// Regions that are painted, cut, and combined.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <itkBinaryFillholeImageFilter.h>
#include <itkImage.h>

#include "core/classify/region_edits.h"
#include "core/phantom/phantom.h"
#include "core/preprocess/class_region.h"
#include "core/preprocess/hand_regions.h"
#include "core/preprocess/morphology.h"
#include "core/preprocess/region_growing.h"
#include "core/preprocess/step_cache.h"

namespace pellucid {
namespace {

using classify::LassoCut;
using classify::Region;
using classify::Step;
using classify::StepKind;
using classify::Stroke;
using classify::TissueClass;
using preprocess::Mask;
using volume::Coverage;
using volume::GridSize;
using volume::Lattice;
using volume::PatientPoint;
using volume::Volume;
using volume::VoxelIndex;

// Anisotropic, turned and sheared.
Lattice tilted() {
    return Lattice::make(
        {21, 18, 13}, {{-12.0, 7.0, 30.0}},
        {glm::dvec3(0.9, 0.1, 0.0), glm::dvec3(-0.1, 1.1, 0.2), glm::dvec3(0.1, 0.6, 2.4)});
}

template <class F> void forAll(const GridSize &size, const F &visit) {
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i)
                visit(VoxelIndex{i, j, k}, size.offsetOf(i, j, k));
}

double distance(const glm::dvec3 &p, const classify::Path &path) {
    double least = glm::length(p - path[0].mm);
    for (std::size_t n = 1; n < path.size(); ++n) {
        constexpr int parts = 2000;
        for (int part = 0; part <= parts; ++part) {
            const double t = double(part) / parts;
            least = std::min(least, glm::length(p - ((1.0 - t) * path[n - 1].mm + t * path[n].mm)));
        }
    }
    return least;
}

TEST(Paint, CoversTheSamplesWithinTheBallsOfAPath) {
    const Lattice lattice = tilted();
    const auto point = [&](double i, double j, double k) {
        return lattice.patient(volume::VoxelPoint{{i, j, k}});
    };
    const Stroke painted{{point(2, 3, 1), point(15, 8, 6), point(30, 8, 6)}, 3.0, false};
    const Stroke erased{{point(10, 6, 4)}, 2.2, true};
    std::vector<Region> regions(lattice.size().count(), Region::outside);
    preprocess::paint(lattice, {painted, erased}, regions);
    forAll(lattice.size(), [&](VoxelIndex n, std::size_t at) {
        const glm::dvec3 p = lattice.patient(n).mm;
        const double in = distance(p, painted.path), out = distance(p, erased.path);
        if (std::abs(in - 3.0) < 1e-2 || std::abs(out - 2.2) < 1e-2)
            return; // the sampled path is not that exact
        const bool isPainted = in < 3.0 && out > 2.2;
        EXPECT_EQ(regions[at] == Region::filled, isPainted) << n.i << ' ' << n.j << ' ' << n.k;
    });
}

TEST(Paint, ReachesASampleWithTheSmallestBall) {
    const Lattice lattice = tilted();
    std::vector<Region> regions(lattice.size().count(), Region::outside);
    const PatientPoint between = lattice.patient(volume::VoxelPoint{{4.4, 5.4, 6.4}});
    const PatientPoint away = lattice.patient(volume::VoxelPoint{{1e7, 5.4, 6.4}});
    preprocess::paint(lattice, {{{between}, 0.1, false}, {{away}, 0.1, false}}, regions);
    EXPECT_EQ(std::count(regions.begin(), regions.end(), Region::filled), 1);
    EXPECT_EQ(regions[lattice.size().offsetOf(4, 5, 6)], Region::filled);
}

// Of a point in the plane, around corners that are seen along a direction; by angles.
int winding(const glm::dvec3 &p, const LassoCut &cut) {
    const glm::dvec3 other =
        std::abs(cut.sight.z) < 0.7 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(cut.sight, other)), v = glm::cross(cut.sight, u);
    double turned = 0.0;
    for (std::size_t n = 0; n < cut.outline.size(); ++n) {
        const glm::dvec3 a = cut.outline[n].mm - p,
                         b = cut.outline[(n + 1) % cut.outline.size()].mm - p;
        const double ax = glm::dot(a, u), ay = glm::dot(a, v), bx = glm::dot(b, u),
                     by = glm::dot(b, v);
        turned += std::atan2(ax * by - ay * bx, ax * bx + ay * by);
    }
    return int(std::lround(turned / (2.0 * 3.14159265358979)));
}

TEST(Scissors, CutThePrismOverAnOutline) {
    const Lattice lattice = tilted();
    std::mt19937 random(5);
    std::uniform_real_distribution<double> anywhere(-16.0, 16.0);
    const std::vector<glm::dvec3> sights{{0, 0, 1},
                                         {0, -1, 0},
                                         glm::normalize(lattice.step(0)),
                                         glm::normalize(glm::dvec3(1, 2, 3)),
                                         glm::normalize(glm::dvec3(-0.2, 0.1, -1.0))};
    int inside = 0, all = 0;
    for (const glm::dvec3 &sight : sights)
        for (int turn = 0; turn < 6; ++turn) {
            LassoCut cut{{}, sight, std::nullopt, turn % 2 == 1};
            for (int corner = 0; corner < 3 + turn; ++corner) // crosses itself
                cut.outline.push_back(
                    {lattice.center().mm +
                     glm::dvec3(anywhere(random), anywhere(random), anywhere(random))});
            const double middle = glm::dot(lattice.center().mm, sight);
            if (turn >= 3)
                cut.slabMm = {middle - 4.0, middle + 3.0};
            const Mask mask = preprocess::remaining(lattice, {cut});
            forAll(lattice.size(), [&](VoxelIndex n, std::size_t at) {
                const glm::dvec3 p = lattice.patient(n).mm;
                const double depth = glm::dot(p, sight);
                const bool isIn = winding(p, cut) != 0 &&
                                  (!cut.slabMm || (depth >= middle - 4.0 && depth <= middle + 3.0));
                EXPECT_EQ(mask[at] != 0, isIn == cut.keeps) << n.i << ' ' << n.j << ' ' << n.k;
                inside += isIn ? 1 : 0;
                ++all;
            });
        }
    EXPECT_GT(inside, all / 20);
    EXPECT_LT(inside, all / 2);
}

// Random blobs of values 0..99.
Volume blobs() {
    const Lattice lattice = tilted();
    std::mt19937 random(3);
    std::vector<std::int16_t> samples(lattice.size().count());
    for (std::int16_t &sample : samples)
        sample = std::int16_t(random() % 100);
    return {lattice, samples, volume::ValueUnit::none, {}};
}

Mask maskOf(const Volume &volume, const TissueClass &tissue) {
    preprocess::StepCache steps(std::size_t(1) << 28);
    const Coverage region = preprocess::regionOf(volume, tissue, steps);
    Mask mask(volume.lattice().size().count());
    forAll(volume.lattice().size(),
           [&](VoxelIndex n, std::size_t at) { mask[at] = region.at(n) >= 128; });
    return mask;
}

TissueClass range(double low, double high) {
    TissueClass tissue;
    tissue.name = "range";
    tissue.low = low;
    tissue.high = high;
    return tissue;
}

TissueClass with(TissueClass tissue, const Step &step) {
    tissue.steps.push_back(step);
    return tissue;
}

Step combining(StepKind kind, const TissueClass &other) {
    Step step{kind};
    step.operand.own = std::make_shared<const TissueClass>(other);
    return step;
}

TEST(RegionSteps, CombineClasses) {
    const Volume volume = blobs();
    const TissueClass one = range(0.0, 59.0), other = range(40.0, 99.0);
    const Mask a = maskOf(volume, one), b = maskOf(volume, other),
               both = maskOf(volume, with(one, combining(StepKind::intersection, other))),
               either = maskOf(volume, with(one, combining(StepKind::join, other))),
               without = maskOf(volume, with(one, combining(StepKind::difference, other)));
    TissueClass drawn = range(classify::lowestValue, classify::highestValue);
    drawn.isDrawn = true;
    const Mask added = maskOf(volume, with(drawn, combining(StepKind::join, other)));
    std::size_t empty = 0;
    for (const std::uint8_t m : maskOf(volume, drawn))
        empty += m;
    EXPECT_EQ(empty, 0U);
    for (std::size_t n = 0; n < a.size(); ++n) {
        EXPECT_EQ(both[n], a[n] & b[n]);
        EXPECT_EQ(either[n], a[n] | b[n]);
        EXPECT_EQ(without[n], a[n] & ~b[n] & 1);
        EXPECT_EQ(added[n], b[n]);
    }
}

TEST(RegionSteps, AreTheFiltersOnTheClass) {
    const Volume volume = blobs();
    const Lattice &lattice = volume.lattice();
    const TissueClass one = range(0.0, 64.0);
    const Mask a = maskOf(volume, one);
    EXPECT_EQ(maskOf(volume, with(one, {StepKind::grow, {{"mm", 1.3}}})),
              preprocess::dilated(lattice, a, 1.3));
    EXPECT_EQ(maskOf(volume, with(one, {StepKind::shrink, {{"mm", 1.0}}})),
              preprocess::eroded(lattice, a, 1.0));
    VoxelIndex seed{10, 9, 6};
    while (a[lattice.size().offsetOf(seed.i, seed.j, seed.k)] == 0)
        ++seed.i;
    Step connected{StepKind::connected};
    EXPECT_EQ(maskOf(volume, with(one, connected)), a); // still waits for a point
    connected.points = {lattice.patient(seed)};
    const Mask grown = maskOf(volume, with(one, connected));
    EXPECT_EQ(grown, preprocess::connected(lattice.size(), a, {seed}));
    // A point beside the class starts from the nearest sample of it, and a far one from none.
    connected.points = {{lattice.patient(seed).mm + 0.4 * lattice.step(0)}};
    EXPECT_EQ(maskOf(volume, with(one, connected)), grown);
    connected.points = {{lattice.center().mm + glm::dvec3(1000.0, 0.0, 0.0)}};
    EXPECT_EQ(maskOf(volume, with(one, connected)), Mask(a.size()));
}

TEST(RegionSteps, FillTheHolesThatItkFills) {
    using Image = itk::Image<std::uint8_t, 3>;
    const Volume volume = blobs();
    const GridSize size = volume.lattice().size();
    for (const double high : {40.0, 70.0, 80.0, 90.0}) {
        const TissueClass one = range(0.0, high);
        Mask mask = maskOf(volume, one);
        auto image = Image::New();
        image->SetRegions(
            Image::SizeType{{std::size_t(size.i), std::size_t(size.j), std::size_t(size.k)}});
        image->GetPixelContainer()->SetImportPointer(mask.data(), mask.size(), false);
        auto fill = itk::BinaryFillholeImageFilter<Image>::New();
        fill->SetForegroundValue(1);
        fill->SetFullyConnected(false);
        fill->SetInput(image);
        fill->Update();
        const std::uint8_t *const filled = fill->GetOutput()->GetBufferPointer();
        EXPECT_EQ(maskOf(volume, with(one, {StepKind::fill})), Mask(filled, filled + mask.size()));
    }
}

// Two balls joined by a bridge of two samples.
TEST(RegionSteps, ALeakLimitKeepsARegionFromPassingABridge) {
    const Lattice lattice = Lattice::centred({40, 16, 16}, {1.0, 1.0, 1.0});
    std::vector<std::int16_t> samples(lattice.size().count(), 0);
    Mask left(samples.size());
    forAll(lattice.size(), [&](VoxelIndex n, std::size_t at) {
        const glm::dvec3 p = lattice.patient(n).mm;
        left[at] = glm::length(p - glm::dvec3(-11.0, 0.0, 0.0)) < 6.0;
        const bool right = glm::length(p - glm::dvec3(11.0, 0.0, 0.0)) < 6.0,
                   bridge = std::abs(p.x) < 11.0 && std::abs(p.y) < 1.0 && std::abs(p.z) < 1.0;
        samples[at] = left[at] != 0 || right || bridge ? 100 : 0;
    });
    const Volume volume(lattice, samples, volume::ValueUnit::none, {});
    const PatientPoint point{{-11.0, 0.0, 0.0}};
    const auto region = [&](double leakMm) {
        return maskOf(volume, classify::connectedRegion(point, 50.0, 150.0, leakMm));
    };
    const auto count = [](const Mask &mask) { return std::count(mask.begin(), mask.end(), 1); };
    EXPECT_GT(count(region(0.0)), 2 * count(left));
    // A ball of 4 mm reaches all of the left ball but what is narrower than itself. Where the
    // bridge begins, it reaches as far into that as its radius.
    const Mask reached = region(4.0), least = preprocess::opening(lattice, left, 2.0);
    forAll(lattice.size(), [&](VoxelIndex n, std::size_t at) {
        EXPECT_GE(reached[at], least[at]) << n.i << ' ' << n.j << ' ' << n.k;
        if (lattice.patient(n).mm.x > -11.0 + 6.0 + 2.0) {
            EXPECT_EQ(reached[at], 0) << n.i << ' ' << n.j << ' ' << n.k;
        }
    });
    EXPECT_EQ(count(region(30.0)), 0); // nothing is that wide
}

// The border of a class with filled samples fades, and its inside is whole.
TEST(RegionSteps, FadeAtTheEdgeOfPaintedRegions) {
    const Volume volume = blobs();
    const Lattice &lattice = volume.lattice();
    TissueClass drawn = range(classify::lowestValue, classify::highestValue);
    drawn.isDrawn = true;
    drawn.edge = 0.5;
    Step painted{StepKind::paint};
    painted.strokes = {{{lattice.center()}, 4.0, false}};
    preprocess::StepCache steps(std::size_t(1) << 28);
    const auto samples = steps.run(volume, with(drawn, painted), {});
    ASSERT_TRUE(samples.coverage);
    int whole = 0, partial = 0;
    forAll(lattice.size(), [&](VoxelIndex n, std::size_t at) {
        const double mm = glm::length(lattice.patient(n).mm - lattice.center().mm);
        const int share = samples.coverage->at(n);
        whole += share == Coverage::whole ? 1 : 0;
        partial += share > 0 && share < Coverage::whole ? 1 : 0;
        if (mm > 12.0) {
            EXPECT_EQ(share, 0);
        }
        if (samples.regions && mm > 4.0) {
            EXPECT_NE((*samples.regions)[at], Region::filled);
        }
    });
    EXPECT_GT(whole + partial, 50);
    EXPECT_GT(partial, 20);
}

TEST(RegionSteps, WorkOnOneSliceAndOnNothing) {
    const Lattice slice = Lattice::centred({12, 10, 1}, {1.0, 1.0, 5.0});
    std::vector<std::int16_t> samples(slice.size().count(), 0);
    for (int j = 2; j < 8; ++j)
        for (int i = 2; i < 9; ++i) // a ring, which has a way out through its faces
            samples[slice.size().offsetOf(i, j, 0)] = j > 3 && j < 6 && i > 3 && i < 7 ? 0 : 100;
    const Volume volume(slice, samples, volume::ValueUnit::none, {});
    const TissueClass ring = range(50.0, 150.0), none = range(500.0, 600.0);
    const Mask all = maskOf(volume, ring);
    EXPECT_EQ(maskOf(volume, with(ring, {StepKind::fill})), all);
    Step connected{StepKind::connected};
    connected.points = {slice.patient(VoxelIndex{2, 2, 0})};
    EXPECT_EQ(maskOf(volume, with(ring, connected)), all);
    EXPECT_GT(std::count(all.begin(), all.end(), 1), 20);
    const Mask grown = maskOf(volume, with(ring, {StepKind::grow, {{"mm", 1.0}}}));
    EXPECT_GT(std::count(grown.begin(), grown.end(), 1), std::count(all.begin(), all.end(), 1));
    for (const Step &step :
         {Step{StepKind::fill}, Step{StepKind::grow}, Step{StepKind::shrink}, connected,
          Step{StepKind::largestComponent}, combining(StepKind::difference, ring)})
        EXPECT_EQ(maskOf(volume, with(none, step)), Mask(all.size())) << stepText(step);
}

TEST(RegionSteps, OfHandsAreCachedByAllThatTheyContain) {
    const Volume volume = blobs();
    const Lattice &lattice = volume.lattice();
    preprocess::StepCache steps(std::size_t(1) << 28);
    TissueClass tissue = range(0.0, 64.0);
    Step painted{StepKind::paint};
    painted.strokes = {{{lattice.center()}, 3.0, false}};
    tissue.steps = {painted};
    const auto total = [&] { return preprocess::regionOf(volume, tissue, steps).total(); };
    const double first = total();
    EXPECT_EQ(total(), first);
    EXPECT_EQ(steps.computedCount(), 1U);
    tissue.steps.front().strokes.front().radiusMm = 4.0;
    const double wider = total();
    EXPECT_GT(wider, first);
    tissue.steps.front().strokes.front().erases = true;
    EXPECT_LT(total(), first);
    tissue.steps.front().strokes.front().path = {{lattice.center().mm + glm::dvec3(3.0, 0.0, 0.0)}};
    total();
    EXPECT_EQ(steps.computedCount(), 4U);
    // An operand that differs within.
    tissue.steps = {combining(StepKind::difference, range(0.0, 10.0))};
    const double without = total();
    tissue.steps = {combining(StepKind::difference, range(0.0, 20.0))};
    EXPECT_LT(total(), without);
}

TEST(RegionSteps, BoneIsTakenWithItsMarrow) {
    const Volume head = phantom::makePhantom(
        phantom::Kind::head,
        phantom::phantomLattice(phantom::Kind::head, {.size = GridSize{64, 64, 40}}));
    VoxelIndex densest{};
    forAll(head.lattice().size(), [&](VoxelIndex n, std::size_t) {
        if (head.value(n) > head.value(densest))
            densest = n;
    });
    const Mask bone =
        maskOf(head, classify::boneRegion(head.lattice(), head.lattice().patient(densest), 200.0));
    const Mask dense = maskOf(head, range(200.0, classify::highestValue));
    std::size_t count = 0, kept = 0;
    for (std::size_t n = 0; n < bone.size(); ++n) {
        count += bone[n];
        kept += bone[n] & dense[n];
    }
    EXPECT_GT(kept, count / 4);
    EXPECT_GT(count, kept); // the rim
}

} // namespace
} // namespace pellucid
