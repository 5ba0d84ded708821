// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/filters.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <itkBinaryFillholeImageFilter.h>
#include <itkBinaryMorphologicalClosingImageFilter.h>
#include <itkBinaryMorphologicalOpeningImageFilter.h>
#include <itkConnectedComponentImageFilter.h>
#include <itkCurvatureAnisotropicDiffusionImageFilter.h>
#include <itkDiscreteGaussianImageFilter.h>
#include <itkFlatStructuringElement.h>
#include <itkHistogram.h>
#include <itkImage.h>
#include <itkMedianImageFilter.h>
#include <itkOtsuThresholdCalculator.h>
#include <itkSliceBySliceImageFilter.h>
#include <tbb/parallel_for.h>

#include "core/preprocess/itk_images_itk.inc"
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

template <class Filter>
volume::Volume filtered(const volume::Volume &volume, Filter &filter, const std::string &name,
                        const task::Progress &progress) {
    const std::vector<float> input = finiteSamples(volume);
    const auto image = imageOver<FloatImage>(volume.lattice(), input.data());
    filter.SetInput(image);
    runFilter(filter, name, progress);
    return {volume.lattice(), samplesOf(*filter.GetOutput()), volume.unit(), volume.notes()};
}

bool isUniform(const Mask &mask) {
    return std::all_of(mask.begin(), mask.end(), [&](std::uint8_t m) { return m == mask.front(); });
}

// The samples within a distance of those that have a value in the mask. Squared distances are
// accumulated axis by axis, no farther than the distance. ITK's distance map has no such limit and
// takes ten times as long for anatomical radii. *Requires*: the mask contains both values.
Mask within(const volume::Lattice &lattice, const Mask &mask, std::uint8_t value, double radiusMm,
            const task::Progress &progress) {
    const volume::GridSize size = lattice.size();
    // A distance equal to the radius counts in spite of rounding.
    const auto limit = float(radiusMm * radiusMm * (1.0 + 1e-5));
    constexpr float far = 1e30F;
    const auto row = [&](int j, int k) { return size.offsetOf(0, j, k); };
    std::vector<float> alongRows(mask.size()), inSlices(mask.size());
    tbb::parallel_for(0, size.k, [&](int k) {
        progress.check();
        const auto step = float(lattice.spacingMm(0));
        for (int j = 0; j < size.j; ++j) {
            const std::uint8_t *const in = mask.data() + row(j, k);
            float *const out = alongRows.data() + row(j, k);
            float last = far;
            for (int i = 0; i < size.i; ++i)
                out[i] = last = in[i] == value ? 0.0F : last + step;
            last = far;
            for (int i = size.i - 1; i >= 0; --i) {
                last = in[i] == value ? 0.0F : last + step;
                const float least = std::min(out[i], last);
                out[i] = least < far ? least * least : far;
            }
        }
    });
    progress.report(0.3);
    const auto gather = [&](const std::vector<float> &from, float *to, int j, int k, int axis) {
        const double step = lattice.spacingMm(axis);
        const int reach = int(std::min(radiusMm / step * (1.0 + 1e-5), double(size[axis])));
        const int at = axis == 1 ? j : k;
        for (int d = std::max(-reach, -at); d <= std::min(reach, size[axis] - 1 - at); ++d) {
            const float *const source = from.data() + (axis == 1 ? row(j + d, k) : row(j, k + d));
            const auto square = float(d * step * d * step);
            for (int i = 0; i < size.i; ++i)
                to[i] = std::min(to[i], source[i] + square);
        }
    };
    tbb::parallel_for(0, size.k, [&](int k) {
        progress.check();
        for (int j = 0; j < size.j; ++j) {
            std::fill_n(inSlices.data() + row(j, k), size.i, far);
            gather(alongRows, inSlices.data() + row(j, k), j, k, 1);
        }
    });
    progress.report(0.7);
    Mask near(mask.size());
    tbb::parallel_for(0, size.k, [&](int k) {
        progress.check();
        std::vector<float> squares(std::size_t(size.i));
        for (int j = 0; j < size.j; ++j) {
            std::fill(squares.begin(), squares.end(), far);
            gather(inSlices, squares.data(), j, k, 2);
            for (int i = 0; i < size.i; ++i)
                near[row(j, k) + std::size_t(i)] = squares[std::size_t(i)] <= limit;
        }
    });
    progress.report(1.0);
    return near;
}

Mask inverted(Mask mask) {
    for (std::uint8_t &m : mask)
        m = std::uint8_t(1 - m);
    return mask;
}

Mask grown(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
           const task::Progress &progress) {
    return isUniform(mask) ? mask : within(lattice, mask, 1, radiusMm, progress);
}

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

// Connected parts, by faces: 1 to `count`, 0 where nothing is.
struct Parts {
    std::vector<std::uint32_t> labels;
    std::size_t count = 0;
};

