// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/study_content.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/classify/coarse_field.h"
#include "core/preprocess/body.h"
#include "core/preprocess/morphology.h"
#include "core/preprocess/parts.h"

namespace pellucid::preprocess {

namespace {

using presets::BodyRegion;

constexpr double meanMm = 3.0;

Mask between(const volume::Volume &volume, double low, double high, const Mask &body) {
    Mask mask(body.size());
    volume.visit([&](auto samples) {
        for (std::size_t n = 0; n < mask.size(); ++n)
            mask[n] = body[n] != 0 && double(samples[n]) >= low && double(samples[n]) <= high;
    });
    return mask;
}

// Counts of one slice, as areas.
struct SliceAreas {
    double body = 0.0, lung = 0.0, bone = 0.0; ///< mm^2
};

std::vector<SliceAreas> areasOf(const volume::Volume &volume, const Mask &body) {
    const volume::Lattice &lattice = volume.lattice();
    const double pixel = lattice.spacingMm(0) * lattice.spacingMm(1);
    const std::size_t plane = std::size_t(lattice.size().i) * std::size_t(lattice.size().j);
    std::vector<SliceAreas> areas(std::size_t(lattice.size().k));
    volume.visit([&](auto samples) {
        for (std::size_t n = 0; n < body.size(); ++n) {
            if (body[n] == 0)
                continue;
            constexpr double lungLow = -950.0, lungHigh = -600.0, boneLow = 250.0;
            const auto value = double(samples[n]);
            SliceAreas &slice = areas[n / plane];
            slice.body += pixel;
            slice.lung += value > lungLow && value < lungHigh ? pixel : 0.0;
            slice.bone += value > boneLow ? pixel : 0.0;
        }
    });
    return areas;
}

// Regions are recognized only in axial slices.
std::set<BodyRegion> regionsSeen(const volume::Volume &volume, const Mask &body) {
    constexpr double leastAxial = 0.8;
    std::set<BodyRegion> regions;
    if (std::abs(glm::normalize(glm::cross(volume.lattice().step(0), volume.lattice().step(1))).z) <
        leastAxial)
        return regions;
    constexpr double largestHead = 40000.0, leastBone = 0.12, leastLung = 0.12, emptySlice = 2000.0,
                     leastTrunk = 45000.0;
    double heads = 0.0, chests = 0.0, abdomens = 0.0, all = 0.0;
    for (const SliceAreas &slice : areasOf(volume, body)) {
        if (slice.body < emptySlice)
            continue;
        all += 1.0;
        if (slice.lung > leastLung * slice.body && slice.body > leastTrunk / 2.0)
            chests += 1.0;
        else if (slice.body < largestHead && slice.bone > leastBone * slice.body)
            heads += 1.0;
        else if (slice.body > leastTrunk)
            abdomens += 1.0;
    }
    constexpr double leastShare = 0.2;
    if (heads > leastShare * all)
        regions.insert(BodyRegion::head);
    if (chests > leastShare * all)
        regions.insert(BodyRegion::chest);
    if (abdomens > leastShare * all)
        regions.insert(BodyRegion::abdomen);
    return regions;
}

// The standard deviation within a distance of a sample.
double deviationAround(const volume::Volume &volume, const volume::VoxelIndex &center, double mm) {
    const volume::Lattice &lattice = volume.lattice();
    const volume::GridSize size = lattice.size();
    double sum = 0.0, squares = 0.0;
    int count = 0;
    std::array<int, 3> reach{};
    for (int d = 0; d < 3; ++d)
        reach[std::size_t(d)] =
            size[d] > 1 ? std::max(1, int(std::lround(mm / lattice.spacingMm(d)))) : 0;
    for (int k = -reach[2]; k <= reach[2]; ++k)
        for (int j = -reach[1]; j <= reach[1]; ++j)
            for (int i = -reach[0]; i <= reach[0]; ++i) {
                const volume::VoxelIndex at{center.i + i, center.j + j, center.k + k};
                if (at.i < 0 || at.j < 0 || at.k < 0 || at.i >= size.i || at.j >= size.j ||
                    at.k >= size.k)
                    continue;
                const double value = volume.value(at);
                sum += value;
                squares += value * value;
                ++count;
            }
    const double mean = sum / count;
    return std::sqrt(std::max(0.0, squares / count - mean * mean));
}

// The marrow of bones has the same values as vessels, but is enclosed by denser bone, or varies
// more than blood does.
bool hasContrastMedium(const volume::Volume &volume, const Mask &body,
                       const task::Progress &progress) {
    constexpr double low = 150.0, high = 600.0, dense = 450.0, ballMm = 4.0, besideMm = 6.0;
    constexpr double leastMl = 8.0, maxBesideBone = 0.35;
    // In the spine of a chest scan without contrast medium 7 % of the samples are this uniform; in
    // an aorta, 30 %.
    constexpr double evenMm = 3.0, evenHu = 16.0, leastEven = 0.15;
    const volume::Lattice &lattice = volume.lattice();
    const Mask filled =
        opening(lattice, between(volume, low, high, body), ballMm, progress.part(0.0, 0.4));
    const Mask nearBone =
        dilated(lattice, between(volume, dense, 1e9, body), besideMm, progress.part(0.4, 0.7));
    const Parts parts = partsOf(lattice, filled, "contrast", progress.part(0.7, 1.0));
    std::vector<std::size_t> counts(parts.count + 1), beside(parts.count + 1),
        even(parts.count + 1);
    const volume::GridSize size = lattice.size();
    std::size_t n = 0;
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i, ++n) {
                const std::uint32_t label = parts.labels[n];
                if (label == 0)
                    continue;
                ++counts[label];
                beside[label] += nearBone[n];
                even[label] += deviationAround(volume, {i, j, k}, evenMm) < evenHu ? 1 : 0;
            }
    double ml = 0.0;
    for (std::size_t label = 1; label < counts.size(); ++label)
        if (double(beside[label]) < maxBesideBone * double(counts[label]) &&
            double(even[label]) > leastEven * double(counts[label]))
            ml += double(counts[label]) * lattice.cellVolumeMm3() / 1000.0;
    return ml >= leastMl;
}

bool hasCouch(const volume::Volume &volume, const Mask &body, const task::Progress &progress) {
    constexpr double airBelowHu = -400.0, aroundMm = 4.0, leastMl = 30.0;
    const Mask around = dilated(volume.lattice(), body, aroundMm, progress);
    std::size_t beside = 0;
    volume.visit([&](auto samples) {
        for (std::size_t n = 0; n < around.size(); ++n)
            beside += around[n] == 0 && double(samples[n]) > airBelowHu ? 1 : 0;
    });
    return double(beside) * volume.lattice().cellVolumeMm3() / 1000.0 >= leastMl;
}

} // namespace

StudyContent contentOf(const volume::Volume &volume, const task::Progress &progress) {
    StudyContent content;
    const volume::VolumeNotes &notes = volume.notes();
    content.traits.regions = presets::regionsNamed(notes.bodyPart, notes.title);
    if (volume.unit() != volume::ValueUnit::hounsfield || !notes.placed || notes.isDifference)
        return content;
    const volume::Volume means =
        classify::coarseVolume(volume, classify::blocksWithin(volume.lattice(), meanMm));
    const Mask inside = body(means, 0.0, progress.part(0.0, 0.5));
    if (content.traits.regions.empty())
        content.traits.regions = regionsSeen(means, inside);
    content.traits.hasContrast = hasContrastMedium(means, inside, progress.part(0.5, 0.9));
    content.hasCouch = hasCouch(means, inside, progress.part(0.9, 1.0));
    return content;
}

} // namespace pellucid::preprocess
