// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <itkBinaryFillholeImageFilter.h>
#include <itkHistogram.h>
#include <itkOtsuThresholdCalculator.h>
#include <itkSliceBySliceImageFilter.h>

#include <glm/geometric.hpp>

#include "core/classify/coarse_field.h"
#include "core/preprocess/itk_images_itk.inc"
#include "core/preprocess/morphology.h"
#include "core/preprocess/parts.h"
#include "core/volume/statistics.h"

namespace pellucid::preprocess {

namespace {

// Thinner than a child's arm, thicker than the shell of a couch.
constexpr double couchRadiusMm = 4.0;
// Among thinner parts, an ear is 80 mm long, while a couch or a head rest is much longer. The
// roughness of skin is connected all around the patient: parts within `roughnessMm` of the core
// belong to it.
constexpr double longestThinPartMm = 130.0, roughnessMm = 2.0;
constexpr double airBelowHu = -400.0;
// The shell of a head rest is denser than an ear that is pressed against it, and longer than an ear
// or a row of teeth. Around it, values mix, over at least a sample.
constexpr double shellHu = 250.0, shortestShellMm = 90.0, leastRimMm = 1.5;
// Soft tissue, where it mixes with a shell that it touches.
constexpr double tissueBesideHu = 150.0;

double airThreshold(const volume::Volume &volume) {
    if (volume.unit() == volume::ValueUnit::hounsfield)
        return airBelowHu;
    // Otsu's threshold of the histogram without its outermost quantiles, which spikes would
    // stretch.
    const auto ends = volume::quantiles(volume, {0.005, 0.995});
    constexpr unsigned bins = 256;
    if (!(ends[1] > ends[0]))
        return ends[0];
    using Histogram = itk::Statistics::Histogram<double>;
    const auto histogram = Histogram::New();
    histogram->SetMeasurementVectorSize(1);
    Histogram::SizeType size(1);
    size.Fill(bins);
    Histogram::MeasurementVectorType low(1), high(1);
    low.Fill(ends[0]);
    high.Fill(ends[1]);
    histogram->Initialize(size, low, high);
    std::vector<std::uint64_t> counts(bins);
    volume.visit([&](auto samples) {
        for (const auto sample : samples) {
            const double at = (double(sample) - ends[0]) / (ends[1] - ends[0]) * bins;
            if (at >= 0.0 && at < bins) // not NaN
                ++counts[std::size_t(at)];
        }
    });
    for (unsigned bin = 0; bin < bins; ++bin)
        histogram->SetFrequency(bin, counts[bin]);
    const auto otsu = itk::OtsuThresholdCalculator<Histogram, double>::New();
    otsu->SetInput(histogram);
    otsu->Update();
    return otsu->GetThreshold();
}

void remove(const Mask &removed, Mask &from) {
    for (std::size_t n = 0; n < removed.size(); ++n)
        from[n] = std::uint8_t(from[n] & ~removed[n] & 1);
}

double diagonalMm(const volume::VoxelBox &box, const volume::Lattice &lattice) {
    const volume::GridSize size = box.size();
    return glm::length(glm::dvec3(size.i * lattice.spacingMm(0), size.j * lattice.spacingMm(1),
                                  size.k * lattice.spacingMm(2)));
}

// The dense shells of head rests and couches: dense parts that are long, and mostly too thin for
// the core. Empty: there are none.
Mask shellsAmong(const volume::Lattice &lattice, Mask dense, const Mask &core,
                 const task::Progress &progress) {
    const Parts parts = partsOf(lattice, dense, "body", progress);
    const auto boxes = boxesOf(parts, lattice.size());
    std::vector<std::size_t> counts(parts.count + 1), inCore(parts.count + 1);
    for (std::size_t n = 0; n < dense.size(); ++n) {
        ++counts[parts.labels[n]];
        inCore[parts.labels[n]] += core[n];
    }
    std::vector<std::uint8_t> isShell(parts.count + 1);
    bool isAny = false;
    for (std::size_t label = 1; label < isShell.size(); ++label) {
        isShell[label] = diagonalMm(boxes[label], lattice) >= shortestShellMm &&
                         2 * inCore[label] < counts[label];
        isAny = isAny || isShell[label] != 0;
    }
    if (!isAny)
        return {};
    for (std::size_t n = 0; n < dense.size(); ++n)
        dense[n] = isShell[parts.labels[n]];
    return dense;
}

// The core with thin, short parts of the tissue that touch it: an ear, but not a couch.
Mask withShortParts(const volume::Lattice &lattice, Mask core, const Mask &tissue,
                    const task::Progress &progress) {
    const volume::GridSize size = lattice.size();
    Mask thin = tissue;
    remove(core, thin);
    const Parts parts = partsOf(lattice, thin, "body", progress);
    const auto boxes = boxesOf(parts, size);
    std::vector<std::uint8_t> touches(parts.count + 1);
    const std::size_t row = std::size_t(size.i), plane = row * std::size_t(size.j);
    std::size_t n = 0;
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i, ++n)
                if (parts.labels[n] != 0 &&
                    ((i > 0 && core[n - 1] != 0) || (i + 1 < size.i && core[n + 1] != 0) ||
                     (j > 0 && core[n - row] != 0) || (j + 1 < size.j && core[n + row] != 0) ||
                     (k > 0 && core[n - plane] != 0) || (k + 1 < size.k && core[n + plane] != 0)))
                    touches[parts.labels[n]] = 1;
    for (std::size_t label = 1; label < touches.size(); ++label)
        touches[label] &= diagonalMm(boxes[label], lattice) <= longestThinPartMm ? 1 : 0;
    for (std::size_t at = 0; at < core.size(); ++at)
        core[at] = std::uint8_t(core[at] | touches[parts.labels[at]]);
    return core;
}

// The mask with the holes of each slice filled.
Mask filledSlices(const volume::Lattice &lattice, const Mask &mask,
                  const task::Progress &progress) {
    using SliceFilter = itk::SliceBySliceImageFilter<MaskImage, MaskImage>;
    using Fill = itk::BinaryFillholeImageFilter<SliceFilter::InternalInputImageType>;
    auto fill = Fill::New();
    fill->SetForegroundValue(1);
    auto slices = SliceFilter::New();
    slices->SetFilter(fill);
    slices->SetInput(imageOver<MaskImage>(lattice, mask.data()));
    runFilter(*slices, "body", progress);
    return samplesOf(*slices->GetOutput());
}

// Which parts are round and solid in their slices, as a limb is and a board, a holder or the shell
// of a couch is not.
std::vector<std::uint8_t> limbsAmong(const volume::Lattice &lattice, const Parts &parts,
                                     const Mask &tissue) {
    constexpr double leastAspect = 0.3, leastFilled = 0.5, leastTissue = 0.7, leastMl = 20.0;
    struct Slice {
        int minI = 0, maxI = -1, minJ = 0, maxJ = -1;
        std::size_t count = 0;
    };
    struct Sums {
        double aspect = 0.0, filled = 0.0;
        std::size_t slices = 0, count = 0, ofTissue = 0;
    };
    const volume::GridSize size = lattice.size();
    std::vector<Sums> sums(parts.count + 1);
    std::size_t n = 0;
    for (int k = 0; k < size.k; ++k) {
        std::vector<Slice> slices(parts.count + 1);
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i, ++n) {
                const std::uint32_t label = parts.labels[n];
                if (label == 0)
                    continue;
                Slice &slice = slices[label];
                if (slice.count++ == 0)
                    slice = {i, i, j, j, 1};
                slice.minI = std::min(slice.minI, i);
                slice.maxI = std::max(slice.maxI, i);
                slice.maxJ = j; // rows come in order
                ++sums[label].count;
                sums[label].ofTissue += tissue[n];
            }
        for (std::size_t label = 1; label < slices.size(); ++label) {
            const Slice &slice = slices[label];
            if (slice.count == 0)
                continue;
            const double across = (slice.maxI - slice.minI + 1) * lattice.spacingMm(0),
                         down = (slice.maxJ - slice.minJ + 1) * lattice.spacingMm(1);
            const double area = double(slice.count) * lattice.spacingMm(0) * lattice.spacingMm(1);
            sums[label].aspect += std::min(across, down) / std::max(across, down);
            sums[label].filled += area / (across * down);
            ++sums[label].slices;
        }
    }
    const double voxelMl = lattice.cellVolumeMm3() / 1000.0;
    std::vector<std::uint8_t> areLimbs(parts.count + 1);
    for (std::size_t label = 1; label < sums.size(); ++label) {
        const Sums &of = sums[label];
        areLimbs[label] = double(of.count) * voxelMl >= leastMl &&
                          double(of.ofTissue) >= leastTissue * double(of.count) &&
                          of.aspect >= leastAspect * double(of.slices) &&
                          of.filled >= leastFilled * double(of.slices);
    }
    return areLimbs;
}

