// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/field_blocks.h"

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

std::vector<FieldBlock> fieldBlocks(const volume::Volume &field, const volume::VoxelBox &box) {
    const volume::GridSize lattice = field.lattice().size(), size = box.size();
    const std::array<std::vector<BlockRange>, 3> ranges{blockRanges(size.i), blockRanges(size.j),
                                                        blockRanges(size.k)};
    const std::size_t across = ranges[0].size(), down = ranges[1].size(), deep = ranges[2].size();
    std::vector<double> energy(across * down * deep), mass(energy.size());
    field.visit([&](auto samples) {
        tbb::parallel_for(std::size_t(0), deep, [&](std::size_t c) {
            for (int k = ranges[2][c].first; k <= ranges[2][c].last; ++k)
                for (std::size_t b = 0; b < down; ++b)
                    for (int j = ranges[1][b].first; j <= ranges[1][b].last; ++j) {
                        const auto *const row =
                            samples.data() +
                            lattice.offsetOf(box.lo.i, j + box.lo.j, k + box.lo.k);
                        for (std::size_t a = 0; a < across; ++a) {
                            double squares = 0.0, sum = 0.0;
                            for (int i = ranges[0][a].first; i <= ranges[0][a].last; ++i) {
                                squares += double(row[i]) * double(row[i]);
                                sum += double(row[i]);
                            }
                            energy[(c * down + b) * across + a] += squares;
                            mass[(c * down + b) * across + a] += sum;
                        }
                    }
        });
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