Parts partsOf(const volume::Lattice &lattice, const Mask &mask, const char *step,
              const task::Progress &progress) {
    using Labels = itk::Image<std::uint32_t, 3>;
    auto filter = itk::ConnectedComponentImageFilter<MaskImage, Labels>::New();
    filter->SetInput(imageOver<MaskImage>(lattice, mask.data()));
    runFilter(*filter, step, progress);
    const std::uint32_t *const labels = filter->GetOutput()->GetBufferPointer();
    return {{labels, labels + mask.size()}, std::size_t(filter->GetObjectCount())};
}

// The core with thin, short parts of the tissue that touch it: an ear, but not a couch.
Mask withShortParts(const volume::Lattice &lattice, Mask core, const Mask &tissue,
                    const task::Progress &progress) {
    const volume::GridSize size = lattice.size();
    Mask thin(tissue.size());
    for (std::size_t n = 0; n < thin.size(); ++n)
        thin[n] = std::uint8_t(tissue[n] & ~core[n] & 1);
    const Parts parts = partsOf(lattice, thin, "body", progress);
    struct Part {
        volume::VoxelIndex lo{1 << 30, 1 << 30, 1 << 30}, hi{-1, -1, -1};
        bool touches = false;
    };
    std::vector<Part> found(parts.count + 1);
    const std::size_t row = std::size_t(size.i), plane = row * std::size_t(size.j);
    std::size_t n = 0;
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i, ++n) {
                if (parts.labels[n] == 0)
                    continue;
                Part &part = found[parts.labels[n]];
                part.lo = {std::min(part.lo.i, i), std::min(part.lo.j, j), std::min(part.lo.k, k)};
                part.hi = {std::max(part.hi.i, i), std::max(part.hi.j, j), std::max(part.hi.k, k)};
                part.touches =
                    part.touches || (i > 0 && core[n - 1] != 0) ||
                    (i + 1 < size.i && core[n + 1] != 0) || (j > 0 && core[n - row] != 0) ||
                    (j + 1 < size.j && core[n + row] != 0) || (k > 0 && core[n - plane] != 0) ||
                    (k + 1 < size.k && core[n + plane] != 0);
            }
    std::vector<std::uint8_t> isKept(found.size());
    for (std::size_t label = 1; label < found.size(); ++label) {
        const Part &part = found[label];
        const glm::dvec3 mm((part.hi.i - part.lo.i + 1) * lattice.spacingMm(0),
                            (part.hi.j - part.lo.j + 1) * lattice.spacingMm(1),
                            (part.hi.k - part.lo.k + 1) * lattice.spacingMm(2));
        isKept[label] = part.touches && glm::length(mm) <= longestThinPartMm;
    }
    for (std::size_t at = 0; at < core.size(); ++at)
        core[at] = std::uint8_t(core[at] | isKept[parts.labels[at]]);
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

} // namespace

Mask eroded(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
            const task::Progress &progress) {
    return isUniform(mask) ? mask : inverted(within(lattice, mask, 0, radiusMm, progress));
}

volume::Volume gaussian(const volume::Volume &volume, double sigmaMm,
                        const task::Progress &progress) {
    auto filter = itk::DiscreteGaussianImageFilter<FloatImage, FloatImage>::New();
    filter->SetVariance(sigmaMm * sigmaMm);
    filter->SetMaximumError(0.01);
    filter->SetMaximumKernelWidth(128);
    return filtered(volume, *filter, "gaussian", progress);
}

volume::Volume median(const volume::Volume &volume, double radiusMm,
                      const task::Progress &progress) {
    auto filter = itk::MedianImageFilter<FloatImage, FloatImage>::New();
    FloatImage::SizeType radius;
    for (unsigned d = 0; d < 3; ++d) {
        const double samples = radiusMm / volume.lattice().spacingMm(int(d));
        radius[d] = itk::SizeValueType(
            std::min<double>(std::floor(samples + 1e-6), volume.lattice().size()[int(d)]));
    }
    filter->SetRadius(radius);
    return filtered(volume, *filter, "median", progress);
}

volume::Volume diffusion(const volume::Volume &volume, int iterations, double conductance,
                         const task::Progress &progress) {
    auto filter = itk::CurvatureAnisotropicDiffusionImageFilter<FloatImage, FloatImage>::New();
    filter->SetNumberOfIterations(itk::IdentifierType(iterations));
    filter->SetConductanceParameter(conductance);
    filter->SetUseImageSpacing(true);
    filter->SetTimeStep(volume.lattice().shortestStepMm() / 16.0);
    return filtered(volume, *filter, "diffusion", progress);
}

Mask opening(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
             const task::Progress &progress) {
    const Mask core = eroded(lattice, mask, radiusMm, progress.part(0.0, 0.5));
    return grown(lattice, core, radiusMm, progress.part(0.5, 1.0));
}

Mask closing(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
             const task::Progress &progress) {
    const Mask wide = grown(lattice, mask, radiusMm, progress.part(0.0, 0.5));
    return eroded(lattice, wide, radiusMm, progress.part(0.5, 1.0));
}

Mask dilated(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
             const task::Progress &progress) {
    return radiusMm > 0.0 ? grown(lattice, mask, radiusMm, progress) : mask;
}

