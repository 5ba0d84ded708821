// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/coarse_fields.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/plan/error_prediction.h"

namespace pellucid::accuracy {

namespace {

// With at most this many samples the cells of the spectrum are alike and round alike, so their
// errors average out less.
constexpr int fewSamples = 10;

// A block along one axis.
struct AxisBlock {
    double middle;        ///< index of its middle in the lattice
    double before, after; ///< amplitudes of the aliases of the periods below and above
    double inverse;       ///< 1/h^2
    double halfSteps;     ///< from the middle to the outer samples
};

// One axis of a layout, with the fields' energy along it.
class Axis {
public:
    Axis(const fourier::SpectrumLayout &layout, int axis,
         std::span<const plan::FieldSummary> summaries)
        : m_kernel(layout.kernels[std::size_t(axis)]), m_axis(std::size_t(axis)),
          m_first(axis == 0   ? layout.box.lo.i
                  : axis == 1 ? layout.box.lo.j
                              : layout.box.lo.k),
          m_samples(layout.box.size()[axis]), m_padded(layout.padded[axis]),
          m_summaries(summaries) {}

    int samples() const { return m_samples; }
    int padded() const { return m_padded; }
    double kernelEnergy() const { return isShort() ? 1.0 : m_kernel.energy(); }

    std::vector<AxisBlock> blocks() const {
        std::vector<AxisBlock> blocks;
        for (const plan::BlockRange &range : plan::blockRanges(m_samples))
            blocks.push_back(blockOf(range));
        return blocks;
    }

    // The worst of the fields.
    double momentError() const {
        const fourier::MomentKernel moment(m_kernel, double(m_padded) / m_samples);
        double worst = 0.0;
        for (const plan::FieldSummary &field : m_summaries) {
            plan::AxisError error;
            plan::addMomentError(error, m_kernel, moment, m_padded,
                                 field.slabs ? (*field.slabs)[m_axis]
                                             : plan::evenSlabProducts(field.energy.axis[m_axis]));
            worst = std::max(worst, error.moment);
        }
        return worst;
    }

    // The cells of a few samples are alike, so their errors stay where the samples are.
    std::vector<double> roundingShares() const {
        constexpr int steps = 24;
        std::vector<double> shares(steps);
        double sum = 0.0;
        for (int n = 0; n < steps; ++n) {
            const double x = 2.0 * (n + 0.5) / steps - 1.0, h = m_kernel.apodisation(x);
            const bool isField = std::abs(x) <= 0.5 * m_samples / m_padded + 1.0 / steps;
            sum += shares[std::size_t(n)] = isShort() ? double(isField) : h * h;
        }
        for (double &share : shares)
            share /= sum;
        return shares;
    }

private:
    bool isShort() const { return m_samples <= fewSamples; }

    // In periods from the wrap voxel, the middle one.
    double position(double index) const {
        const int middle = m_samples / 2;
        return (index - middle) / m_padded;
    }

    // Root mean squares over the block, weighted by energy; the sign is that at its middle.
    AxisBlock blockOf(const plan::BlockRange &range) const {
        double before = 0.0, after = 0.0, inverse = 0.0, all = 0.0;
        for (int n = range.first; n <= range.last; ++n) {
            double weight = 1e-12; // for blocks without energy
            for (const plan::FieldSummary &field : m_summaries)
                weight += field.energy.axis[m_axis][std::size_t(n)];
            const double x = position(n), h = m_kernel.apodisation(x);
            for (const int m : {-2, -1})
                before += weight * std::pow(m_kernel.apodisation(x + m) / h, 2);
            for (const int m : {1, 2})
                after += weight * std::pow(m_kernel.apodisation(x + m) / h, 2);
            inverse += weight / (h * h);
            all += weight;
        }
        const double middle = 0.5 * (range.first + range.last), x = position(middle);
        return {middle + m_first,
                std::copysign(std::sqrt(before / all), m_kernel.apodisation(x - 1.0)),
                std::copysign(std::sqrt(after / all), m_kernel.apodisation(x + 1.0)),
                isShort() ? 1.0 : inverse / all, 0.5 * (range.last - range.first)};
    }

    const fourier::Kernel &m_kernel;
    std::size_t m_axis;
    int m_first, m_samples, m_padded;
    std::span<const plan::FieldSummary> m_summaries;
};

using AxisBlocks = std::array<std::vector<AxisBlock>, 3>;

CoarseFields::Block blockAt(const std::array<std::uint8_t, 3> &at, const AxisBlocks &axes,
                            const volume::Lattice &lattice) {
    const AxisBlock &i = axes[0][at[0]], &j = axes[1][at[1]], &k = axes[2][at[2]];
    CoarseFields::Block block;
    block.fromCentreMm = lattice.patient(volume::VoxelPoint{{i.middle, j.middle, k.middle}}).mm -
                         lattice.center().mm;
    block.aliases = {float(i.before), float(i.after),  float(j.before),
                     float(j.after),  float(k.before), float(k.after)};
    block.halfSteps = {float(i.halfSteps), float(j.halfSteps), float(k.halfSteps)};
    block.inverse = float(i.inverse * j.inverse * k.inverse);
    return block;
}

} // namespace

CoarseFields coarseFields(const plan::RenderPlan &plan,
                          std::span<const plan::FieldSummary> summaries) {
    CoarseFields coarse;
    coarse.lattice = summaries.front().lattice;
    coarse.rounding = plan.spectrum.storage == fourier::Storage::binary16 ? 2.1e-4 : 3e-7;
    AxisBlocks axes;
    for (std::size_t d = 0; d < 3; ++d) {
        const Axis axis(plan.spectrum, int(d), summaries);
        axes[d] = axis.blocks();
        coarse.periodsMm[d] = double(axis.padded()) * coarse.lattice.step(int(d));
        coarse.kernelEnergy *= axis.kernelEnergy();
        coarse.moments[d] = axis.momentError();
        coarse.roundingShares[d] = axis.roundingShares();
        coarse.blockMm = std::max(coarse.blockMm, double(axis.samples()) / double(axes[d].size()) *
                                                      coarse.lattice.spacingMm(int(d)));
    }
    std::map<std::array<std::uint8_t, 3>, std::uint32_t> known;
    for (const plan::FieldSummary &field : summaries) {
        std::vector<CoarseFields::Part> &parts = coarse.fields.emplace_back();
        for (const plan::FieldBlock &block : field.energy.blocks) {
            const auto [it, isNew] =
                known.try_emplace(block.at, std::uint32_t(coarse.blocks.size()));
            if (isNew)
                coarse.blocks.push_back(blockAt(block.at, axes, coarse.lattice));
            parts.push_back({it->second, float(block.mass * field.energy.massMm3),
                             float(block.energy * field.energy.energyMm3)});
        }
        coarse.spreads.push_back(field.energy.spread);
        coarse.depthRadiusMm = field.depthRadiusMm.value_or(coarse.lattice.radiusMm());
    }
    return coarse;
}

} // namespace pellucid::accuracy
