// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/reference/slice_image.h"
#include "core/task/progress.h"
#include "core/volume/field.h"

namespace pellucid::reference {

/// The exact image for volumes that are too large for direct summation: gridding in double
/// precision with a sinh kernel of width 13 at padding 2. It agrees with the direct sum to 1e-10 or
/// better. *Throws* Error{outOfMemory}, Cancelled. *Source*: Potts and Tasche 2021.
class WideKernel {
public:
    /// *Shape*: only the box is read, and the rest must be zero.
    WideKernel(const volume::Field &field, const volume::VoxelBox &box,
               const task::Progress &progress = {});

    std::vector<double> image(const scene::Camera &camera,
                              const scene::ImageDefinition &image) const;
    void sample(const std::vector<glm::dvec3> &frequencies,
                std::vector<std::complex<double>> &values) const;

    /// The memory for the spectrum of a box.
    static std::size_t bytes(const volume::VoxelBox &box);

private:
    /// The index of cell (0, j, k). j and k are periodic.
    std::size_t rowAt(int j, int k) const;

    volume::Lattice m_lattice;
    volume::GridSize m_padded;
    volume::PatientPoint m_wrapPoint;
    int m_rowStride = 0;
    std::vector<std::complex<double>> m_cells;
};

} // namespace pellucid::reference
