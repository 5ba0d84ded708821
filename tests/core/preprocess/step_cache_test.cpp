// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/step_cache.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/classify/shown_fields.h"
#include "core/phantom/phantom.h"
#include "core/system/content_digest.h"
#include "core/task/error.h"

namespace pellucid {
namespace {

using classify::Region;
using classify::StepKind;
using classify::TissueClass;

volume::Volume head() {
    return phantom::makePhantom(
        phantom::Kind::head,
        phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{40, 40, 24}}));
}

TissueClass bone(std::vector<classify::Step> steps) {
    TissueClass tissue{"bone", 250, 2500, 150};
    tissue.steps = std::move(steps);
    return tissue;
}

TEST(ContentDigest, IsXxh3With128Bits) {
    // The published test value for no bytes.
    EXPECT_EQ(system::contentDigest({}), "99aa06d3014798d86001c324468d497f");
    std::vector<std::byte> bytes(1000);
    const std::string zeros = system::contentDigest(bytes);
    bytes[999] = std::byte{1};
    EXPECT_NE(system::contentDigest(bytes), zeros);
    EXPECT_NE(system::contentDigest(std::span(bytes).first(999)), zeros);
}

TEST(StepCache, ComputesByContentOnce) {
    preprocess::StepCache cache(std::size_t(1) << 30);
    const TissueClass smooth =
        bone({{StepKind::gaussian, {{"sigma_mm", 2.0}}}, {StepKind::largestComponent, {}}});
    const auto first = cache.run(head(), smooth, {});
    EXPECT_EQ(cache.computedCount(), 2U);
    // The series is loaded again; the class differs in weight and color only.
    TissueClass again = smooth;
    again.weight = 0.3;
    again.color = {1.0, 0.0, 0.0};
    const auto second = cache.run(head(), again, {});
    EXPECT_EQ(cache.computedCount(), 2U);
    EXPECT_EQ(first.regions, second.regions);
    // The range affects the largest part, not the smoothing.
    again.low = 300.0;
    cache.run(head(), again, {});
    EXPECT_EQ(cache.computedCount(), 3U);
    again.steps[0].parameters["sigma_mm"] = 2.5;
    cache.run(head(), again, {});
    EXPECT_EQ(cache.computedCount(), 5U);
}

TEST(StepCache, DropsWhatWasUsedLongestAgo) {
    const std::size_t one = std::size_t(40) * 40 * 24 * 4; // smoothed values are floats
    preprocess::StepCache cache(2 * one);
    const auto with = [](double sigma) {
        return bone({{StepKind::gaussian, {{"sigma_mm", sigma}}}});
    };
    cache.run(head(), with(1.0), {});
    cache.run(head(), with(2.0), {});
    cache.run(head(), with(1.0), {});
    cache.run(head(), with(3.0), {}); // drops 2.0
    EXPECT_LE(cache.bytes(), 2 * one);
    cache.run(head(), with(1.0), {});
    EXPECT_EQ(cache.computedCount(), 3U);
    cache.run(head(), with(2.0), {});
    EXPECT_EQ(cache.computedCount(), 4U);
    cache.trim(0);
    EXPECT_EQ(cache.bytes(), 0U);
}

TEST(StepCache, EdgesAreShownWithADensityOfOneWithinTheRange) {
    preprocess::StepCache cache(0);
    TissueClass edges{"edges", -600, 3000, 100};
    edges.steps = {{StepKind::edges, {{"sigma_mm", 2.0}}}};
    const auto volume = head();
    const auto samples = cache.run(volume, edges, {});
    EXPECT_EQ(samples.density, classify::DensityKind::one);
    const auto field = classify::classField(volume, {-900, 2000}, edges, &cache);
    int ones = 0;
    for (int n = 0; n < 40 * 40 * 24; ++n) {
        const volume::VoxelIndex at{n % 40, n / 40 % 40, n / 1600};
        const double value = volume.value(at);
        const double expected =
            (*samples.regions)[std::size_t(n)] == Region::outside ? 0.0 : edges.membership(value);
        EXPECT_NEAR(field.values.value(at), expected, 1e-6);
        ones += expected == 1.0;
    }
    EXPECT_GT(ones, 500);
}

