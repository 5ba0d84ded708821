// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "core/plan/sheared_grid.h"
#include "core/task/progress.h"
#include "core/volume/field.h"

namespace pellucid::render {

/// The spectrum of a field across one view, from its samples summed along the view: what other
/// engines read from the slice of a volume's spectrum. It costs a pass over the samples instead of
/// a transform of the volume.
class ViewSpectrum {
public:
    /// *Throws* std::bad_alloc, Error{outOfMemory}, Cancelled.
    ViewSpectrum(const volume::Field &field, const volume::VoxelBox &box,
                 const plan::ShearedGrid &grid, const task::Progress &progress = {});

    /// Frequencies in a row, one step apart. *Units*: cycles per sample along each axis of the
    /// lattice.
    struct Row {
        glm::dvec3 first{0.0}, step{0.0};
        int count = 0;
    };
    /// D(s) of a row, about the middle of the lattice. *Requires*: within the grid's band.
    /// *Shape*: `values` has room for `row.count`.
    void read(const Row &row, std::complex<float> *values) const;

private:
    std::vector<std::complex<float>> transformed(const float *sums, int segment, int columns) const;
    void arrange(const std::vector<std::complex<float>> &spectrum, int columns);

    plan::ShearedGrid m_grid;
    std::array<int, 2> m_reach{};             ///< the farthest cells that are read
    std::size_t m_stride = 0;                 ///< cells from one row to the next
    std::vector<std::complex<float>> m_cells; ///< of the spectrum, and the kernel's margins
};

} // namespace pellucid::render
