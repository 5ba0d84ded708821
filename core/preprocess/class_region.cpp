// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/class_region.h"

#include <utility>

#include "core/preprocess/belonging.h"
#include "core/preprocess/coverage_where.inc"
#include "core/preprocess/reasons.h"
#include "core/task/error.h"

namespace pellucid::preprocess {

namespace {

using classify::Region;
using volume::Coverage;

} // namespace

Coverage regionOf(const volume::Volume &volume, classify::TissueClass tissue,
                  classify::StepRunner &runner, const task::Progress &progress) {
    tissue.edge = 0.0;
    const classify::ClassSamples samples = samplesOf(volume, tissue, &runner, progress);
    const Belonging belongs(tissue);
    return task::orOutOfMemory(task::because::noMemoryForTheSteps(tissue.name), [&] {
        return samples.values.visit([&](auto values) {
            return coverageWhere(
                volume.lattice().size(), [&](volume::VoxelIndex at, std::size_t n) -> std::uint8_t {
                    const Region where = samples.regions ? (*samples.regions)[n] : Region::inside;
                    if (where == Region::filled)
                        return Coverage::whole;
                    if (where == Region::outside || !belongs(values[n]))
                        return 0;
                    return samples.coverage ? samples.coverage->at(at)
                                            : std::uint8_t(Coverage::whole);
                });
        });
    });
}

} // namespace pellucid::preprocess
