// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/fourier/spectrum.h"
#include "core/scene/camera.h"

namespace pellucid::bench {

/// The adaptive filter of Totsuka and Levoy 1993, section 4: if all cells that a wide kernel reads
/// are weak, a single cell replaces it. Both filters are plain scalar code, so that only the idea
/// is compared. The bound is corrected: the change of a slice sample is at most the largest weak
/// cell times the sum of |H2 - H1|, and Parseval's theorem on the slice gives the error of the
/// image.
class AdaptiveSlice {
public:
    explicit AdaptiveSlice(const fourier::Spectrum &spectrum);

    struct Slice {
        int size = 0;
        std::vector<std::complex<float>> samples; ///< size x (size/2 + 1), the half s_u >= 0
        std::size_t cellsRead = 0, frequencies = 0;
        double milliseconds = 0.0;
    };
    /// Extracts a slice of `size` frequencies per side on one thread. `tolerance`: the relative L2
    /// error that the bound allows; 0 uses the wide kernel everywhere.
    Slice extract(const scene::Camera &camera, int size, double tolerance);

private:
    std::size_t at(int p, int q, int r) const;
    void mark(float threshold);
    float threshold(const Slice &exact, double tolerance) const;
    std::complex<float> wideSample(const std::array<double, 3> &g) const;

    const fourier::Spectrum &m_spectrum;
    int m_halo, m_columns, m_rows, m_planes;
    std::vector<std::complex<float>> m_cells;
    std::vector<std::uint8_t> m_weak;
    float m_threshold = -1.0F;
};

/// The relative L2 error of the image of `slice`, by Parseval's theorem on the whole slice; of two
/// mirrored columns only one is stored. *Requires*: both slices have the same size.
double relativeL2(const AdaptiveSlice::Slice &slice, const AdaptiveSlice::Slice &exact);

/// The adaptive filter compared with the wide one from the same views.
struct AdaptiveComparison {
    double bound = 0.0;                    ///< the `tolerance` of the slices
    double relativeL2 = 0.0;               ///< of the filter alone, in the worst view
    double wideMs = 0.0, adaptiveMs = 0.0; ///< median over the views of the fastest run
    /// Means per slice: frequencies, and the cells read for them.
    double frequencies = 0.0, wideCells = 0.0, adaptiveCells = 0.0;

    double share() const { return adaptiveCells / wideCells; }
    double speedUp() const { return wideMs / adaptiveMs; }
};

/// Compares the two filters from several views. `size`: as in AdaptiveSlice::extract.
AdaptiveComparison compareFilters(AdaptiveSlice &slices, const scene::Camera &camera, int size,
                                  std::span<const glm::dquat> views, double bound);

/// The comparison at the largest bound, within 2 %, whose measured error is at most `relativeL2`;
/// if the narrow filter alone meets that, the bound at which only it is used.
AdaptiveComparison compareFiltersAt(AdaptiveSlice &slices, const scene::Camera &camera, int size,
                                    std::span<const glm::dquat> views, double relativeL2);

/// The number of real multiply-adds in a frame's slices. Weighting a complex cell by a real tap
/// takes two. With a linear cue (`cued`) each cell is weighted twice: by the kernel and by the
/// moment kernel.
double multiplyAdds(double cellsRead, bool cued);

} // namespace pellucid::bench
