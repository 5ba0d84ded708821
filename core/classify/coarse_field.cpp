// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/coarse_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

namespace pellucid::classify {

namespace {

// The assumption beyond the last sample of an outer block: zero, as in a field; or the mean of the
// samples within it.
enum class Beyond { zero, mean };

// The samples of a block along each axis, so that there are at most `side` blocks.
std::array<int, 3> blocksOf(const volume::GridSize &size, int side) {
    return {(size.i + side - 1) / side, (size.j + side - 1) / side, (size.k + side - 1) / side};
}

volume::Volume blockMeans(const volume::Field &field, const std::array<int, 3> &block,
                          Beyond beyond, volume::ValueUnit unit) {
    const volume::Lattice &fine = field.lattice();
    std::array<int, 3> count{};
    for (int d = 0; d < 3; ++d)
        count[d] = (fine.size()[d] + block[d] - 1) / block[d];
    // Blocks are symmetric about the centre of the lattice, so that both fields rotate about the
    // same point. The outer blocks may extend beyond the last sample, where the field is zero.
    glm::dvec3 firstBlock;
    std::array<glm::dvec3, 3> steps;
    for (int d = 0; d < 3; ++d) {
        firstBlock[d] = 0.5 * (fine.size()[d] - 1) - 0.5 * (count[d] - 1) * block[d];
        steps[d] = double(block[d]) * fine.step(d);
    }
    const auto lattice = volume::Lattice::make({count[0], count[1], count[2]},
                                               fine.patient(volume::VoxelPoint{firstBlock}), steps);
    // The first sample of the first block; its rounding loses at most half a sample.
    std::array<int, 3> start{};
    for (int d = 0; d < 3; ++d)
        start[d] = int(std::ceil(firstBlock[d] - 0.5 * block[d]));
    // The number of samples in a block along an axis, counted as in the loops below.
    const auto held = [&](int d, int n) {
        const int first = start[d] + n * block[d];
        const int last = n + 1 == count[d] ? fine.size()[d] : first + block[d];
        return std::max(0, std::min(last, fine.size()[d]) - (n == 0 ? 0 : std::max(first, 0)));
    };
    std::vector<float> means(lattice.size().count(), 0.0F);
    tbb::parallel_for(0, count[2], [&](int ck) {
        const std::size_t plane = static_cast<std::size_t>(count[0]) * count[1];
        std::vector<double> sums(plane, 0.0);
        std::vector<float> buffer(std::size_t(fine.size().i));
        for (int k = std::max(0, start[2] + ck * block[2]);
             k < std::min(fine.size().k, start[2] + (ck + 1) * block[2]); ++k)
            for (int j = 0; j < fine.size().j; ++j) {
                const float *const row = field.row({0, j, k}, fine.size().i, buffer.data());
                double *out =
                    sums.data() +
                    std::size_t(std::clamp((j - start[1]) / block[1], 0, count[1] - 1)) * count[0];
                for (int i = 0; i < fine.size().i; ++i)
                    out[std::clamp((i - start[0]) / block[0], 0, count[0] - 1)] += double(row[i]);
            }
        for (std::size_t n = 0; n < sums.size(); ++n) {
            double share = double(block[0]) * block[1] * block[2];
            if (beyond == Beyond::mean) {
                const std::array<int, 3> at{int(n % std::size_t(count[0])),
                                            int(n / std::size_t(count[0])), ck};
                share = 1.0;
                for (int d = 0; d < 3; ++d)
                    share *= held(d, at[d]);
            }
            means[std::size_t(ck) * sums.size() + n] = share > 0.0 ? float(sums[n] / share) : 0.0F;
        }
    });
    return {lattice, std::move(means), unit, field.samples().notes()};
}

} // namespace

volume::GridSize coarseSize(const volume::GridSize &size, int side) {
    const std::array<int, 3> block = blocksOf(size, side);
    return {(size.i + block[0] - 1) / block[0], (size.j + block[1] - 1) / block[1],
            (size.k + block[2] - 1) / block[2]};
}

int coarseSide(const volume::GridSize &size, int reduction) {
    constexpr int minSamples = 32;
    const int longest = std::max({size.i, size.j, size.k});
    return longest / reduction >= minSamples ? (longest + reduction - 1) / reduction : 0;
}

DensityField coarseField(const DensityField &field, int side) {
    return fieldOf(blockMeans(field.values, blocksOf(field.values.lattice().size(), side),
                              Beyond::zero, volume::ValueUnit::none));
}

volume::Volume coarseVolume(const volume::Volume &volume, int side) {
    return blockMeans(volume, blocksOf(volume.lattice().size(), side), Beyond::mean, volume.unit());
}

std::array<int, 3> blocksWithin(const volume::Lattice &lattice, double largestMm) {
    std::array<int, 3> block{};
    for (int d = 0; d < 3; ++d)
        block[std::size_t(d)] = std::max(1, int(largestMm / lattice.spacingMm(d)));
    return block;
}

volume::Volume coarseVolume(const volume::Volume &volume, const std::array<int, 3> &block) {
    return blockMeans(volume, block, Beyond::mean, volume.unit());
}

} // namespace pellucid::classify
