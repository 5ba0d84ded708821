// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/fourier/kernels/moment_kernel.h"
#include "core/fourier/spectrum.h"
#include "core/fourier/transforms/strip_transform.h"
#include "core/plan/slice_grid.h"
#include "core/scene/image_definition.h"
#include "core/shading/shading.h"
#include "core/widths/width_map.h"

namespace pellucid::render {

/// One strip of the slice: 16 columns of the frequency grid and every row within the band's disc.
struct StripBounds {
    int innerRow = -1; ///< the radial factor is 1 in every lane up to this row, on both sides of 0
    int outerRow = -1; ///< last row with a frequency inside the disc; -1: none
    /// The index in `FrameJob::rollOff` of the values of row innerRow + 1; 16 values a row.
    std::size_t rollOff = 0;
};

/// The cells and weights of 16 frequencies in neighbouring columns. *Shape*: y and z weights
/// [tap][lane]; x weights [lane][4 or 8 taps].
struct alignas(64) FrequencyBatch {
    static constexpr int lanes = fourier::stripLanes;
    std::array<float, std::size_t(lanes) * 8 + 16> x;
    std::array<float, std::size_t(lanes) * fourier::Kernel::largestWidth> y, z;
    /// The first cell in the plane of each tap, [tap][lane].
    std::array<std::uint32_t, std::size_t(lanes) * fourier::Kernel::largestWidth> cell;
    std::array<float, lanes> factor; ///< reconstruction and roll-off
    std::array<float, lanes> sign;   ///< -1: the conjugate is used

    /// For a linear cue: the weights of the moment along each axis, laid out as x, y, z.
    std::array<float, std::size_t(lanes) * 8 + 16> momentX;
    std::array<float, std::size_t(lanes) * fourier::Kernel::largestWidth> momentY, momentZ;
    /// For light, by image: the factor of i times the slice, and the term for the cue's change from
    /// sample to sample, see FrameShading.
    std::array<std::array<float, lanes>, 3> gradient, excess;
};

/// The moment kernels of the widths that read a slice. *Shape*: [width][axis]; empty for others.
using MomentKernels =
    std::array<std::vector<fourier::MomentKernel>, fourier::Kernel::largestWidth + 1>;

/// What a spectrum represents: a field, or the length of its gradient.
enum class FrameKind { field, gradient };

/// A spectrum and its weight in each channel of the slice.
struct FrameSource {
    const std::byte *cells = nullptr;
    std::size_t field = 0;                                 ///< index in the engine's spectra
    std::array<float, 3> channelWeights{1.0F, 1.0F, 1.0F}; ///< of the cells in each sum
    FrameKind kind = FrameKind::field;
    std::array<double, 3> weights{1.0, 1.0, 1.0}; ///< the same, of the field
};

/// A shading::SliceShading in terms of the spectra's cells. With F and G the slices of f and of
/// |g|, offset by a term's cells, and F' = base F + moment of F, the slice of image c is the sum
/// over terms of
///   weight [(ambient + i sum_d gradient_d sin(2 pi q_d)) F' + magnitude G' - excess F],
/// with excess = sum_d excess_d cos(2 pi q_d). The cue is applied before the differences are taken,
/// which adds half its change to both neighbours. *Source*: Totsuka 1993, eq. 12 to 14, for central
/// differences.
struct FrameShading {
    struct Term {
        std::array<double, 3> cells{}; ///< offset from the central slice, by axis
        std::complex<float> weight;
    };
    struct Image {
        float ambient = 1.0F, magnitude = 0.0F;
        std::array<double, 3> gradient{}, excess{};
    };
    /// The first term is the central one.
    std::array<Term, 2 * shading::maxCurveValues> terms;
    int termCount = 1;
    bool lit = false;  ///< some magnitude is not zero
    bool cued = false; ///< there are moments
    float base = 1.0F;
    const MomentKernels *kernels = nullptr;
    std::array<double, 3> perMoment{}; ///< the cue's factor per sum of a moment kernel, by axis
    std::array<Image, 3> images;
};

/// The exact sums at frequency 0, and their moments. *Shape*: by FrameKind and sum.
struct ZeroSum {
    double value = 0.0, moment = 0.0;
};
using ZeroSums = std::array<std::array<ZeroSum, 3>, 2>;

/// The data that the parts of a frame share. All threads read it; each part writes only its own
/// output.
struct FrameJob {
    static constexpr int maxImages = 3;

    const fourier::SpectrumLayout *layout = nullptr; ///< of all sources
    const fourier::CellLayout *cellLayout = nullptr;
    const FrameSource *sources = nullptr;
    int sourceCount = 1;
    /// The number of images: as many as the picture's colors have rank; in colored light three.
    int imageCount = 1;
    /// The number of sums of the sources: one for all images, or one each.
    int sums = 1;
    const FrameShading *shading = nullptr; ///< null: none
    scene::ImageDefinition image;