// The trunk or head, and limbs beside it.
Mask thickPartsOfPatient(const volume::Lattice &lattice, const Mask &thick, const Mask &tissue,
                         const task::Progress &progress) {
    const Parts parts = partsOf(lattice, thick, "body", progress);
    std::vector<std::size_t> counts(parts.count + 1);
    for (const std::uint32_t label : parts.labels)
        ++counts[label];
    std::vector<std::uint8_t> isPatient = limbsAmong(lattice, parts, tissue);
    if (parts.count > 0)
        isPatient[std::size_t(std::max_element(counts.begin() + 1, counts.end()) -
                              counts.begin())] = 1;
    Mask patient(thick.size());
    for (std::size_t n = 0; n < patient.size(); ++n)
        patient[n] = isPatient[parts.labels[n]];
    return patient;
}

Mask tissueOf(const volume::Volume &volume) {
    const double threshold = airThreshold(volume);
    Mask tissue(volume.lattice().size().count());
    volume.visit([&](auto samples) {
        for (std::size_t n = 0; n < tissue.size(); ++n)
            tissue[n] = double(samples[n]) > threshold;
    });
    return tissue;
}

// Which mean each sample belongs to: calls `visit(sample, mean)` for all samples in order.
template <class F>
void eachSample(const volume::GridSize &blocks, const std::array<int, 3> &block,
                const volume::GridSize &size, F &&visit) {
    std::array<std::vector<std::size_t>, 3> at;
    for (int d = 0; d < 3; ++d) {
        const double first = 0.5 * (size[d] - 1) - 0.5 * (blocks[d] - 1) * block[std::size_t(d)];
        for (int n = 0; n < size[d]; ++n)
            at[std::size_t(d)].push_back(std::size_t(std::clamp(
                int(std::floor((n - first) / block[std::size_t(d)] + 0.5)), 0, blocks[d] - 1)));
    }
    std::size_t n = 0;
    for (const std::size_t k : at[2])
        for (const std::size_t j : at[1]) {
            const std::size_t row = (k * std::size_t(blocks.j) + j) * std::size_t(blocks.i);
            for (const std::size_t i : at[0])
                visit(n++, row + i);
        }
}

