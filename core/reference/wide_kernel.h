// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/reference/slice_image.h"
#include "core/task/progress.h"
#include "core/volume/field.h"

namespace pellucid::reference {

/// The exact image for volumes that are too large for direct summation: Kaiser-Bessel gridding of
/// width 12 at padding 2 in double precision. It agrees with the direct sum to 1e-10 or better.
/// *Throws* Error{outOfMemory}, Cancelled. *Source*: Beatty, Nishimura, Pauly 2005.
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
    volume::Lattice m_lattice;
    volume::GridSize m_padded;
    volume::PatientPoint m_wrapPoint;
    int m_rowStride = 0;
    std::vector<std::complex<double>> m_cells;
};

} // namespace pellucid::reference
