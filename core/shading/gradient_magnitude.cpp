// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/shading/gradient_magnitude.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <tbb/parallel_for.h>

#include "core/shading/reasons.h"
#include "core/task/error.h"

namespace pellucid::shading {

namespace {

using volume::GridSize;
using volume::VoxelBox;
using volume::VoxelIndex;

// Multiplied by the central differences f[n+1] - f[n-1] of the three axes: the columns are stepMm
// b_d / 2.
glm::dmat3 differenceFactors(const volume::Lattice &lattice, double stepMm) {
    const glm::dmat3 steps(lattice.step(0), lattice.step(1), lattice.step(2));
    return 0.5 * stepMm * glm::transpose(glm::inverse(steps));
}

volume::Volume floatsOn(const volume::Lattice &lattice, std::vector<float> samples,
                        const volume::Field &like) {
    return {lattice, std::move(samples), volume::ValueUnit::none, like.samples().notes()};
}

} // namespace

glm::dvec3 gradientAt(const volume::Field &field, const VoxelIndex &n, double stepMm) {
    const auto at = [&](int i, int j, int k) {
        const VoxelIndex where{n.i + i, n.j + j, n.k + k};
        return field.lattice().contains(where) ? field.value(where) : 0.0;
    };
    return differenceFactors(field.lattice(), stepMm) * glm::dvec3(at(1, 0, 0) - at(-1, 0, 0),
                                                                   at(0, 1, 0) - at(0, -1, 0),
                                                                   at(0, 0, 1) - at(0, 0, -1));
}

bool holdsGradient(const classify::DensityField &field) {
    const GridSize size = field.values.lattice().size();
    const VoxelBox &box = field.support;
    return box.lo.i > 0 && box.lo.j > 0 && box.lo.k > 0 && box.hi.i < size.i && box.hi.j < size.j &&
           box.hi.k < size.k;
}

classify::DensityField grown(const classify::DensityField &field) {
    const volume::Lattice &lattice = field.values.lattice();
    const GridSize size = lattice.size(), larger{size.i + 2, size.j + 2, size.k + 2};
    return task::orOutOfMemory(task::because::noMemoryForTheLitField, [&] {
        std::vector<float> samples(larger.count(), 0.0F);
        tbb::parallel_for(0, size.k, [&](int k) {
            for (int j = 0; j < size.j; ++j)
                field.values.copyRow({0, j, k}, size.i,
                                     samples.data() + larger.offsetOf(1, j + 1, k + 1));
        });
        const auto around =
            volume::Lattice::make(larger, lattice.patient(VoxelIndex{-1, -1, -1}),
                                  {lattice.step(0), lattice.step(1), lattice.step(2)});
        const VoxelBox &box = field.support;
        return classify::DensityField{floatsOn(around, std::move(samples), field.values),
                                      {{box.lo.i + 1, box.lo.j + 1, box.lo.k + 1},
                                       {box.hi.i + 1, box.hi.j + 1, box.hi.k + 1}}};
    });
}

classify::DensityField gradientMagnitude(const classify::DensityField &field, double stepMm,
                                         const task::Progress &progress) {
    assert(holdsGradient(field));
    const volume::Lattice &lattice = field.values.lattice();
    const GridSize size = lattice.size();
    const VoxelBox &inner = field.support;
    const VoxelBox box{{inner.lo.i - 1, inner.lo.j - 1, inner.lo.k - 1},
                       {inner.hi.i + 1, inner.hi.j + 1, inner.hi.k + 1}};
    const glm::mat3 factors(differenceFactors(lattice, stepMm));
    return task::orOutOfMemory(task::because::noMemoryForTheGradient, [&] {
        std::vector<float> lengths(size.count(), 0.0F);
        tbb::parallel_for(box.lo.k, box.hi.k, [&](int k) {
            progress.check();
            std::array<std::vector<float>, 5> buffers;
            buffers.fill(std::vector<float>(std::size_t(size.i)));
            // The field is zero beyond the lattice's faces and also on them, so a face replaces its
            // missing neighbour.
            const auto rowAt = [&](int j, int depth, std::size_t buffer) {
                return field.values.row(
                    {0, std::clamp(j, 0, size.j - 1), std::clamp(depth, 0, size.k - 1)}, size.i,
                    buffers[buffer].data());
            };
            for (int j = box.lo.j; j < box.hi.j; ++j) {
                const float *const f = rowAt(j, k, 0), *const above = rowAt(j - 1, k, 1),
                                   *const below = rowAt(j + 1, k, 2),
                                   *const behind = rowAt(j, k - 1, 3),
                                   *const before = rowAt(j, k + 1, 4);
                const auto length = [&](int i, int left, int right) {
                    const glm::vec3 d(f[right] - f[left], below[i] - above[i],
                                      before[i] - behind[i]);
                    const glm::vec3 g = factors * d;
                    return std::sqrt(g.x * g.x + g.y * g.y + g.z * g.z);
                };
                float *const to = lengths.data() + size.offsetOf(0, j, k);
                const int first = std::max(1, box.lo.i), last = std::min(size.i - 1, box.hi.i);
                for (int i = first; i < last; ++i)
                    to[i] = length(i, i - 1, i + 1);
                if (box.lo.i == 0)
                    to[0] = length(0, 0, std::min(1, size.i - 1));
                if (box.hi.i == size.i)
                    to[size.i - 1] = length(size.i - 1, std::max(0, size.i - 2), size.i - 1);
            }
        });
        return classify::DensityField{floatsOn(lattice, std::move(lengths), field.values), box};
    });
}

} // namespace pellucid::shading
