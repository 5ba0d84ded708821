// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/error_prediction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

namespace pellucid::plan {

namespace {

// The factor that a sample at x gets from the taps read at a frequency t off the grid. `Any`: a
// Kernel or a MomentKernel.
template <class Any> std::complex<double> offGrid(const Any &kernel, double x, double t) {
    const double half = 0.5 * kernel.width();
    std::complex<double> sum = 0.0;
    for (double tap = std::ceil(-half - t) + t; tap < half; tap += 1.0)
        sum += kernel.value(tap) * std::polar(1.0, 2.0 * std::numbers::pi * tap * x);
    return sum;
}
template <class Any> std::complex<double> onGrid(const Any &kernel, double x) {
    return offGrid(kernel, x, 0.0);
}

// Beyond these periods the kernels' transforms fall at least as fast as 1/m.
constexpr std::array<int, 6> aliasPeriods{-3, -2, -1, 1, 2, 3};

} // namespace

namespace {

BlockAmplitudes amplitudesAt(const fourier::Kernel &kernel, double x) {
    const double h = kernel.apodisation(x);
    BlockAmplitudes amplitudes;
    for (const int m : aliasPeriods) {
        const double r = kernel.apodisation(x + m) / h;
        amplitudes.aliases += r * r;
    }
    const auto at = [&](double t) { return std::norm(offGrid(kernel, x, t) / h - 1.0); };
    // Frequencies that share steps with the grid: every one on it, every second, every third.
    const double whole = at(0.0);
    amplitudes.inPhase = std::max(
        {amplitudes.aliases, whole, 0.5 * (whole + at(0.5)), (whole + 2.0 * at(1.0 / 3.0)) / 3.0});
    amplitudes.inverse = 1.0 / (h * h);
    return amplitudes;
}

// The largest mean of a value over the parts of a field that their shares allow. For fields with
// negative samples: the expected mean. Values are sorted into classes, and each class counts with
// its largest value.
class LargestMean {
public:
    LargestMean(const field::EnergyMarginals &field) : m_field(field) {}

