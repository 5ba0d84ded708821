// SPDX-License-Identifier: GPL-3.0-or-later
// Classes of segments, and regions that grow from a point.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <itkConnectedThresholdImageFilter.h>
#include <itkImage.h>

#include "core/classify/shown_fields.h"
#include "core/phantom/phantom.h"
#include "core/preprocess/class_region.h"
#include "core/preprocess/parts.h"
#include "core/preprocess/reasons.h"
#include "core/preprocess/region_growing.h"
#include "core/preprocess/segment_class.h"
#include "core/preprocess/step_cache.h"
#include "core/segment/coverages.h"
#include "core/task/error.h"

namespace pellucid {
namespace {

using classify::TissueClass;
using preprocess::Growth;
using preprocess::Mask;
using volume::Coverage;
using volume::GridSize;
using volume::Lattice;
using volume::Volume;
using volume::VoxelIndex;

constexpr classify::FieldWindow window{-1000.0, 1000.0};

Volume head() {
    return phantom::makePhantom(
        phantom::Kind::head,
        phantom::phantomLattice(phantom::Kind::head, {.size = GridSize{40, 40, 24}}));
}

// Overlapping boxes with random shares.
std::shared_ptr<const segment::SegmentSet> boxes(const Lattice &lattice, int count) {
    std::mt19937 random(11);
    segment::Segmentation segmentation;
    segmentation.title = "boxes";
    for (int n = 0; n < count; ++n) {
        Coverage coverage{{{n % 7, n % 5, n % 3}, {30 - n % 4, 33 - n % 6, 20 - n % 2}}, {}};
        for (std::size_t s = coverage.box.size().count(); s > 0; --s)
            coverage.shares.push_back(std::uint8_t(random() % 3 == 0 ? 0 : random()));
        segment::Segment segment;
        segment.name = "box " + std::to_string(n);
        segment.id = std::uint64_t(n) + 1'000'000;
        segment.coverage = std::make_shared<const Coverage>(coverage);
        segmentation.segments.push_back(segment);
    }
    return segment::SegmentSet(lattice).with(segmentation);
}

TEST(SegmentClasses, AreDensityTimesShareInTheirColors) {
    const Volume volume = head();
    const auto set = boxes(volume.lattice(), 5);
    preprocess::StepCache steps(std::size_t(1) << 28);
    preprocess::ClassRunner runner(steps, set);
    classify::Look look;
    const auto &segments = set->segmentations().front().segments;
    for (std::size_t n = 0; n < segments.size(); ++n) {
        TissueClass tissue = preprocess::classOf(segments[n], n);
        tissue.weight = 0.3 + 0.2 * double(n);
        tissue.edge = n % 2 == 0 ? 0.5 : 0.0;
        look.classes.push_back(tissue);
    }
    const auto fields = classify::shownFields(volume, window, look, &runner);
    ASSERT_EQ(fields.channels.size(), 3U); // whatever the number of segments
    const GridSize size = volume.lattice().size();
    std::vector<Coverage> soft;
    for (std::size_t n = 0; n < segments.size(); ++n)
        soft.push_back(segment::softened(*segments[n].coverage, size, look.classes[n].edge));
    for (int k = 0; k < size.k; k += 3)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i) {
                const double f = std::clamp((volume.value({i, j, k}) + 1000.0) / 2000.0, 0.0, 1.0);
                glm::dvec3 expected(0.0), got(0.0);
                for (std::size_t n = 0; n < soft.size(); ++n) {
                    const classify::Color &c = look.classes[n].color;
                    expected += look.classes[n].weight * f * soft[n].at({i, j, k}) / 255.0 *
                                glm::dvec3(c.red, c.green, c.blue);
                }
                for (std::size_t c = 0; c < 3; ++c) {
                    const classify::Color &basis = fields.colors[c];
                    got += fields.channels[c].values.value({i, j, k}) *
                           glm::dvec3(basis.red, basis.green, basis.blue);
                }
                ASSERT_LT(glm::length(got - expected), 1e-5);
            }
}

TEST(SegmentClasses, NeedTheirSegment) {
    const Volume volume = head();
    preprocess::StepCache steps(0);
    TissueClass tissue{"liver", -1000.0, 3000.0};
    tissue.segment = "liver";
    try {
        classify::classField(volume, window, tissue, &steps);
        ADD_FAILURE() << "a segment that is not loaded was shown";
    } catch (const task::Error &error) {
        EXPECT_EQ(error.reason(), task::because::segmentIsMissing("liver", "liver"));
    }
    EXPECT_THROW(classify::classField(volume, window, tissue, nullptr), task::Error);
}

// The range, the steps and the segment all decide; a coarse volume gets the coarse segment.
TEST(SegmentClasses, CombineWithRangeStepsAndCoarseVolumes) {
    const Volume volume = head();
    const GridSize size = volume.lattice().size();
    const auto set = boxes(volume.lattice(), 1);
    const Coverage &box = *set->find("box 0")->coverage;
    preprocess::StepCache steps(std::size_t(1) << 28);
    preprocess::ClassRunner runner(steps, set);
    TissueClass tissue{"bone", 250.0, 2500.0};
    tissue.segment = "box 0";
    const Coverage alone = preprocess::regionOf(volume, tissue, runner);
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i) {
                const double value = volume.value({i, j, k});
                ASSERT_EQ(int(alone.at({i, j, k})),
                          value >= 250.0 && value <= 2500.0 ? int(box.at({i, j, k})) : 0);
            }
    tissue.steps = {{classify::StepKind::largestComponent, {}}};
    const Coverage largest = preprocess::regionOf(volume, tissue, runner);
    Mask mask(size.count());
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i)
                mask[size.offsetOf(i, j, k)] = 2 * alone.at({i, j, k}) >= 255;
    const Mask part = preprocess::largestPart(volume.lattice(), mask);
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i)
                if (part[size.offsetOf(i, j, k)] != 0) {
                    ASSERT_EQ(largest.at({i, j, k}), box.at({i, j, k}));
                }
    // The same class with soft edges reaches beyond its region, and nowhere else is it more.
    tissue.edge = 0.5;
    const auto soft = runner.run(volume, tissue, {});
    ASSERT_TRUE(soft.coverage);
    EXPECT_FALSE(soft.regions);
    const Lattice coarse =
        Lattice::make({20, 20, 12}, volume.lattice().patient(volume::VoxelPoint{{0.5, 0.5, 0.5}}),
                      {2.0 * volume.lattice().step(0), 2.0 * volume.lattice().step(1),
                       2.0 * volume.lattice().step(2)});
    const Volume small(coarse, std::vector<std::int16_t>(coarse.size().count(), 500),
                       volume::ValueUnit::hounsfield);
    tissue.steps.clear();
    tissue.edge = 0.0;
    EXPECT_EQ(*runner.run(small, tissue, {}).coverage,
              segment::coarsened(box, volume.lattice(), coarse));
}

