// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/frame_widths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/render/frame_inputs.h"
#include "core/widths/choose_widths.h"

namespace pellucid::render {

namespace {

using fourier::stripFloats;
using fourier::stripLanes;
using widths::SliceTiles;

// The sources of the slice, each at the offset of every term; see FrameShading. A linear cue
// changes all energies by about the same factor.
std::vector<widths::SliceSource> sliceSources(const widths::AdaptiveWidths &adaptive,
                                              const FrameInputs &inputs) {
    const Mixing &mixing = inputs.mixing;
    std::vector<widths::SliceSource> sources;
    for (const FrameSource &from : mixing.sources)
        for (int t = 0; t < inputs.shading.termCount; ++t) {
            const FrameShading::Term &term = inputs.shading.terms[std::size_t(t)];
            const bool isGradient = from.kind == FrameKind::gradient;
            widths::SliceSource source{
                (isGradient ? adaptive.gradients : adaptive.fields)[from.field].get(),
                term.cells,
                0.0,
                {}};
            for (std::size_t image = 0; image < std::size_t(mixing.imageCount); ++image) {
                const FrameShading::Image &shade = inputs.shading.images[image];
                const ChannelWeights &color = mixing.imageColor(image);
                const double share = from.weights[mixing.sums > 1 ? image : 0] *
                                     std::hypot(color[0], color[1], color[2]);
                const double energy = std::norm(term.weight) * share * share,
                             constant = isGradient ? shade.magnitude : shade.ambient;
                source.factor += energy * constant * constant;
                for (std::size_t d = 0; d < 3 && !isGradient; ++d) {
                    source.factor += energy * shade.excess[d] * shade.excess[d];
                    source.perSine[d] += energy * shade.gradient[d] * shade.gradient[d];
                }
            }
            sources.push_back(source);
        }
    return sources;
}

// Reads lines of a slice, a few at a time.
class LineReader {
public:
    static constexpr int linesTogether = 8;
    using Lines = std::span<const widths::SliceLine>;

    LineReader(const FrameInputs &inputs, const FrameJob &job)
        : m_inputs(inputs), m_job(job), m_images(std::size_t(inputs.mixing.imageCount)) {}

    // The squared errors of at most `linesTogether` lines, by each width of `by`. *Requires*: `by`
    // is ascending; its last width is the reference, whose errors stay 0.
    void measure(Lines lines, std::span<const int> by,
                 std::span<widths::ErrorsByWidth> errors) const {
        Scratch scratch;
        std::array<StripLine, linesTogether> listed;
        for (std::size_t n = 0; n < lines.size(); ++n)
            listed[n] = {lines[n].strip, lines[n].rowOf(0),
                         rowsFromFirst(lines[n], scratch.rows[n].data()),
                         rollOff(lines[n], scratch.rollOff[n].data())};
        for (auto width = by.rbegin(); width != by.rend(); ++width) {
            const bool isWidest = width == by.rbegin();
            FrameScratch read{.batches = scratch.batches.data()};
            for (std::size_t c = 0; c < m_images; ++c)
                read.strips[c] = (isWidest ? scratch.widest : scratch.narrower)[c].data();
            if (*width > 0)
                readLines(m_job, std::span(listed).first(lines.size()), *width, read);
            for (std::size_t n = 0; n < lines.size() && !isWidest; ++n)
                errors[n][std::size_t(*width)] =
                    energyOf(lines[n], n, scratch.widest, *width > 0 ? &scratch.narrower : nullptr);
        }
    }

private:
    using Values = std::array<std::array<float, linesTogether * stripFloats>, FrameJob::maxImages>;
    struct alignas(64) Scratch {
        Values widest, narrower;
        std::array<std::array<float, stripLanes>, linesTogether> rows, rollOff;
        std::array<FrequencyBatch, batchesAhead + 1> batches;
    };

    static const float *rowsFromFirst(const widths::SliceLine &line, float *rows) {
        if (line.rise == 0)
            return nullptr;
        for (int lane = 0; lane < stripLanes; ++lane)
            rows[lane] = float(line.rowOf(lane) - line.rowOf(0));
        return rows;
    }
    const float *rollOff(const widths::SliceLine &line, float *factors) const {
        const int column = line.strip * stripLanes, row = line.tile * SliceTiles::rows,
                  last = row + SliceTiles::rows - 1;
        const double farthest =
            std::hypot(2.0 * (column + stripLanes - 1) / m_job.columns,
                       2.0 * std::max(std::abs(row), std::abs(last)) / m_job.rows);
        if (m_inputs.radial.detail <= 0.0 && farthest <= 1.0 - m_inputs.radial.rollOffShare)
            return nullptr;
        for (int lane = 0; lane < stripLanes; ++lane) {
            const double radius = std::hypot(2.0 * (column + lane) / m_job.columns,
                                             2.0 * line.rowOf(lane) / m_job.rows);
            factors[lane] = float(radius < 1.0 ? m_inputs.radial.at(radius) : 0.0);
        }
        return factors;
    }