    int columns = 0, rows = 0; ///< of the frequency grid, hence of the periodic image
    int imageColumns = 0, imageRows = 0, pictureChannels = 1;
    /// Grid cells of the spectrum per column and per row of the slice, by axis.
    std::array<double, 3> cellsPerColumn{}, cellsPerRow{};
    std::array<float, 3> edgeSlack{}; ///< see FrameGeometry
    /// By width: the kernels of the three axes, or null.
    std::array<const fourier::Kernel *, fourier::Kernel::largestWidth + 1> kernels{};
    const widths::WidthMap *widthMap = nullptr; ///< null: the layout's own width reads everything
    const StripBounds *strips = nullptr;
    int stripCount = 0;
    const float *rollOff = nullptr;
    /// exp(+i ...) that moves the wrap voxel and the first pixel to their positions. By column:
    /// real parts, then imaginary parts, 16 x stripCount each. By row 0..rows/2: also times the
    /// frequency cell's area and the spectrum's unit.
    const float *columnPhase = nullptr;
    const std::complex<float> *rowPhase = nullptr;

    const fourier::StripTransform *alongRows = nullptr;   ///< length rows
    const fourier::StripTransform *halfColumns = nullptr; ///< length columns / 2
    /// exp(+i 2 pi k / columns), k = 0..columns/2 - 1.
    const std::complex<float> *unpackReal = nullptr;

    /// The result of the transform along the image rows' direction: [group of 16 image
    /// rows][column][strip], of each channel.
    std::array<float *, maxImages> lines{};
    ZeroSums zero{};
    /// A color picture is the sum of the images in these colors.
    std::array<std::array<float, 3>, maxImages> imageColors{};
    float *samples = nullptr; ///< imageRows x imageColumns x pictureChannels
};

/// Scratch of one thread: an array of `length` strips for each channel, one more strip array, and a
/// few batches.
struct FrameScratch {
    std::array<float *, FrameJob::maxImages> strips{};
    float *spare = nullptr;
    FrequencyBatch *batches = nullptr; ///< `batchesAhead` + 1 of them
    /// The total time of strips, and of their interpolation alone.
    double stripSeconds = 0.0, sliceSeconds = 0.0;
};
inline constexpr int batchesAhead = 3;
/// A clock that splits a frame's time: seconds since an arbitrary moment.
double frameClockSeconds();

/// Sixteen frequencies: one in each column of a strip, within 16 rows.
struct StripLine {
    int strip = 0;
    int row = 0;                    ///< of the first one
    const float *rows = nullptr;    ///< 16 distances from that row; null: all are in it
    const float *rollOff = nullptr; ///< 16 factors; null: 1
};
/// Reads lines by one width into the strips of the scratch, one after the other. *Requires*: width
/// > 0; of the job, all that `readingJob` sets, the phases and `stripCount`; of the scratch,
/// `batches` and room for a strip for each line.
void readLines(const FrameJob &job, std::span<const StripLine> lines, int width,
               FrameScratch &scratch);
/// Interpolates one strip of the slice and transforms it along the rows.
void sliceStrip(const FrameJob &job, int strip, FrameScratch &scratch);
/// Transforms 16 rows of every image along the columns and stores them in the picture.
void finishRows(const FrameJob &job, int group, FrameScratch &scratch);
/// The instruction set in use.
const char *instructionSet();

/// The number of groups of 16 lines (columns of a strip, or rows) for this many lines.
inline int stripsOf(int lines) {
    return (lines + fourier::stripLanes - 1) / fourier::stripLanes;
}

/// exp(+i 2 pi n turns), n = 0..count-1, within 1e-13.
std::vector<std::complex<double>> rotations(int count, double turns);

/// The factors of a frequency that depend only on its distance from 0: roll-off and detail.
struct RadialFactors {
    double rollOffShare = 0.0;
    double detail = 0.0;      ///< see scene::detailFactor
    double detailWidth = 0.0; ///< u = (radius detailWidth)^2, where the band ends at radius 1
    RadialFactors() = default;
    RadialFactors(const scene::ImageDefinition &image, double pixelMm);
    double at(double radius) const;
    bool operator==(const RadialFactors &) const = default;
};

/// Tables that depend only on the slice grid and these factors, kept from frame to frame.
struct GridTables {
    /// `count`: of strips, at most as many as half the grid has.
    GridTables(const plan::SliceGrid &grid, const RadialFactors &factors, int count);

    plan::SliceGrid grid;
    RadialFactors factors;
    fourier::StripTransform alongRows;           ///< length rows
    fourier::StripTransform halfColumns;         ///< length columns / 2
    std::vector<std::complex<float>> unpackReal; ///< see FrameJob::unpackReal
    std::vector<StripBounds> strips;             ///< the first ones
    std::vector<float> rollOff;                  ///< see StripBounds::rollOff
};

} // namespace pellucid::render