// A mask of means, on the samples.
Mask onSamples(const Mask &coarse, const volume::GridSize &blocks, const std::array<int, 3> &block,
               const volume::GridSize &size) {
    Mask mask(size.count());
    eachSample(blocks, block, size,
               [&](std::size_t sample, std::size_t mean) { mask[sample] = coarse[mean]; });
    return mask;
}

// The means that have a sample as dense as a shell, which itself may be thinner than a mean. Empty
// for values that are not in HU.
Mask denseMeans(const volume::Volume &volume, const volume::GridSize &blocks,
                const std::array<int, 3> &block) {
    if (volume.unit() != volume::ValueUnit::hounsfield)
        return {};
    Mask dense(blocks.count());
    volume.visit([&](auto samples) {
        eachSample(blocks, block, volume.lattice().size(),
                   [&](std::size_t sample, std::size_t mean) {
                       if (double(samples[sample]) > shellHu)
                           dense[mean] = 1;
                   });
    });
    return dense;
}

// The patient without a margin, and the dense shells around, without their rims.
struct Patient {
    Mask inside, shells;

    // All within a distance. It does not reach into a shell that touches the skin.
    Mask withMargin(const volume::Lattice &lattice, double marginMm,
                    const task::Progress &progress) const {
        Mask all = dilated(lattice, inside, marginMm, progress);
        remove(shells, all);
        return all;
    }
};

