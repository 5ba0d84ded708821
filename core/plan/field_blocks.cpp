// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/field_blocks.h"
#include "core/volume/lane_sum.h"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace pellucid::plan {

std::vector<BlockRange> blockRanges(int samples) {
    constexpr int most = 20;
    const int count = std::min(samples, most);
    std::vector<BlockRange> ranges;
    for (int n = 0; n < count; ++n)
        ranges.push_back({int(std::int64_t(n) * samples / count),
                          int(std::int64_t(n + 1) * samples / count) - 1});
    return ranges;
}

std::vector<FieldBlock> fieldBlocks(const volume::Field &field, const volume::VoxelBox &box) {
    const volume::GridSize size = box.size();
    const std::array<std::vector<BlockRange>, 3> ranges{blockRanges(size.i), blockRanges(size.j),
                                                        blockRanges(size.k)};
    const std::size_t across = ranges[0].size(), down = ranges[1].size(), deep = ranges[2].size();
    std::vector<double> energy(across * down * deep), mass(energy.size());
    tbb::parallel_for(std::size_t(0), deep, [&](std::size_t c) {
        std::vector<float> buffer(std::size_t(size.i));
        for (int k = ranges[2][c].first; k <= ranges[2][c].last; ++k)
            for (std::size_t b = 0; b < down; ++b)
                for (int j = ranges[1][b].first; j <= ranges[1][b].last; ++j) {
                    const float *const row =
                        field.row({box.lo.i, j + box.lo.j, k + box.lo.k}, size.i, buffer.data());
                    for (std::size_t a = 0; a < across; ++a) {
                        const float *const part = row + ranges[0][a].first;
                        const int count = ranges[0][a].last - ranges[0][a].first + 1;
                        energy[(c * down + b) * across + a] += double(
                            volume::laneSum(count, [&](int i) { return part[i] * part[i]; }));
                        mass[(c * down + b) * across + a] +=
                            double(volume::laneSum(count, [&](int i) { return part[i]; }));
                    }
                }
    });
    double allEnergy = 0.0, allMass = 0.0;
    for (std::size_t n = 0; n < energy.size(); ++n) {
        allEnergy += energy[n];
        allMass += mass[n];
    }
    std::vector<FieldBlock> blocks;
    for (std::size_t n = 0; n < energy.size(); ++n)
        if (energy[n] > 0.0)
            blocks.push_back({{std::uint8_t(n % across), std::uint8_t(n / across % down),
                               std::uint8_t(n / across / down)},
                              float(energy[n] / allEnergy),
                              allMass != 0.0 ? float(mass[n] / allMass) : 0.0F});
    return blocks;
}

} // namespace pellucid::plan
