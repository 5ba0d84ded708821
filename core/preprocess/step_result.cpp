// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/step_result.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

#include <tbb/parallel_for.h>

#include "core/preprocess/belonging.h"
#include "core/preprocess/body.h"
#include "core/preprocess/edges.h"
#include "core/preprocess/filters.h"
#include "core/preprocess/hand_regions.h"
#include "core/preprocess/morphology.h"
#include "core/preprocess/parts.h"
#include "core/preprocess/region_growing.h"

namespace pellucid::preprocess {

namespace {

using classify::ClassSamples;
using classify::DensityKind;
using classify::Region;
using classify::Step;
using classify::StepKind;
using classify::TissueClass;

bool isMostlyIn(const volume::Coverage &coverage, volume::VoxelIndex n) {
    return 2 * coverage.at(n) >= volume::Coverage::whole;
}

// The samples whose membership of a class is at least a half after the steps so far.
Mask belonging(const TissueClass &tissue, const ClassSamples &now) {
    const volume::GridSize size = now.values.lattice().size();
    const Belonging belongs(tissue);
    Mask mask(size.count());
    now.values.visit([&](auto samples) {
        tbb::parallel_for(0, size.k, [&](int k) {
            const std::size_t first = size.offsetOf(0, 0, k), end = size.offsetOf(0, 0, k + 1);
            for (std::size_t n = first; n < end; ++n)
                mask[n] = belongs(samples[n]);
            if (now.coverage)
                for (int j = 0; j < size.j; ++j)
                    for (int i = 0; i < size.i; ++i)
                        if (!isMostlyIn(*now.coverage, {i, j, k}))
                            mask[size.offsetOf(i, j, k)] = 0;
            if (now.regions)
                for (std::size_t n = first; n < end; ++n) {
                    const Region where = (*now.regions)[n];
                    mask[n] = where == Region::filled || (where == Region::inside && mask[n] != 0);
                }
        });
    });
    return mask;
}

// The samples of a mask and all their neighbours.
Mask withNeighbours(const volume::GridSize &size, const Mask &mask) {
    Mask wider(mask.size());
    tbb::parallel_for(0, size.k, [&](int k) {
        std::vector<std::uint8_t> across(std::size_t(size.i) + 2);
        for (int j = 0; j < size.j; ++j) {
            std::fill(across.begin(), across.end(), std::uint8_t(0));
            for (int z = std::max(k - 1, 0); z <= std::min(k + 1, size.k - 1); ++z)
                for (int y = std::max(j - 1, 0); y <= std::min(j + 1, size.j - 1); ++y) {
                    const std::uint8_t *const row = mask.data() + size.offsetOf(0, y, z);
                    for (int i = 0; i < size.i; ++i)
                        across[std::size_t(i) + 1] |= row[i];
                }
            std::uint8_t *const out = wider.data() + size.offsetOf(0, j, k);
            for (std::size_t i = 0; i < std::size_t(size.i); ++i)
                out[i] = across[i] | across[i + 1] | across[i + 2];
        }
    });
    return wider;
}

// The regions after a step has kept a part of the class: the part, and the rim around it in which
// membership fades, if it does. Samples that were outside stay outside, and filled gaps stay
// filled.
std::vector<Region> partOf(const StepStart &start, const Mask &before, const Mask &kept) {
    const volume::GridSize size = start.before.values.lattice().size();
    const bool fades = start.tissue.softness > 0.0 || start.before.coverage;
    const Mask rim = fades ? withNeighbours(size, kept) : Mask();
    const Regions &former = start.before.regions;
    std::vector<Region> regions(kept.size(), Region::outside);
    tbb::parallel_for(0, size.k, [&](int k) {
        for (std::size_t n = size.offsetOf(0, 0, k), end = size.offsetOf(0, 0, k + 1); n < end; ++n)
            if (kept[n] != 0 || (fades && before[n] == 0 && rim[n] != 0))
                regions[n] = former ? (*former)[n] : Region::inside;
    });
    return regions;
}

Regions shared(std::vector<Region> regions) {
    return std::make_shared<const std::vector<Region>>(std::move(regions));
}

Regions insideOf(const Mask &mask) {
    std::vector<Region> regions(mask.size());
    std::transform(mask.begin(), mask.end(), regions.begin(),
                   [](std::uint8_t m) { return m != 0 ? Region::inside : Region::outside; });
    return shared(std::move(regions));
}

// The regions whose values fulfil a condition that does not depend on the class.
template <class F> Regions insideWhere(const volume::Volume &values, const F &holds) {
    Mask mask(values.lattice().size().count());
    values.visit([&](auto samples) {
        for (std::size_t n = 0; n < mask.size(); ++n)
            mask[n] = holds(double(samples[n]));
    });
    return insideOf(mask);
}

// The lowest 16-bit value has no opposite.
volume::Volume negated(const volume::Volume &values) {
    return values.visit([&](auto samples) {
        using T = std::remove_cv_t<typename decltype(samples)::element_type>;
        std::vector<T> opposite(samples.size());
        std::transform(samples.begin(), samples.end(), opposite.begin(), [](T value) {
            if constexpr (std::is_same_v<T, std::int16_t>)
                return T(std::min(-int(value), int(std::numeric_limits<T>::max())));
            else
                return -value;
        });
        return volume::Volume(values.lattice(), std::move(opposite), values.unit(), values.notes());
    });
}

volume::Volume smoothGradient(const volume::Volume &values, double sigmaMm,
                              const task::Progress &progress) {
    return gradientMagnitude(sigmaMm > 0.0 ? gaussian(values, sigmaMm, progress.part(0.0, 0.8))
                                           : values,
                             progress.part(0.8, 1.0));
}

std::vector<Region> regionsOf(const ClassSamples &samples) {
    return samples.regions
               ? *samples.regions
               : std::vector<Region>(samples.values.lattice().size().count(), Region::inside);
}

// The former regions, with the samples that a step added.
Regions withFilled(const ClassSamples &before, const Mask &now, const Mask &wider) {
    std::vector<Region> regions = regionsOf(before);
    for (std::size_t n = 0; n < wider.size(); ++n)
        if (wider[n] != 0 && now[n] == 0)
            regions[n] = Region::filled;
    return shared(std::move(regions));
}

// The samples that are mostly in a coverage, or those that are not.
Mask maskOf(const volume::Coverage &coverage, const volume::GridSize &size, bool isIn) {
    Mask mask(size.count());
    tbb::parallel_for(0, size.k, [&](int k) {
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i)
                mask[size.offsetOf(i, j, k)] = isMostlyIn(coverage, {i, j, k}) == isIn;
    });
    return mask;
}

} // namespace