    template <class F> double of(const F &value) const {
        const double peakedness = m_field.spread->peakedness;
        if (std::isinf(peakedness)) {
            double sum = 0.0;
            for (const field::Block &block : m_field.blocks)
                sum += double(block.energy) * value(block.at);
            return sum;
        }
        constexpr int classes = 256;
        constexpr double octaves = 64.0, perOctave = classes / octaves;
        std::array<double, classes> share{}, most{};
        for (const field::Block &block : m_field.blocks) {
            const double v = value(block.at);
            const int n =
                std::clamp(int(perOctave * (std::log2(std::max(v, 1e-18)) + 58.0)), 0, classes - 1);
            share[std::size_t(n)] += peakedness * double(block.mass);
            most[std::size_t(n)] = std::max(most[std::size_t(n)], v);
        }
        double sum = 0.0, left = 1.0;
        for (int n = classes - 1; n >= 0 && left > 0.0; --n) {
            const double part = std::min(left, share[std::size_t(n)]);
            sum += part * most[std::size_t(n)];
            left -= part;
        }
        return sum;
    }

private:
    const field::EnergyMarginals &m_field;
};

} // namespace

AxisError axisError(const fourier::Kernel &kernel, int padded, int samples, double stepMm) {
    AxisError error;
    error.periodMm = padded * stepMm;
    for (const field::BlockRange &range : field::blockRanges(samples)) {
        // Amplitudes grow outward, so both ends of a block bound it.
        BlockAmplitudes worst;
        for (const int n : {range.first, range.last}) {
            const BlockAmplitudes at =
                amplitudesAt(kernel, double(n - samples / 2) / padded); // NOLINT: whole
            worst.aliases = std::max(worst.aliases, at.aliases);
            worst.inPhase = std::max(worst.inPhase, at.inPhase);
            worst.inverse = std::max(worst.inverse, at.inverse);
        }
        error.blocks.push_back(worst);
    }
    error.kernelEnergy = kernel.energy();
    return error;
}

void addMomentError(AxisError &error, const fourier::Kernel &kernel,
                    const fourier::MomentKernel &moment, int padded,
                    const field::SlabProducts &slabs) {
    // Beyond the second alias the responses fall fast.
    constexpr std::array<int, 5> periods{0, -1, 1, -2, 2};
    const auto count = std::size_t(slabs.slabs);
    std::array<std::vector<double>, periods.size()> apart;
    std::vector<double> real(count), imaginary(count);
    for (auto &weights : apart)
        weights.resize(count);
    for (std::size_t n = 0; n < count; ++n) {
        const double middle = (double(n) + 0.5) * slabs.samples / double(count) - 0.5;
        const double x = (middle - slabs.samples / 2) / padded; // NOLINT: the wrap voxel is whole
        const double h = kernel.apodisation(x);
        for (std::size_t p = 0; p < periods.size(); ++p) {
            const double ideal = periods[p] == 0 ? x : 0.0;
            apart[p][n] = moment.response(x + periods[p]) / h - ideal;
        }
        const std::complex<double> left = onGrid(moment, x) / h - std::complex<double>(0.0, x);
        real[n] = left.real();
        imaginary[n] = left.imag();
    }
    double aliases = 0.0;
    for (const auto &weights : apart)
        aliases += slabs.energy(weights);
    error.moment = std::max({error.moment, aliases, slabs.energy(real) + slabs.energy(imaginary)});
}

double largestTapError(const fourier::Kernel &kernel, double x) {
    constexpr int places = 32;
    double largest = 0.0;
    for (int n = 0; n <= places; ++n)
        for (int m = 0; m < places; ++m) {
            const double at = x * n / places;
            largest = std::max(
                largest,
                std::abs(offGrid(kernel, at, double(m) / places) / kernel.apodisation(at) - 1.0));
        }
    return largest;
}

double cueRms(const shading::DepthCue &cue) {
    const double square = cue.strength * cue.strength;
    switch (cue.kind) {
    case shading::CueKind::none:
        break;
    case shading::CueKind::linear:
        return std::sqrt(1.0 + square / 3.0);
    case shading::CueKind::sine:
        return std::sqrt(1.0 + square / 2.0);
    case shading::CueKind::curve: {
        const std::vector<double> cosines = shading::cosinesOf(cue.curve);
        const double mean = 1.0 + cue.strength * (cosines.front() - 1.0);
        double sum = mean * mean;
        for (std::size_t k = 1; k < cosines.size(); ++k)
            sum += 0.5 * square * cosines[k] * cosines[k];
        return std::sqrt(sum);
    }
    }
    return 1.0;
}

namespace {

// Distance of the centre of the energy from the centre of the lattice, mm.
double middleOffsetMm(const volume::Lattice &lattice, const volume::VoxelBox &box,
                      const field::EnergyMarginals &energy) {
    const std::array<int, 3> first{box.lo.i, box.lo.j, box.lo.k};
    glm::dvec3 middle(0.0);
    for (int d = 0; d < 3; ++d) {
        double all = 0.0;
        const std::vector<double> &axis = energy.axis[std::size_t(d)];
        for (std::size_t n = 0; n < axis.size(); ++n) {
            middle[d] += axis[n] * (double(n) + first[std::size_t(d)]);
            all += axis[n];
        }
        if (!(all > 0.0)) // an empty field has no centre, and no error
            return 0.0;
        middle[d] /= all;
    }
    return glm::distance(lattice.patient(volume::VoxelPoint{middle}).mm, lattice.center().mm);
}

// The smallest root mean square of the cue over the depths of the energy, over the directions of
// its profiles. The profiles contain distances but not sides: both sides count alike, or, if the
// energy is on one side, only the darker one.
double minRms(const std::function<double(double)> &cue, const field::EnergySpread &spread,
              double radiusMm, double offsetMm) {
    double least = 1.0;
    for (const auto &shares : spread.byDistance) {
        double both = 0.0, darker = 0.0, all = 0.0, squares = 0.0;
        for (std::size_t n = 0; n < shares.size(); ++n) {
            const double mm = (double(n) + 0.5) * spread.distanceStepMm, t = mm / radiusMm;
            const double near = cue(t) * cue(t), far = cue(-t) * cue(-t);
            both += 0.5 * shares[n] * (near + far);
            darker += shares[n] * std::min(near, far);
            all += shares[n];
            squares += shares[n] * mm * mm;
        }
        if (all > 0.0) {
            const bool isOneSided = offsetMm > 0.5 * std::sqrt(squares / all);
            least = std::min(least, std::sqrt((isOneSided ? darker : both) / all));
        }
    }
    return least;
}

} // namespace

CueWeight cueWeight(const shading::DepthCue &cue, const volume::Lattice &lattice, double radiusMm,
                    const fourier::SpectrumLayout &layout, const field::EnergyMarginals &energy) {
    CueWeight weight;
    if (!cue.isActive())
        return weight;
    const auto value = shading::cueFunction(cue);
    const double offset = middleOffsetMm(lattice, layout.box, energy);
    double least = 1.0;
    if (cue.kind == shading::CueKind::curve)
        least = minRms(value, *energy.spread, radiusMm, offset);
    else
        for (const double t : {-offset / radiusMm, offset / radiusMm}) // both are monotonic
            least = std::min(least, value(t));
    // At least the value of a linear cue half a sample from where it is darkest.
    least = std::max(0.5 * cue.strength * lattice.shortestStepMm() / radiusMm, least);
    weight.aliases = cueRms(cue) / least;
    if (cue.kind == shading::CueKind::linear)
        for (int d = 0; d < 3; ++d)
            weight.moments[std::size_t(d)] =
                cue.strength * lattice.spacingMm(d) * layout.padded[d] / radiusMm / least;
    return weight;
}

namespace {

// Rounding errors are uniform up to half a unit in the last place, 2^-11 of the leading power of
// two; over the mantissas that is 0.73 * 2^-11/sqrt(3). At most, it is 2^-11. In float the
// transform rounds, in log2(512^3) = 27 steps: 27 roundings of up to 2^-24 add in quadrature to
// 3e-7.
constexpr double meanRounding16 = 2.1e-4, mostRounding16 = 4.9e-4, rounding32 = 3e-7;

// The share of pairs of the energy that lie in one layer across an axis.
double inOneLayer(const std::vector<double> &shares) {
    double sum = 0.0;
    for (const double share : shares)
        sum += share * share;
    return sum;
}

// The largest share of a slice's energy that one cell can have.
double largestCell(const std::array<AxisError, 3> &axes, const field::EnergySpread &spread) {
    const double i = axes[0].periodMm, j = axes[1].periodMm, k = axes[2].periodMm,
                 cells = std::min({i * j, j * k, k * i}) * spread.leastProjection;
    return 1.0 / std::max(1.0, cells);
}

// The energy of rounding over that of a cell.
double cellRounding(const std::array<AxisError, 3> &axes, fourier::Storage storage,
                    const field::EnergyMarginals &field) {
    if (storage == fourier::Storage::float32)
        return rounding32 * rounding32;
    const double mean = meanRounding16 * meanRounding16, most = mostRounding16 * mostRounding16,
                 i = inOneLayer(field.axis[0]), j = inOneLayer(field.axis[1]),
                 k = inOneLayer(field.axis[2]), equal = std::max({i * j, j * k, k * i});
    return mean +
           std::min(1.0, equal + std::sqrt(largestCell(axes, *field.spread))) * (most - mean);
}

// Independent errors reach a slice with the kernel's energy, equal errors in full.
// Cells along an axis round alike as far as the energy lies in one layer.
double roundingNoise(const std::array<AxisError, 3> &axes, const field::EnergyMarginals &field) {
    double energy = 1.0;
    for (std::size_t d = 0; d < axes.size(); ++d) {
        const double kernel = axes[d].kernelEnergy;
        energy *= kernel + std::max(0.0, 1.0 - kernel) * inOneLayer(field.axis[d]);
    }
    return energy * LargestMean(field).of([&](const auto &at) {
        double inverse = 1.0;
        for (std::size_t d = 0; d < axes.size(); ++d)
            inverse *= axes[d].blocks[at[d]].inverse;
        return inverse;
    });
}

} // namespace

double predictRelativeError(const std::array<AxisError, 3> &axes, fourier::Storage storage,
                            const field::EnergyMarginals &field, double share,
                            const CueWeight &cue) {
    const double aliases = LargestMean(field).of([&](const auto &at) {
        double sum = 0.0;
        for (std::size_t d = 0; d < axes.size(); ++d)
            sum += std::sqrt(axes[d].blocks[at[d]].inPhase);
        return sum * sum;
    });
    double moment = 0.0;
    for (std::size_t d = 0; d < axes.size(); ++d) {
        // Depth is measured along one direction, so the worst axis represents all.
        moment = std::max(moment, cue.moments[d] * cue.moments[d] * axes[d].moment);
    }
    const double weight = cue.aliases * cue.aliases;
    // Rounding errors are distributed like h^2, so nearly all of their energy is where the field
    // is.
    return std::sqrt((weight * aliases + moment) / share +
                     weight * cellRounding(axes, storage, field) * roundingNoise(axes, field));
}

} // namespace pellucid::plan