TEST(StepCache, BinariseGivesNothingButZeroAndOne) {
    preprocess::StepCache cache(0);
    TissueClass dense{"dense", -1000, 4000, 0};
    dense.steps = {{StepKind::binarise, {{"from", 200.0}}}};
    const auto volume = head();
    const auto field = classify::classField(volume, {-900, 2000}, dense, &cache);
    int ones = 0;
    for (int n = 0; n < 40 * 40 * 24; ++n) {
        const volume::VoxelIndex at{n % 40, n / 40 % 40, n / 1600};
        const double expected = volume.value(at) >= 200.0 ? 1.0 : 0.0;
        EXPECT_EQ(field.values.value(at), expected);
        ones += expected == 1.0;
    }
    EXPECT_GT(ones, 500);
}

TEST(StepCache, OpeningKeepsTheSoftRimAndClosingFills) {
    preprocess::StepCache cache(0);
    const auto plain = classify::classField(head(), {-900, 2000}, bone({}), nullptr);
    const auto opened = classify::classField(
        head(), {-900, 2000}, bone({{StepKind::opening, {{"radius_mm", 9.0}}}}), &cache);
    const auto closed = classify::classField(
        head(), {-900, 2000}, bone({{StepKind::closing, {{"radius_mm", 12.0}}}}), &cache);
    int removed = 0, filled = 0;
    for (int n = 0; n < 40 * 40 * 24; ++n) {
        const volume::VoxelIndex at{n % 40, n / 40 % 40, n / 1600};
        const double p = plain.values.value(at), o = opened.values.value(at),
                     c = closed.values.value(at);
        EXPECT_TRUE(o == p || o == 0.0);
        EXPECT_GE(c, p - 1e-6);
        removed += o < p;
        filled += c > p + 1e-6;
    }
    EXPECT_GT(removed, 0);
    EXPECT_GT(filled, 0);
}

// Each step keeps a subset of what the previous step kept; filled gaps stay filled.
TEST(StepCache, StepsOfRegionsFollowEachOther) {
    preprocess::StepCache cache(0);
    const auto regions = [&](std::vector<classify::Step> steps) {
        return *cache.run(head(), bone(std::move(steps)), {}).regions;
    };
    const classify::Step edges{StepKind::edges, {{"sigma_mm", 2.0}}},
        largest{StepKind::largestComponent, {}}, opening{StepKind::opening, {{"radius_mm", 9.0}}},
        closing{StepKind::closing, {{"radius_mm", 12.0}}};
    const auto count = [](const std::vector<Region> &r, Region what) {
        return std::count(r.begin(), r.end(), what);
    };
    const auto isWithin = [](const std::vector<Region> &less, const std::vector<Region> &more) {
        for (std::size_t n = 0; n < less.size(); ++n)
            if (less[n] != Region::outside && more[n] == Region::outside)
                return false;
        return true;
    };
    EXPECT_TRUE(isWithin(regions({edges, largest}), regions({edges})));
    EXPECT_TRUE(isWithin(regions({opening, largest}), regions({opening})));
    const auto closed = regions({closing}), part = regions({closing, largest});
    EXPECT_GT(count(closed, Region::filled), 0);
    EXPECT_GT(count(part, Region::filled), 0);
    EXPECT_LE(count(part, Region::filled), count(closed, Region::filled));
}

TEST(StepCache, RefusesWhatItDoesNotKnowAndWrongOrder) {
    EXPECT_THROW(classify::stepKindNamed("sharpen"), task::Error);
    EXPECT_THROW(classify::validate(bone({{StepKind::gaussian, {{"radius_mm", 1.0}}}})),
                 task::Error);
    EXPECT_THROW(classify::validate(bone({{StepKind::gaussian, {{"sigma_mm", 1e308}}}})),
                 task::Error);
    EXPECT_THROW(classify::validate(bone({{StepKind::diffusion, {{"iterations", 2.5}}}})),
                 task::Error);
    EXPECT_THROW(
        classify::validate(bone({{StepKind::largestComponent, {}}, {StepKind::median, {}}})),
        task::Error);
    EXPECT_THROW(classify::validate(bone({{StepKind::edges, {{"low", 90.0}}}})), task::Error);
    EXPECT_THROW(classify::validate(bone(
                     std::vector<classify::Step>(classify::maxSteps + 1, {StepKind::body, {}}))),
                 task::Error);
    classify::validate(
        bone({{StepKind::median, {}}, {StepKind::edges, {{"low", 90.0}, {"high", 95.0}}}}));
}

} // namespace
} // namespace pellucid
