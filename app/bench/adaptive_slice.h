// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/fourier/spectrum.h"
#include "core/render/camera.h"

namespace pellucid::bench {

/// The adaptive filter of Totsuka and Levoy 1993, section 4: where all cells within reach of a wide
/// kernel are weak, one cell serves. Plain scalar code for both filters, so that what is compared
/// is the idea. The bound is the corrected one: the change of a slice sample is at most the
/// largest weak cell times the sum of |H2 - H1|, and Parseval's theorem on the slice gives the
/// error of the image.
class AdaptiveSlice {
public:
    explicit AdaptiveSlice(const fourier::Spectrum &spectrum);

    struct Slice {
        std::vector<std::complex<float>> samples; ///< rows x columns, s_u >= 0 half
        std::size_t cellsRead = 0, frequencies = 0;
        double milliseconds = 0.0;
    };
    /// The slice on a grid of `size` frequencies a side, on one thread; `tolerance` 0: the wide
    /// kernel everywhere, else the relative L2 error that the bound allows.
    Slice extract(const render::Camera &camera, int size, double tolerance);

private:
    std::size_t at(int p, int q, int r) const;
    void mark(float threshold);

    const fourier::Spectrum &m_spectrum;
    int m_apron, m_columns, m_rows, m_planes;
    std::vector<std::complex<float>> m_cells;
    std::vector<std::uint8_t> m_weak;
    float m_threshold = -1.0F;
};

} // namespace pellucid::bench
