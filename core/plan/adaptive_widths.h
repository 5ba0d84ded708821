// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/plan/spectrum_energies.h"

namespace pellucid::plan {

/// The grid of a view's slice: half a plane, columns 0 to columns / 2 and rows on both sides of 0.
struct SlicePlane {
    int columns = 0, rows = 0; ///< of the whole grid
    /// Cells of the spectrum per column and per row, by axis.
    std::array<double, 3> perColumn{}, perRow{};
    double columnPerMm = 0.0, rowPerMm = 0.0; ///< the frequency steps
};

/// A spectrum that a slice is read from, and how it enters the channels of the picture: its slice,
/// at an offset, times at most amplitude + sum_d perSine[d] |sin 2 pi q_d|, q in cycles per sample.
struct SliceSource {
    std::size_t field = 0;
    bool isGradient = false;
    std::array<double, 3> offset{};                 ///< *Units*: cells
    std::array<double, 3> amplitude{};              ///< by channel
    std::array<std::array<double, 3>, 3> perSine{}; ///< by channel and axis
};

/// The width of the kernel that reads each tile of a slice: `tileColumns` columns of `tileRows`
/// rows. Width 0 leaves a tile out.
struct WidthMap {
    static constexpr int tileColumns = 16, tileRows = 16;

    int strips = 0;                   ///< up to the last one that is read
    int tiles = 0;                    ///< on each side of row 0
    std::vector<std::uint8_t> widths; ///< *Shape*: [strip][tile, from -tiles on]
    /// An estimate of the error of each tile, relative to each other. *Shape*: as `widths`.
    std::vector<float> errors;
    double estimatedError = 0.0; ///< of the choice, with a margin, relative L2
    /// A bound on the energy of the tiles with too little to be measured, which have no error of
    /// their own, in red, green and blue together. *Units*: of the picture squared, times mm^2.
    double unmeasuredEnergy = 0.0;

    /// Tiles of a strip; the first begins at row -tiles * tileRows.
    std::span<const std::uint8_t> strip(int strip) const {
        return std::span(widths).subspan(std::size_t(strip) * 2 * std::size_t(tiles),
                                         2 * std::size_t(tiles));
    }
    /// The share of the frequencies of the largest circle that each width reads.
    using Shares = std::array<double, fourier::Kernel::largestWidth + 1>;
    Shares shares(const SlicePlane &plane) const;
};

/// Runs `work(n)` for n = 0..count-1, in any order and on any threads. The work does not throw.
using ForEach = std::function<void(int count, const std::function<void(int)> &work)>;
void inOrder(int count, const std::function<void(int)> &work);
void onAllThreads(int count, const std::function<void(int)> &work);

/// Chooses the kernel widths for each view. Most frequencies of a picture have almost no energy: a
/// narrow kernel is accurate enough for them, or they need not be read. The fastest choice within
/// an error is the one in which every tile saves the same time per unit of error. A view uses at
/// most the whole tolerance.
class AdaptiveWidths {
public:
    using Weights = std::array<double, 3>; ///< of a field in red, green and blue
    using Energies = std::vector<std::shared_ptr<const SpectrumEnergies>>;

    /// `tolerance`: the error that a view may make, relative L2. *Shape*: one gradient per field,
    /// or none.
    AdaptiveWidths(std::shared_ptr<const fourier::KernelsByWidth> kernels, Energies fields,
                   Energies gradients, const scene::ImageDefinition &image, double tolerance)
        : m_kernels(std::move(kernels)), m_fields(std::move(fields)),
          m_gradients(std::move(gradients)), m_image(image), m_tolerance(tolerance) {}

    /// For plain frames. *Shape*: one weight for each field. `axes`: columns U, V and W. The map
    /// does not depend on `forEach`.
    WidthMap mapFor(const glm::dmat3 &axes, const SlicePlane &plane,
                    std::span<const Weights> weights, const ForEach &forEach = inOrder) const;
    /// How frequencies that do not need the widest kernel are treated.
    enum class Reduction { narrowerKernels, skippingOnly };
    /// For frames with cue or light. `minEnergy`: the energy of low frequencies of the picture; the
    /// whole has more. *Units*: of the spectrum squared, over mm^2.
    WidthMap mapFor(const SlicePlane &plane, std::span<const SliceSource> sources, double minEnergy,
                    Reduction reduction, const ForEach &forEach = inOrder) const;
    bool hasGradients() const { return !m_gradients.empty(); }

    const std::shared_ptr<const fourier::KernelsByWidth> &kernels() const { return m_kernels; }
    /// The definition of the image that the energies belong to.
    const scene::ImageDefinition &image() const { return m_image; }

private:
    std::shared_ptr<const fourier::KernelsByWidth> m_kernels;
    Energies m_fields, m_gradients;
    scene::ImageDefinition m_image;
    double m_tolerance;
};

} // namespace pellucid::plan
