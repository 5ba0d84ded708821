// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/field/summary.h"

namespace pellucid::field {

Summary summarise(const classify::DensityField &field) {
    return summarise({&field, 1}).front();
}

volume::VoxelBox boxOf(std::span<const classify::DensityField> fields) {
    volume::VoxelBox box = fields.front().support;
    for (const classify::DensityField &field : fields)
        box = volume::united(box, field.support);
    return box;
}

std::vector<Summary> summarise(std::span<const classify::DensityField> fields) {
    const volume::VoxelBox box = boxOf(fields);
    std::vector<Summary> summaries;
    for (const classify::DensityField &field : fields)
        summaries.push_back(
            {field.values.lattice(), box, energyMarginals(field.values, box), {}, {}});
    return summaries;
}

} // namespace pellucid::field