StepResult resultOf(const Step &step, const StepStart &start, const task::Progress &progress) {
    const TissueClass &tissue = start.tissue;
    const ClassSamples &before = start.before;
    const volume::Volume &values = before.values;
    const volume::Lattice &lattice = values.lattice();
    const auto given = [&](const char *parameter) { return step.at(parameter); };
    // A filter of the class's samples that leaves a part of them, or adds others.
    const auto keeping = [&](const auto &filter) {
        const Mask all = belonging(tissue, before);
        return shared(partOf(start, all, filter(all)));
    };
    const auto adding = [&](const auto &filter) {
        const Mask all = belonging(tissue, before);
        return withFilled(before, all, filter(all));
    };
    switch (step.kind) {
    case StepKind::gaussian:
        return gaussian(values, given("sigma_mm"), progress);
    case StepKind::median:
        return median(values, given("radius_mm"), progress);
    case StepKind::diffusion:
        return diffusion(values, int(given("iterations")), given("conductance"), progress);
    case StepKind::gradient:
        return smoothGradient(values, given("sigma_mm"), progress);
    case StepKind::negate:
        return negated(values);
    case StepKind::threshold:
        return insideWhere(values, [low = given("low"), high = given("high")](double value) {
            return value >= low && value <= high;
        });
    case StepKind::edges: {
        const CannyOptions options{given("sigma_mm"), given("low"), given("high")};
        return insideOf(given("itk") == 1.0 ? cannyEdgesByItk(values, options, progress)
                                            : cannyEdges(values, options, progress));
    }
    case StepKind::binarise:
        return insideWhere(values, [from = given("from")](double value) { return value >= from; });
    case StepKind::opening:
        return keeping([&, open = given("itk") == 1.0 ? openingByItk : opening](const Mask &all) {
            return open(lattice, all, given("radius_mm"), progress);
        });
    case StepKind::closing:
        return adding([&, close = given("itk") == 1.0 ? closingByItk : closing](const Mask &all) {
            return close(lattice, all, given("radius_mm"), progress);
        });
    case StepKind::largestComponent:
        return keeping(
            [&](const Mask &all) { return largestPart(lattice, all, given("share"), progress); });
    case StepKind::connected:
        return keeping([&](const Mask &all) {
            return connectedWith(lattice, all, step.points, given("leak_mm"), progress);
        });
    case StepKind::grow:
        return adding(
            [&](const Mask &all) { return dilated(lattice, all, given("mm"), progress); });
    case StepKind::shrink:
        return keeping(
            [&](const Mask &all) { return eroded(lattice, all, given("mm"), progress); });
    case StepKind::fill:
        return adding([&](const Mask &all) { return withoutHoles(lattice.size(), all, progress); });
    case StepKind::intersection:
        return insideOf(maskOf(*start.operand, lattice.size(), true));
    case StepKind::difference:
        return insideOf(maskOf(*start.operand, lattice.size(), false));
    case StepKind::join:
        return adding(
            [&](const Mask & /*all*/) { return maskOf(*start.operand, lattice.size(), true); });
    case StepKind::paint: {
        std::vector<Region> regions = regionsOf(before);
        paint(lattice, step.strokes, regions, progress);
        return shared(std::move(regions));
    }
    case StepKind::scissors:
        return insideOf(remaining(lattice, step.cuts, progress));
    case StepKind::body:
        return insideOf(body(values, given("margin_mm"), progress));
    case StepKind::skin:
        return insideOf(skin(values, given("depth_mm"), given("margin_mm"), progress));
    }
    std::abort(); // the switch handles every kind
}

