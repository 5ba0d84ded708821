// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/filters.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
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

#include "core/preprocess/box_around.h"
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
// The shell of a head rest is denser than an ear that is pressed against it, and longer than an ear
// or a row of teeth. Around it, values mix.
constexpr double shellHu = 250.0, shortestShellMm = 90.0, shellRimMm = 1.5;

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

// A box with more samples on each side, within the grid.
volume::VoxelBox widened(const volume::VoxelBox &box, const int (&by)[3],
                         const volume::GridSize &size) {
    const auto from = [&](int lo, int axis) { return std::max(lo - by[axis], 0); };
    const auto to = [&](int hi, int axis) { return std::min(hi + by[axis], size[axis]); };
    return {{from(box.lo.i, 0), from(box.lo.j, 1), from(box.lo.k, 2)},
            {to(box.hi.i, 0), to(box.hi.j, 1), to(box.hi.k, 2)}};
}

// Finds the samples within a distance of those that have a value in a mask. Squared distances are
// accumulated axis by axis, no farther than the distance. ITK's distance map has no such limit and
// takes ten times as long for anatomical radii.
class Nearness {
public:
    Nearness(const volume::Lattice &lattice, const Mask &mask, std::uint8_t value, double radiusMm)
        : m_size(lattice.size()), m_mask(mask), m_value(value),
          // A distance equal to the radius counts in spite of rounding.
          m_limit(float(radiusMm * radiusMm * (1.0 + 1e-5))) {
        for (int d = 0; d < 3; ++d) {
            m_step[d] = lattice.spacingMm(d);
            m_reach[d] = int(std::min(radiusMm / m_step[d] * (1.0 + 1e-5), double(m_size[d])));
        }
    }

    // *Requires*: the mask contains both values.
    Mask find(const task::Progress &progress) const {
        // What is far from the samples of the mask has no such neighbour, and only such neighbours.
        const int one[3] = {1, 1, 1};
        const volume::VoxelBox box =
            widened(boxAround(m_size, m_mask), m_value == 1 ? m_reach : one, m_size);
        Mask near(m_mask.size(), std::uint8_t(1 - m_value));
        // A part of the slices at a time, with those that it reaches, stays in the caches.
        const int chunk = std::max(8, m_reach[2]);
        const int chunks = (box.hi.k - box.lo.k + chunk - 1) / chunk;
        std::atomic<int> done = 0;
        tbb::parallel_for(0, chunks, [&](int n) {
            progress.check();
            const int first = box.lo.k + n * chunk;
            slices(box, first, std::min(first + chunk, box.hi.k), near);
            progress.report(double(++done) / chunks);
        });
        return near;
    }

private:
    static constexpr float far = 1e30F;

    // The slices from `first` to before `end`.
    void slices(const volume::VoxelBox &box, int first, int end, Mask &near) const {
        const volume::GridSize in = box.size();
        const int from = std::max(first - m_reach[2], box.lo.k),
                  to = std::min(end + m_reach[2], box.hi.k);
        const auto plane = std::size_t(in.i) * std::size_t(in.j);
        const auto alongRows = std::make_unique_for_overwrite<float[]>(plane);
        const auto inSlices =
            std::make_unique_for_overwrite<float[]>(plane * std::size_t(to - from));
        for (int k = from; k < to; ++k) {
            for (int j = 0; j < in.j; ++j)
                measureRow(m_mask.data() + m_size.offsetOf(box.lo.i, box.lo.j + j, k), in.i,
                           alongRows.get() + std::size_t(j) * std::size_t(in.i));
            gatherRows(alongRows.get(), in, inSlices.get() + std::size_t(k - from) * plane);
        }
        std::vector<float> squares(std::size_t(in.i));
        for (int k = first; k < end; ++k)
            for (int j = 0; j < in.j; ++j) {
                std::fill(squares.begin(), squares.end(), far);
                for (int d = std::max(-m_reach[2], from - k); d <= m_reach[2] && k + d < to; ++d)
                    nearer(inSlices.get() + std::size_t(k + d - from) * plane +
                               std::size_t(j) * std::size_t(in.i),
                           in.i, float(d * m_step[2] * d * m_step[2]), squares.data());
                std::uint8_t *const out = near.data() + m_size.offsetOf(box.lo.i, box.lo.j + j, k);
                for (int i = 0; i < in.i; ++i)
                    out[i] = squares[std::size_t(i)] <= m_limit;
            }
    }

    void measureRow(const std::uint8_t *in, int count, float *out) const {
        const auto step = float(m_step[0]);
        float last = far;
        for (int i = 0; i < count; ++i)
            out[i] = last = in[i] == m_value ? 0.0F : last + step;
        last = far;
        for (int i = count - 1; i >= 0; --i) {
            last = in[i] == m_value ? 0.0F : last + step;
            const float least = std::min(out[i], last);
            out[i] = least < far ? least * least : far;
        }
    }