Mask largestPart(const volume::Lattice &lattice, const Mask &mask, double minShare,
                 const task::Progress &progress) {
    const Parts parts = partsOf(lattice, mask, "largest", progress);
    std::vector<std::size_t> counts(parts.count + 1, 0);
    for (const std::uint32_t label : parts.labels)
        ++counts[label];
    if (parts.count == 0)
        return mask; // it is empty
    const auto largest = std::max_element(counts.begin() + 1, counts.end());
    std::vector<std::uint8_t> isKept(counts.size());
    for (std::size_t label = 1; label < counts.size(); ++label)
        isKept[label] = minShare < 1.0 ? double(counts[label]) >= minShare * double(*largest)
                                       : counts.begin() + std::ptrdiff_t(label) == largest;
    Mask part(mask.size());
    for (std::size_t n = 0; n < mask.size(); ++n)
        part[n] = isKept[parts.labels[n]];
    return part;
}

Mask body(const volume::Volume &volume, double marginMm, const task::Progress &progress) {
    const volume::Lattice &lattice = volume.lattice();
    const double threshold = airThreshold(volume);
    Mask tissue(lattice.size().count());
    volume.visit([&](auto samples) {
        for (std::size_t n = 0; n < tissue.size(); ++n)
            tissue[n] = double(samples[n]) > threshold;
    });
    // Slices are filled first, because an opening would connect the lungs to the surrounding air.
    const Mask opened = opening(lattice, filledSlices(lattice, tissue, progress.part(0.0, 0.2)),
                                couchRadiusMm, progress.part(0.2, 0.6));
    const Mask core = largestPart(lattice, opened, 1.0, progress.part(0.6, 0.7));
    Mask patient = dilated(lattice, core, roughnessMm, progress.part(0.7, 0.75));
    for (std::size_t n = 0; n < patient.size(); ++n)
        patient[n] = std::uint8_t((patient[n] & tissue[n]) | core[n]);
    patient = withShortParts(lattice, std::move(patient), tissue, progress.part(0.75, 0.8));
    return dilated(lattice, filledSlices(lattice, patient, progress.part(0.8, 0.9)), marginMm,
                   progress.part(0.9, 1.0));
}

Mask skin(const volume::Volume &volume, double depthMm, double marginMm,
          const task::Progress &progress) {
    const Mask patient = body(volume, 0.0, progress.part(0.0, 0.7));
    // At least one sample deep, because coarse volumes would otherwise have no skin.
    const double depth = std::max(depthMm, 1.01 * volume.lattice().shortestStepMm());
    const Mask deep = eroded(volume.lattice(), patient, depth, progress.part(0.7, 0.85));
    Mask shell = dilated(volume.lattice(), patient, marginMm, progress.part(0.85, 1.0));
    for (std::size_t n = 0; n < shell.size(); ++n)
        shell[n] = std::uint8_t(shell[n] & ~deep[n] & 1);
    return shell;
}

namespace {

// A ball of a radius in mm: the samples of the lattice whose centres are inside.
itk::FlatStructuringElement<3> ballOf(const volume::Lattice &lattice, double radiusMm) {
    using Element = itk::FlatStructuringElement<3>;
    Element::RadiusType radius;
    for (unsigned d = 0; d < 3; ++d)
        radius[d] = itk::SizeValueType(radiusMm / lattice.spacingMm(int(d)) * (1.0 + 1e-6));
    Element ball;
    ball.SetRadius(radius);
    auto at = ball.Begin();
    for (unsigned n = 0; at != ball.End(); ++at, ++n) {
        double squares = 0.0;
        for (unsigned d = 0; d < 3; ++d) {
            const double off = double(ball.GetOffset(n)[d]) * lattice.spacingMm(int(d));
            squares += off * off;
        }
        *at = squares <= radiusMm * radiusMm * (1.0 + 1e-5);
    }
    return ball;
}

template <class Filter>
Mask morphology(Filter &filter, const char *step, const volume::Lattice &lattice, const Mask &mask,
                double radiusMm, const task::Progress &progress) {
    filter.SetKernel(ballOf(lattice, radiusMm));
    filter.SetForegroundValue(1);
    filter.SetInput(imageOver<MaskImage>(lattice, mask.data()));
    runFilter(filter, step, progress);
    return samplesOf(*filter.GetOutput());
}

} // namespace

Mask openingByItk(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
                  const task::Progress &progress) {
    using Kernel = itk::FlatStructuringElement<3>;
    auto filter = itk::BinaryMorphologicalOpeningImageFilter<MaskImage, MaskImage, Kernel>::New();
    return morphology(*filter, "opening", lattice, mask, radiusMm, progress);
}

Mask closingByItk(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
                  const task::Progress &progress) {
    using Kernel = itk::FlatStructuringElement<3>;
    auto filter = itk::BinaryMorphologicalClosingImageFilter<MaskImage, MaskImage, Kernel>::New();
    filter->SetSafeBorder(true);
    return morphology(*filter, "closing", lattice, mask, radiusMm, progress);
}

} // namespace pellucid::preprocess
