// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/fourier/kernels/kernel.h"
#include "core/plan/sheared_grid.h"
#include "core/task/progress.h"
#include "core/volume/field.h"

namespace pellucid::render {

/// Where the samples of one plane land along an axis, and with which weights. Cell m i + r gets
/// those of the samples i - shift - first - t, t = 0..count-1, of its part r.
struct SpreadWeights {
    struct Part {
        int first = 0, count = 0;
        std::array<float, fourier::Kernel::largestWidth> weights{};
    };
    int shift = 0;
    std::vector<Part> parts; ///< by r

    /// `middle`: of the samples along the axis; `plane`: from the middle one.
    SpreadWeights(const plan::ShearedAxis &axis, double middle, double plane);
    /// The first and the last i that some of the samples `lo` to `hi` - 1 reach.
    int firstOf(int lo) const;
    int lastOf(int hi) const;
};

/// The sums of a field's planes along a view.
class PlaneSum {
public:
    /// *Shape*: the box contains all nonzero samples.
    PlaneSum(const volume::Field &field, const volume::VoxelBox &box,
             const plan::ShearedGrid &grid);

    /// Cells of a row that lie on one part of a sample. A row has those of the first part, then
    /// those of the second, and so on.
    int segment() const { return m_segment; }
    int rowFloats() const { return m_grid.axes[0].cellsPerSample * m_segment; }
    /// Sums all planes, on all threads; the bits do not depend on their number. *Shape*: rows of
    /// `rowFloats()`, as many as the grid has cells across them. *Throws* Cancelled.
    void run(float *to, const task::Progress &progress) const;

private:
    class Block;

    const volume::Field &m_field;
    const volume::VoxelBox m_box;
    const plan::ShearedGrid &m_grid;
    int m_segment;
    std::array<std::vector<SpreadWeights>, 2> m_weights; ///< along and across rows, by plane
};

} // namespace pellucid::render
