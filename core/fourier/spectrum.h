// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <memory>

#include "core/fourier/kernel.h"
#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::fourier {

/// How a field is prepared.
struct SpectrumLayout {
    Kernel kernel;
    volume::VoxelBox box;    ///< the part of the lattice that is transformed
    volume::GridSize padded; ///< smooth, even sizes of the periodic grid
    /// Bytes of the prepared spectrum.
    std::size_t bytes() const;
};

/// The half spectrum of a field, divided by the kernel's apodisation, on a periodic padded grid
/// with an apron, so that interpolation needs neither wrap nor branch.
///
/// With the wrap voxel x_w as the origin of phase, the value at grid index (p, q, r) is
///   dV * sum_n f[n] / (h_0 h_1 h_2) * exp(-i 2 pi (p, q, r)/padded . (n - n_w)).
/// A frequency s (cycles per mm) has the grid index padded_d * (a_d . s) modulo padded_d. The grid
/// is that of the lattice's own steps: tilted and anisotropic volumes are not resampled.
class Spectrum {
public:
    /// Cells around the stored half, enough for kernels up to width 7.
    static constexpr int apron = 4;

    /// *Throws* Error{outOfMemory}, Cancelled.
    static Spectrum prepare(const volume::Volume &field, const SpectrumLayout &layout,
                            const task::Progress &progress = {});

    const SpectrumLayout &layout() const { return m_layout; }
    const volume::Lattice &lattice() const { return m_lattice; }
    /// The position of the voxel that lies at index 0 of the padded grid.
    volume::PatientPoint wrapPoint() const { return m_wrapPoint; }
    /// The value at grid index 0; indices from -apron to padded + apron - 1 in y and z, from -apron
    /// to padded/2 + apron in x may be read.
    const std::complex<float> *origin() const { return m_origin; }
    std::ptrdiff_t rowStride() const { return m_rowStride; }
    std::ptrdiff_t planeStride() const { return m_planeStride; }
    std::size_t bytes() const { return m_layout.bytes(); }

private:
    Spectrum(const volume::Volume &field, const SpectrumLayout &layout);

    volume::Lattice m_lattice;
    SpectrumLayout m_layout;
    volume::PatientPoint m_wrapPoint;
    std::shared_ptr<std::complex<float>[]> m_cells;
    std::complex<float> *m_origin = nullptr;
    std::ptrdiff_t m_rowStride = 0, m_planeStride = 0;
};

} // namespace pellucid::fourier