TEST(RegionGrowing, IsThatOfItk) {
    const Volume volume = head();
    const GridSize size = volume.lattice().size();
    using Image = itk::Image<float, 3>;
    using MaskImage = itk::Image<std::uint8_t, 3>;
    const auto image = Image::New();
    image->SetRegions(Image::RegionType(Image::SizeType{
        {itk::SizeValueType(size.i), itk::SizeValueType(size.j), itk::SizeValueType(size.k)}}));
    image->Allocate();
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i)
                image->SetPixel({{i, j, k}}, float(volume.value({i, j, k})));
    std::mt19937 random(5);
    int grown = 0;
    for (int round = 0; round < 20; ++round) {
        Growth growth;
        for (int s = 0; s < 2; ++s)
            growth.seeds.push_back({int(random() % 40), int(random() % 40), int(random() % 24)});
        const double value = volume.value(growth.seeds[0]);
        growth.low = value - 60.0;
        growth.high = value + 60.0;
        const auto filter = itk::ConnectedThresholdImageFilter<Image, MaskImage>::New();
        filter->SetInput(image);
        filter->SetLower(float(growth.low));
        filter->SetUpper(float(growth.high));
        filter->SetReplaceValue(1);
        for (const VoxelIndex &seed : growth.seeds)
            filter->AddSeed({{seed.i, seed.j, seed.k}});
        filter->Update();
        const Mask region = preprocess::grownRegion(volume, growth);
        for (int k = 0; k < size.k; ++k)
            for (int j = 0; j < size.j; ++j)
                for (int i = 0; i < size.i; ++i) {
                    ASSERT_EQ(region[size.offsetOf(i, j, k)],
                              filter->GetOutput()->GetPixel({{i, j, k}}));
                    grown += region[size.offsetOf(i, j, k)];
                }
    }
    EXPECT_GT(grown, 10000);
}

