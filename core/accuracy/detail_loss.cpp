// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/detail_loss.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <tbb/parallel_for.h>

namespace pellucid::accuracy {

namespace {

// Views between the axes lose up to this much more, as an amplitude, at edges that are not parallel
// to any axis.
constexpr double viewMargin = 1.25;

// For each fine sample of an axis, the four coarse samples around it and their weights.
struct Taps {
    int first = 0;
    std::array<double, 4> weights{};
};

// `beyond`: the number of extra samples on both sides.
std::vector<Taps> tapsAlong(int axis, const volume::Lattice &fine, const volume::Lattice &coarse,
                            int beyond) {
    const fourier::Kernel keys = fourier::Kernel::catmullRom();
    std::vector<Taps> taps(std::size_t(fine.size()[axis] + 2 * beyond));
    glm::dvec3 index(0.0);
    for (std::size_t n = 0; n < taps.size(); ++n) {
        index[axis] = double(n) - beyond;
        const double at = coarse.voxel(fine.patient(volume::VoxelPoint{index})).v[axis];
        taps[n].first = int(std::floor(at)) - 1;
        for (int tap = 0; tap < 4; ++tap)
            taps[n].weights[std::size_t(tap)] = keys.value(taps[n].first + tap - at);
    }
    return taps;
}

// By axis, the number of fine samples from the ends of the fine lattice to the ends of Keys'
// footprint, which reaches two coarse samples beyond the outermost one.
std::array<int, 3> reachBeyond(const volume::Lattice &fine, const volume::Lattice &coarse) {
    std::array<int, 3> samples{};
    for (int d = 0; d < 3; ++d) {
        glm::dvec3 first(0.0), last(0.0);
        first[d] = -2.0;
        last[d] = coarse.size()[d] + 1.0;
        const auto at = [&](const glm::dvec3 &index) {
            return fine.voxel(coarse.patient(volume::VoxelPoint{index})).v[d];
        };
        samples[std::size_t(d)] =
            int(std::ceil(std::max({0.0, -at(first), at(last) - (fine.size()[d] - 1)})));
    }
    return samples;
}

double product(const std::vector<double> &a, const std::vector<double> &b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

// The inner product of the gradients of two planes. *Units*: per mm^2.
template <class Plane>
double slopeProduct(const Plane &a, const Plane &b, const volume::Lattice &lattice) {
    const double acrossMm = lattice.spacingMm(a.across), downMm = lattice.spacingMm(a.down);
    double across = 0.0, down = 0.0;
    for (int row = 1; row < a.rows; ++row)
        for (int column = 1; column < a.columns; ++column) {
            across += (a.at(column, row) - a.at(column - 1, row)) *
                      (b.at(column, row) - b.at(column - 1, row));
            down += (a.at(column, row) - a.at(column, row - 1)) *
                    (b.at(column, row) - b.at(column, row - 1));
        }
    return across / (acrossMm * acrossMm) + down / (downMm * downMm);
}

// The largest factor that a cue applies to any depth, and the root mean square over all depths.
struct CueRange {
    double most = 1.0, rms = 1.0;
};
CueRange rangeOf(const shading::DepthCue &cue) {
    if (!cue.isActive())
        return {};
    const auto value = shading::cueFunction(cue);
    constexpr int steps = 64;
    double most = 0.0, squares = 0.0;
    for (int n = -steps; n <= steps; ++n) {
        const double factor = std::abs(value(double(n) / steps));
        most = std::max(most, factor);
        squares += factor * factor / (2 * steps + 1);
    }
    return {most, std::sqrt(squares)};
}

// w' M w.
double form(const std::vector<double> &weights, const std::vector<double> &matrix) {
    double sum = 0.0;
    for (std::size_t a = 0; a < weights.size(); ++a)
        for (std::size_t b = 0; b < weights.size(); ++b)
            sum += weights[a] * weights[b] * matrix[a * weights.size() + b];
    return sum;
}

} // namespace

AxisProjections::Plane AxisProjections::emptyPlane(int axis, const volume::Lattice &lattice,
                                                   const std::array<int, 3> &beyond) {
    const int across = axis == 0 ? 1 : 0, down = axis == 2 ? 1 : 2;
    const int columns = lattice.size()[across] + 2 * beyond[std::size_t(across)],
              rows = lattice.size()[down] + 2 * beyond[std::size_t(down)];
    return {across, down, columns, rows, std::vector<double>(std::size_t(columns) * rows)};
}

AxisProjections::Plane AxisProjections::planeAlong(int axis, const classify::DensityField &field) {
    const volume::Lattice &lattice = field.values.lattice();
    const double stepMm = lattice.spacingMm(axis);
    const volume::VoxelBox &box = field.support;
    Plane plane = emptyPlane(axis, lattice);
    const int columns = box.size().i;
    const auto addRow = [&](int j, int k, float *buffer, const auto &add) {
        const float *const row = field.values.row({box.lo.i, j, k}, columns, buffer);
        for (int i = 0; i < columns; ++i)
            add(box.lo.i + i, stepMm * double(row[i]));
    };
    if (axis == 2)
        tbb::parallel_for(box.lo.j, box.hi.j, [&](int j) {
            std::vector<float> buffer(columns);
            for (int k = box.lo.k; k < box.hi.k; ++k)
                addRow(j, k, buffer.data(), [&](int i, double value) { plane.at(i, j) += value; });
        });
    else
        tbb::parallel_for(box.lo.k, box.hi.k, [&](int k) {
            std::vector<float> buffer(columns);
            for (int j = box.lo.j; j < box.hi.j; ++j)
                addRow(j, k, buffer.data(),
                       [&](int i, double value) { plane.at(axis == 0 ? j : i, k) += value; });
        });
    return plane;
}

void AxisProjections::add(const classify::DensityField &field, const task::Progress &progress) {
    m_lattice = field.values.lattice();
    std::array<Plane, 3> &planes = m_planes.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
        progress.check();
        planes[std::size_t(axis)] = planeAlong(axis, field);
    }
}

// The difference between the coarse projection, interpolated by Keys' cubic convolution, and the
// fine one. Both are zero beyond their samples.
AxisProjections::Plane DetailLoss::lossOf(const Plane &fine, const Plane &coarse, int axis,
                                          const volume::Lattice &fineLattice,
                                          const volume::Lattice &coarseLattice) {
    const std::array<int, 3> beyond = reachBeyond(fineLattice, coarseLattice);
    Plane loss = AxisProjections::emptyPlane(axis, fineLattice, beyond);
    const int left = beyond[std::size_t(loss.across)], above = beyond[std::size_t(loss.down)];
    const auto across = tapsAlong(loss.across, fineLattice, coarseLattice, left),
               down = tapsAlong(loss.down, fineLattice, coarseLattice, above);
    tbb::parallel_for(0, loss.rows, [&](int row) {
        // First a row of coarse columns, then the fine ones.
        std::vector<double> between(std::size_t(coarse.columns), 0.0);
        const Taps &rows = down[std::size_t(row)];
        for (int tap = 0; tap < 4; ++tap)
            if (const int from = rows.first + tap; from >= 0 && from < coarse.rows)
                for (int column = 0; column < coarse.columns; ++column)
                    between[std::size_t(column)] +=
                        rows.weights[std::size_t(tap)] * coarse.at(column, from);
        for (int column = 0; column < loss.columns; ++column) {
            const Taps &columns = across[std::size_t(column)];
            for (int tap = 0; tap < 4; ++tap)
                if (const int from = columns.first + tap; from >= 0 && from < coarse.columns)
                    loss.at(column, row) +=
                        columns.weights[std::size_t(tap)] * between[std::size_t(from)];
        }
        if (row >= above && row - above < fine.rows)
            for (int column = 0; column < fine.columns; ++column)
                loss.at(column + left, row) -= fine.at(column, row - above);
    });
    return loss;
}

DetailLoss::DetailLoss(const AxisProjections &fine, const AxisProjections &coarse,
                       std::size_t fields, double stepMm)
    : m_fields(fields), m_count(fine.count()), m_stepMm(stepMm) {
    for (std::size_t axis = 0; axis < m_along.size(); ++axis) {
        std::vector<Plane> losses;
        for (std::size_t n = 0; n < m_count; ++n)
            losses.push_back(lossOf(fine.m_planes[n][axis], coarse.m_planes[n][axis], int(axis),
                                    fine.m_lattice, coarse.m_lattice));
        Products &products = m_along[axis];
        const double sampleMm2 =
            fine.m_lattice.cellVolumeMm3() / fine.m_lattice.spacingMm(int(axis));
        for (std::size_t a = 0; a < m_count; ++a)
            for (std::size_t b = 0; b < m_count; ++b) {
                products.projections.push_back(sampleMm2 * product(fine.m_planes[a][axis].values,
                                                                   fine.m_planes[b][axis].values));
                products.losses.push_back(sampleMm2 * product(losses[a].values, losses[b].values));
                products.slopes.push_back(sampleMm2 *
                                          slopeProduct(losses[a], losses[b], fine.m_lattice));
            }
    }
}

DetailLoss::Energies
DetailLoss::energiesAlong(const Products &products,
                          std::span<const render::ChannelWeights> channelWeights,
                          const shading::Shading &shading, int channels) const {
    const shading::SliceShading slices =
        shading::sliceShading(shading, glm::dmat3(1.0), {1.0, m_stepMm});
    const bool isLit = shading.isLit() && m_count > m_fields;
    Energies sum;
    for (std::size_t channel = 0; channel < std::size_t(channels); ++channel) {
        const shading::SliceShading::Channel &light = slices.channels[channel];
        std::vector<double> weights(m_count, 0.0), directed(m_count, 0.0);
        for (std::size_t f = 0; f < m_fields; ++f) {
            const double share = channelWeights[f][channel];
            weights[f] = share * (isLit ? light.ambient : 1.0);
            if (!isLit)
                continue;
            weights[m_fields + f] = share * light.magnitude;
            // The component along the line of sight projects to zero.
            directed[f] = share * m_stepMm * glm::length(light.gradient);
        }
        sum.image += form(weights, products.projections);
        sum.error += form(weights, products.losses) + form(directed, products.slopes);
    }
    return sum;
}

double DetailLoss::relativeError(std::span<const render::ChannelWeights> channelWeights,
                                 const shading::Shading &shading) const {
    double worst = 0.0;
    for (const Products &products : m_along) {
        const Energies energies = energiesAlong(products, channelWeights, shading, 3);
        if (energies.image > 0.0)
            worst = std::max(worst, std::sqrt(energies.error / energies.image));
    }
    const CueRange cue = rangeOf(shading.cue);
    return cue.rms > 0.0 ? viewMargin * cue.most / cue.rms * worst : 0.0;
}

double DetailLoss::relativeError(const picture::ProjectionImage &picture,
                                 std::span<const render::ChannelWeights> channelWeights,
                                 const shading::Shading &shading) const {
    double image = 0.0, error = 0.0;
    for (const float sample : picture.samples)
        image += double(sample) * double(sample);
    image *= picture.pixelMm * picture.pixelMm;
    for (const Products &products : m_along)
        error = std::max(error,
                         energiesAlong(products, channelWeights, shading, picture.channels).error);
    return image > 0.0 ? viewMargin * rangeOf(shading.cue).most * std::sqrt(error / image) : 0.0;
}

} // namespace pellucid::accuracy