// `dense`: see `denseMeans`, of the volume itself.
Patient patientOf(const volume::Volume &volume, Mask dense, const task::Progress &progress) {
    const volume::Lattice &lattice = volume.lattice();
    Mask tissue = tissueOf(volume);
    // Slices are filled first, because an opening would connect the lungs to the surrounding air.
    const Mask opened = opening(lattice, filledSlices(lattice, tissue, progress.part(0.0, 0.2)),
                                couchRadiusMm, progress.part(0.2, 0.6));
    Mask core = thickPartsOfPatient(lattice, opened, tissue, progress.part(0.6, 0.7));
    Mask shells = dense.empty()
                      ? Mask()
                      : shellsAmong(lattice, std::move(dense), core, progress.part(0.7, 0.71));
    // Without its rim, an ear that touches a shell would be a part of it.
    const double rimMm = std::max({leastRimMm, 1.01 * lattice.spacingMm(0),
                                   1.01 * lattice.spacingMm(1), 1.01 * lattice.spacingMm(2)});
    Mask apart = tissue;
    if (!shells.empty()) {
        const Mask rim = dilated(lattice, shells, rimMm, progress.part(0.71, 0.72));
        remove(rim, apart);
        remove(rim, core);
    }
    Mask patient = dilated(lattice, core, roughnessMm, progress.part(0.72, 0.74));
    for (std::size_t n = 0; n < patient.size(); ++n)
        patient[n] = std::uint8_t((patient[n] & apart[n]) | core[n]);
    patient = withShortParts(lattice, std::move(patient), apart, progress.part(0.74, 0.78));
    if (!shells.empty()) {
        // Give the patient's part of the rim back.
        remove(shells, tissue);
        const Mask nearby = dilated(lattice, patient, rimMm, progress.part(0.78, 0.8));
        for (std::size_t n = 0; n < patient.size(); ++n)
            patient[n] = std::uint8_t(patient[n] | (nearby[n] & tissue[n]));
    }
    return {filledSlices(lattice, patient, progress.part(0.8, 1.0)), std::move(shells)};
}

} // namespace

Mask body(const volume::Volume &volume, double marginMm, const task::Progress &progress) {
    constexpr double largestMeanMm = 2.0;
    const auto block = classify::blocksWithin(volume.lattice(), largestMeanMm);
    if (block == std::array{1, 1, 1}) {
        const Patient patient = patientOf(
            volume, denseMeans(volume, volume.lattice().size(), block), progress.part(0.0, 0.9));
        return patient.withMargin(volume.lattice(), marginMm, progress.part(0.9, 1.0));
    }
    const volume::Volume coarse = classify::coarseVolume(volume, block);
    const Patient patient = patientOf(coarse, denseMeans(volume, coarse.lattice().size(), block),
                                      progress.part(0.0, 0.8));
    // Half a mean, so that its rounding cuts off nothing.
    double halfMm = 0.0;
    for (int d = 0; d < 3; ++d)
        if (block[std::size_t(d)] > 1)
            halfMm = std::max(halfMm, 0.5 * coarse.lattice().spacingMm(d));
    const volume::GridSize blocks = coarse.lattice().size();
    Mask mask = onSamples(
        patient.withMargin(coarse.lattice(), std::max(marginMm, halfMm), progress.part(0.8, 0.9)),
        blocks, block, volume.lattice().size());
    if (!patient.shells.empty()) {
        // A mean that touches the patient may have samples of both.
        Mask mixed = dilated(coarse.lattice(), patient.inside, 2.0 * halfMm + leastRimMm,
                             progress.part(0.9, 1.0));
        for (std::size_t n = 0; n < mixed.size(); ++n)
            mixed[n] &= patient.shells[n];
        volume.visit([&](auto samples) {
            eachSample(blocks, block, volume.lattice().size(),
                       [&](std::size_t sample, std::size_t mean) {
                           const auto value = double(samples[sample]);
                           if (mixed[mean] != 0 && value > airBelowHu && value < tissueBesideHu)
                               mask[sample] = 1;
                       });
        });
    }
    return mask;
}

Mask skin(const volume::Volume &volume, double depthMm, double marginMm,
          const task::Progress &progress) {
    const Patient patient = patientOf(
        volume, denseMeans(volume, volume.lattice().size(), {1, 1, 1}), progress.part(0.0, 0.7));
    // At least one sample deep, because coarse volumes would otherwise have no skin.
    const double depth = std::max(depthMm, 1.01 * volume.lattice().shortestStepMm());
    const Mask deep = eroded(volume.lattice(), patient.inside, depth, progress.part(0.7, 0.85));
    Mask skin = patient.withMargin(volume.lattice(), marginMm, progress.part(0.85, 1.0));
    remove(deep, skin);
    return skin;
}

} // namespace pellucid::preprocess