bool dependsOnClass(StepKind kind) {
    switch (kind) {
    case StepKind::opening:
    case StepKind::closing:
    case StepKind::largestComponent:
    case StepKind::connected:
    case StepKind::grow:
    case StepKind::shrink:
    case StepKind::fill:
    case StepKind::join:
    case StepKind::paint:
        return true;
    case StepKind::gaussian:
    case StepKind::median:
    case StepKind::diffusion:
    case StepKind::gradient:
    case StepKind::negate:
    case StepKind::threshold:
    case StepKind::edges:
    case StepKind::binarise:
    case StepKind::body:
    case StepKind::skin:
    case StepKind::intersection:
    case StepKind::difference:
    case StepKind::scissors:
        break;
    }
    return false;
}

std::optional<DensityKind> densityAfter(StepKind kind) {
    switch (kind) {
    case StepKind::gradient:
        return DensityKind::range;
    case StepKind::edges:
    case StepKind::binarise:
        return DensityKind::one;
    case StepKind::gaussian:
    case StepKind::median:
    case StepKind::diffusion:
    case StepKind::negate:
    case StepKind::threshold:
    case StepKind::opening:
    case StepKind::closing:
    case StepKind::largestComponent:
    case StepKind::connected:
    case StepKind::grow:
    case StepKind::shrink:
    case StepKind::fill:
    case StepKind::body:
    case StepKind::skin:
    case StepKind::intersection:
    case StepKind::join:
    case StepKind::difference:
    case StepKind::paint:
    case StepKind::scissors:
        break;
    }
    return std::nullopt;
}

} // namespace pellucid::preprocess