    static void nearer(const float *from, int count, float square, float *to) {
        for (int i = 0; i < count; ++i)
            to[i] = std::min(to[i], from[i] + square);
    }

    // From the rows of a slice to its rows and columns.
    void gatherRows(const float *from, const volume::GridSize &in, float *to) const {
        for (int j = 0; j < in.j; ++j) {
            float *const row = to + std::size_t(j) * std::size_t(in.i);
            std::fill_n(row, in.i, far);
            for (int d = std::max(-m_reach[1], -j); d <= m_reach[1] && j + d < in.j; ++d)
                nearer(from + std::size_t(j + d) * std::size_t(in.i), in.i,
                       float(d * m_step[1] * d * m_step[1]), row);
        }
    }

    volume::GridSize m_size;
    const Mask &m_mask;
    std::uint8_t m_value;
    float m_limit;
    double m_step[3];
    int m_reach[3];
};

Mask inverted(Mask mask) {
    for (std::uint8_t &m : mask)
        m = std::uint8_t(1 - m);
    return mask;
}

Mask grown(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
           const task::Progress &progress) {
    return isUniform(mask) ? mask : Nearness(lattice, mask, 1, radiusMm).find(progress);
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

// The extent of each part along the axes.
std::vector<volume::VoxelBox> boxesOf(const Parts &parts, const volume::GridSize &size) {
    std::vector<volume::VoxelBox> boxes(parts.count + 1);
    std::size_t n = 0;
    for (int k = 0; k < size.k; ++k)
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i, ++n)
                if (parts.labels[n] != 0) {
                    volume::VoxelBox &box = boxes[parts.labels[n]];
                    box = united(box, {{i, j, k}, {i + 1, j + 1, k + 1}});
                }
    return boxes;
}

double diagonalMm(const volume::VoxelBox &box, const volume::Lattice &lattice) {
    const volume::GridSize size = box.size();
    return glm::length(glm::dvec3(size.i * lattice.spacingMm(0), size.j * lattice.spacingMm(1),
                                  size.k * lattice.spacingMm(2)));
}

// The tissue outside the core.
Mask thinParts(const Mask &tissue, const Mask &core) {
    Mask thin(tissue.size());
    for (std::size_t n = 0; n < thin.size(); ++n)
        thin[n] = std::uint8_t(tissue[n] & ~core[n] & 1);
    return thin;
}

// The dense shells of head rests and couches, with the rim in which their values mix with those
// around: dense parts that are long, and mostly too thin for the core. Empty: there are none. For
// values in HU.
Mask shellsOf(const volume::Volume &volume, const Mask &core, const task::Progress &progress) {
    const volume::Lattice &lattice = volume.lattice();
    Mask dense(core.size());
    volume.visit([&](auto samples) {
        for (std::size_t n = 0; n < dense.size(); ++n)
            dense[n] = double(samples[n]) > shellHu;
    });
    const Parts parts = partsOf(lattice, dense, "body", progress.part(0.0, 0.5));
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
    return dilated(lattice, dense, shellRimMm, progress.part(0.5, 1.0));
}

void remove(const Mask &removed, Mask &from) {
    for (std::size_t n = 0; n < removed.size(); ++n)
        from[n] = std::uint8_t(from[n] & ~removed[n] & 1);
}

// The core with thin, short parts of the tissue that touch it: an ear, but not a couch.
Mask withShortParts(const volume::Lattice &lattice, Mask core, const Mask &tissue,
                    const task::Progress &progress) {
    const volume::GridSize size = lattice.size();
    const Parts parts = partsOf(lattice, thinParts(tissue, core), "body", progress);
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

} // namespace

Mask eroded(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
            const task::Progress &progress) {
    return isUniform(mask) ? mask : inverted(Nearness(lattice, mask, 0, radiusMm).find(progress));
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
    Mask core = largestPart(lattice, opened, 1.0, progress.part(0.6, 0.7));
    const Mask shells = volume.unit() == volume::ValueUnit::hounsfield
                            ? shellsOf(volume, core, progress.part(0.7, 0.72))
                            : Mask();
    remove(shells, tissue);
    remove(shells, core);
    Mask patient = dilated(lattice, core, roughnessMm, progress.part(0.72, 0.75));
    for (std::size_t n = 0; n < patient.size(); ++n)
        patient[n] = std::uint8_t((patient[n] & tissue[n]) | core[n]);
    patient = withShortParts(lattice, std::move(patient), tissue, progress.part(0.75, 0.8));
    Mask all = dilated(lattice, filledSlices(lattice, patient, progress.part(0.8, 0.9)), marginMm,
                       progress.part(0.9, 1.0));
    remove(shells, all); // the margin reaches those that touch the skin
    return all;
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