// Two balls joined by a tube: a leak limit wider than the tube separates them.
TEST(RegionGrowing, DoesNotLeakThroughANarrowOpening) {
    const Lattice lattice = Lattice::centred({60, 24, 24}, {1.0, 1.0, 1.5});
    const GridSize size = lattice.size();
    std::vector<std::int16_t> samples(size.count(), 0);
    const auto at = [&](int i, int j, int k) -> std::int16_t & {
        return samples[size.offsetOf(i, j, k)];
    };
    const glm::dvec3 a(-18.0, 0.0, 0.0), b(18.0, 0.0, 0.0);
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i) {
                const glm::dvec3 p = lattice.patient(VoxelIndex{i, j, k}).mm;
                const bool isTube = std::abs(p.x) < 18.0 && std::hypot(p.y, p.z) <= 2.0;
                if (isTube || glm::length(p - a) <= 8.0 || glm::length(p - b) <= 8.0)
                    at(i, j, k) = 100;
            }
    const Volume volume(lattice, samples, volume::ValueUnit::none);
    const VoxelIndex inA{12, 12, 12}, inB{47, 12, 12};
    const auto contains = [&](const Mask &mask, VoxelIndex n) {
        return mask[size.offsetOf(n.i, n.j, n.k)] != 0;
    };
    const Mask leaking = preprocess::grownRegion(volume, {{inA}, 50.0, 150.0, 0.0});
    EXPECT_TRUE(contains(leaking, inB));
    const Mask held = preprocess::grownRegion(volume, {{inA}, 50.0, 150.0, 6.0});
    EXPECT_FALSE(contains(held, inB));
    // All of the ball but for its roughest corners, and a little of the tube.
    int ball = 0, both = 0;
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i)
                if (glm::length(lattice.patient(VoxelIndex{i, j, k}).mm - a) <= 8.0) {
                    ++ball;
                    both += contains(held, {i, j, k});
                }
    EXPECT_GT(both, ball * 97 / 100);
    try {
        preprocess::grownRegion(volume, {{{30, 12, 12}}, 50.0, 150.0, 6.0}); // within the tube
        ADD_FAILURE() << "grew from a place narrower than the leak limit";
    } catch (const task::Error &error) {
        EXPECT_EQ(error.reason(), task::because::seedInANarrowPlace);
    }
    try {
        preprocess::grownRegion(volume, {{{0, 0, 0}, {-5, 2, 900}}, 50.0, 150.0, 0.0});
        ADD_FAILURE() << "grew from a value outside the range";
    } catch (const task::Error &error) {
        EXPECT_EQ(error.reason(), task::because::seedOutsideRange);
    }
}

TEST(RegionGrowing, StopsWhenCancelled) {
    const Lattice lattice = Lattice::centred({200, 200, 100}, {1.0, 1.0, 1.0});
    const Volume volume(lattice, std::vector<std::int16_t>(lattice.size().count(), 1),
                        volume::ValueUnit::none);
    std::stop_source source;
    source.request_stop();
    EXPECT_THROW(preprocess::grownRegion(volume, {{{5, 5, 5}}, 0.0, 2.0, 0.0},
                                         task::Progress(source.get_token())),
                 task::Cancelled);
}

} // namespace
} // namespace pellucid