    // The energy of red, green and blue in a line, with its mirror image. `less` is subtracted
    // first.
    double energyOf(const widths::SliceLine &line, std::size_t place, const Values &values,
                    const Values *less) const {
        double energy = 0.0;
        for (std::size_t lane = 0; lane < std::size_t(stripLanes); ++lane) {
            std::array<std::complex<double>, 3> channels{};
            for (std::size_t image = 0; image < m_images; ++image) {
                const std::size_t re = place * stripFloats + lane, im = re + stripLanes;
                std::complex<double> value(values[image][re], values[image][im]);
                if (less != nullptr)
                    value -= std::complex<double>((*less)[image][re], (*less)[image][im]);
                for (std::size_t c = 0; c < 3; ++c)
                    channels[c] += m_inputs.mixing.imageColor(image)[c] * value;
            }
            // Column 0 holds both halves of its rows.
            const double weight = line.strip == 0 && lane == 0 ? 1.0 : 2.0;
            for (const auto &channel : channels)
                energy += weight * std::norm(channel);
        }
        return energy;
    }

    const FrameInputs &m_inputs;
    const FrameJob &m_job;
    std::size_t m_images;
};

} // namespace

widths::WidthMap FrameWidths::choose(const widths::AdaptiveWidths &adaptive,
                                     const FrameInputs &inputs, const fourier::Spectrum &spectrum,
                                     const scene::ImageDefinition &image,
                                     const widths::ForEach &forEach) {
    const widths::SlicePlane plane = inputs.plane();
    const SliceTiles tiles(plane);
    if (!m_factors || m_factors->first != image)
        m_factors.emplace(image, widths::FactorBounds(image));
    // Phases do not change energies. The unit is that of the spectra.
    Strip ones{};
    ones.columns.fill(1.0F);
    m_columnPhase.assign(std::size_t(tiles.strips), ones);
    m_columnPhase.resize(2 * m_columnPhase.size(), Strip{});
    m_rowPhase.assign(std::size_t(tiles.perSide) * SliceTiles::rows + 1, float(inputs.mixing.unit));
    FrameJob job = readingJob(inputs, spectrum, image);
    job.stripCount = tiles.strips;
    job.columnPhase = m_columnPhase.front().columns.data();
    job.rowPhase = m_rowPhase.data();
    const LineReader reader(inputs, job);

    std::vector<int> by{0};
    for (int width = fourier::KernelsByWidth::narrowest; width <= adaptive.kernels->widest();
         ++width)
        by.push_back(width);
    const auto measureBy = [&](std::span<const int> widths, LineReader::Lines lines) {
        std::vector<widths::ErrorsByWidth> errors(lines.size());
        constexpr int together = LineReader::linesTogether;
        forEach((int(lines.size()) + together - 1) / together, [&](int part) {
            const std::size_t first = std::size_t(part) * together,
                              count = std::min(lines.size() - first, std::size_t(together));
            reader.measure(lines.subspan(first, count), widths,
                           std::span(errors).subspan(first, count));
        });
        return errors;
    };

    // The lowest frequencies bound the energy of the picture from below.
    std::vector<widths::SliceLine> lowest;
    const int last = std::min(SliceTiles::rows / 2, plane.rows / 2 - 1);
    for (int row = -last; row <= last; ++row)
        lowest.push_back({0, row < 0 ? -1 : 0, row < 0 ? row + SliceTiles::rows : row, 0});
    double energy = 0.0;
    for (const widths::ErrorsByWidth &row : measureBy(std::array{0, by.back()}, lowest))
        energy += row[0];
    const double tolerance = adaptive.tolerance * scene::detailGain(image),
                 budget = tolerance * tolerance * energy;
    const std::vector<float> energies = widths::tileEnergies(
        plane, tiles, sliceSources(adaptive, inputs), m_factors->second, forEach);
    return widths::chooseWidths(tiles, energies, budget, by,
                                [&](LineReader::Lines lines) { return measureBy(by, lines); });
}

} // namespace pellucid::render
