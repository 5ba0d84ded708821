// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/field/slab_products.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include <tbb/parallel_for.h>

namespace pellucid::field {

namespace {

// Weights change slowly with depth.
constexpr int maxSlabs = 32;

// The sum of the samples of each slab across an axis, [slab][second other axis][first other axis].
std::vector<std::vector<float>> slabsAcross(const volume::Field &field, const volume::VoxelBox &box,
                                            int axis, int slabs) {
    const volume::GridSize size = box.size();
    const int samples = size[axis], first = axis == 0 ? size.j : size.i,
              second = axis == 2 ? size.j : size.k;
    std::vector<std::vector<float>> sums(std::size_t(slabs),
                                         std::vector<float>(std::size_t(first) * second, 0.0F));
    const auto firstOf = [&](int slab) { return int(std::int64_t(slab) * samples / slabs); };
    // Each task writes its own row of the sums.
    tbb::parallel_for(0, second, [&](int row) {
        std::vector<float> buffer(std::size_t(size.i));
        const auto rowAt = [&](int j, int k) {
            return field.row({box.lo.i, j + box.lo.j, k + box.lo.k}, size.i, buffer.data());
        };
        const auto sumsOf = [&](int slab) {
            return sums[std::size_t(slab)].data() + std::size_t(row) * std::size_t(first);
        };
        if (axis == 0) {
            for (int j = 0; j < first; ++j) {
                const float *const from = rowAt(j, row);
                for (int slab = 0; slab < slabs; ++slab)
                    sumsOf(slab)[j] =
                        std::accumulate(from + firstOf(slab), from + firstOf(slab + 1), 0.0F);
            }
            return;
        }
        for (int slab = 0; slab < slabs; ++slab)
            for (int n = firstOf(slab); n < firstOf(slab + 1); ++n) {
                const float *const from = axis == 1 ? rowAt(n, row) : rowAt(row, n);
                for (int i = 0; i < first; ++i)
                    sumsOf(slab)[i] += from[i];
            }
    });
    return sums;
}

} // namespace

double SlabProducts::energy(std::span<const double> weights) const {
    double sum = 0.0;
    for (std::size_t a = 0; a < weights.size(); ++a)
        for (std::size_t b = 0; b < weights.size(); ++b)
            sum += weights[a] * weights[b] * products[a * weights.size() + b];
    return std::max(0.0, sum);
}

SlabProducts evenSlabProducts(std::span<const double> energy) {
    SlabProducts matrix{int(energy.size()), std::min(maxSlabs, int(energy.size())), {}};
    const auto count = std::size_t(matrix.slabs);
    matrix.products.resize(count * count);
    for (std::size_t n = 0; n < energy.size(); ++n) {
        const std::size_t slab = (n * count + count - 1) / energy.size();
        matrix.products[slab * count + slab] += energy[n];
    }
    return matrix;
}

std::array<SlabProducts, 3> slabProducts(const volume::Field &field, const volume::VoxelBox &box) {
    std::array<SlabProducts, 3> result;
    for (int axis = 0; axis < 3; ++axis) {
        SlabProducts &matrix = result[std::size_t(axis)];
        matrix.samples = box.size()[axis];
        matrix.slabs = std::min(maxSlabs, matrix.samples);
        const auto sums = slabsAcross(field, box, axis, matrix.slabs);
        const auto count = std::size_t(matrix.slabs);
        matrix.products.resize(count * count);
        tbb::parallel_for(std::size_t(0), count, [&](std::size_t a) {
            for (std::size_t b = a; b < count; ++b) {
                double sum = 0.0;
                for (std::size_t n = 0; n < sums[a].size(); ++n)
                    sum += double(sums[a][n]) * double(sums[b][n]);
                matrix.products[a * count + b] = matrix.products[b * count + a] = sum;
            }
        });
        double all = 0.0;
        for (const double product : matrix.products)
            all += product;
        if (all > 0.0)
            for (double &product : matrix.products)
                product /= all;
    }
    return result;
}

} // namespace pellucid::field
