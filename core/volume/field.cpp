// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/volume/field.h"

#include <cassert>

#include <tbb/parallel_for.h>

#include "core/task/error.h"
#include "core/volume/ramp_row.h"
#include "core/volume/reasons.h"

namespace pellucid::volume {

Field::Field(Volume samples) : m_samples(std::move(samples)), m_box(m_samples.lattice().bounds()) {}

Field::Field(Volume samples, const Ramp &ramp) : Field(std::move(samples)) {
    m_ramp = ramp;
}

Field Field::within(const VoxelBox &box) const {
    Field part = *this;
    part.m_box = {{std::max(m_box.lo.i, box.lo.i), std::max(m_box.lo.j, box.lo.j),
                   std::max(m_box.lo.k, box.lo.k)},
                  {std::min(m_box.hi.i, box.hi.i), std::min(m_box.hi.j, box.hi.j),
                   std::min(m_box.hi.k, box.hi.k)}};
    return part;
}

const float *Field::row(VoxelIndex first, int count, float *buffer) const {
    assert(lattice().contains(first) && first.i + count <= lattice().size().i);
    const bool isInside = first.i >= m_box.lo.i && first.i + count <= m_box.hi.i &&
                          first.j >= m_box.lo.j && first.j < m_box.hi.j && first.k >= m_box.lo.k &&
                          first.k < m_box.hi.k;
    if (const float *const floats = m_samples.floats(); isInside && !m_ramp && floats != nullptr)
        return floats + lattice().size().offsetOf(first.i, first.j, first.k);
    if (isInside) {
        computeRow(first, count, buffer);
        return buffer;
    }
    std::fill_n(buffer, count, 0.0F);
    const int lo = std::max(first.i, m_box.lo.i), hi = std::min(first.i + count, m_box.hi.i);
    if (lo < hi && first.j >= m_box.lo.j && first.j < m_box.hi.j && first.k >= m_box.lo.k &&
        first.k < m_box.hi.k)
        computeRow({lo, first.j, first.k}, hi - lo, buffer + (lo - first.i));
    return buffer;
}

// Computes values inside the box.
void Field::computeRow(VoxelIndex first, int count, float *to) const {
    m_samples.visit([&](auto samples) {
        const auto *const from =
            samples.data() + lattice().size().offsetOf(first.i, first.j, first.k);
        if (!m_ramp) {
            std::copy_n(from, count, to);
            return;
        }
        rampRow(*m_ramp, from, count, to);
    });
}

void Field::copyRow(VoxelIndex first, int count, float *to) const {
    const float *const from = row(first, count, to);
    if (from != to)
        std::copy_n(from, count, to);
}

double Field::value(VoxelIndex n) const {
    float buffer = 0.0F;
    return double(*row(n, 1, &buffer));
}

Volume Field::asVolume() const {
    const GridSize size = lattice().size();
    return task::orOutOfMemory(task::because::noMemoryForAField(size.i, size.j, size.k), [&] {
        std::vector<float> values(size.count());
        tbb::parallel_for(0, size.k, [&](int k) {
            for (int j = 0; j < size.j; ++j)
                copyRow({0, j, k}, size.i, values.data() + size.offsetOf(0, j, k));
        });
        return Volume(lattice(), std::move(values), ValueUnit::none, m_samples.notes());
    });
}

} // namespace pellucid::volume
