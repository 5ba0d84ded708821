// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>

#include "core/fourier/kernels/moment_kernel.h"
#include "core/fourier/spectrum.h"
#include "core/fourier/transforms/strip_transform.h"
#include "core/scene/image_definition.h"
#include "core/shading/shading.h"

namespace pellucid::render {

/// One strip of the slice: 16 columns of the frequency grid and every row within the band's disc.
struct StripBounds {
    int innerRow = -1; ///< up to here, on both sides of 0, the roll-off is 1 in every lane
    int outerRow = -1; ///< last row with a frequency inside the disc; -1: none
    /// Where the roll-off of row innerRow + 1 begins in `FrameJob::rollOff`; 16 values a row.
    std::size_t rollOff = 0;
};

/// Where a batch of 16 neighbouring frequencies reads, and with which weights. *Shape*: y and z
/// weights [tap][lane]; x weights [lane][4 or 8 taps].
struct alignas(64) FrequencyBatch {
    static constexpr int lanes = fourier::stripLanes;
    std::array<float, std::size_t(lanes) * 8 + 16> x;
    std::array<float, std::size_t(lanes) * fourier::Kernel::largestWidth> y, z;
    /// The first cell to read in the plane of each tap, [tap][lane].
    std::array<std::uint32_t, std::size_t(lanes) * fourier::Kernel::largestWidth> cell;
    std::array<float, lanes> factor; ///< reconstruction and roll-off
    std::array<float, lanes> sign;   ///< -1: the conjugate is meant

    /// Of a linear cue: the weights of the moment along each axis, laid out as x, y, z.
    std::array<float, std::size_t(lanes) * 8 + 16> momentX;
    std::array<float, std::size_t(lanes) * fourier::Kernel::largestWidth> momentY, momentZ;
    /// Of light, by image: the factor of i times the slice, and what the cue adds to it by changing
    /// from sample to sample, see FrameShading.
    std::array<std::array<float, lanes>, 3> gradient, excess;
};

/// By axis.
using MomentKernels = std::array<fourier::MomentKernel, 3>;

/// What a spectrum is of.
enum class FrameKind { field, gradient };

/// A spectrum and its share of each channel of the slice.
struct FrameSource {
    const std::byte *cells = nullptr;
    std::size_t field = 0; ///< which of the engine's
    std::array<float, 3> shares{1.0F, 1.0F, 1.0F};
    FrameKind kind = FrameKind::field;
};

/// A shading::SliceShading in terms of the spectra's cells. With F and G the slices of f and of |g|
/// a term away from the centre, and F' = base F + moment of F, the slice of image c is the sum over
/// terms of
///   weight [(ambient + i sum_d gradient_d sin(2 pi q_d)) F' + magnitude G' - excess F],
/// excess = sum_d excess_d cos(2 pi q_d): the cue is applied before the differences are taken,
/// which adds half its change to both neighbours. *Source*: Totsuka 1993, eq. 12 to 14, for central
/// differences.
struct FrameShading {
    struct Term {
        std::array<double, 3> cells{}; ///< away from the central slice, by axis
        std::complex<float> weight;
    };
    struct Image {
        float ambient = 1.0F, magnitude = 0.0F;
        std::array<double, 3> gradient{}, excess{};
    };
    /// The central one first.
    std::array<Term, 2 * shading::mostCurveValues> terms;
    int termCount = 1;
    bool lit = false;  ///< some magnitude is not zero
    bool cued = false; ///< there are moments
    float base = 1.0F;
    const MomentKernels *kernels = nullptr;
    std::array<double, 3> perMoment{}; ///< cue per sum of a moment kernel, by axis
    std::array<Image, 3> images;
};

/// What the sums are at frequency 0, exactly, and their moments. *Shape*: by FrameKind and sum.
struct ZeroSum {
    double value = 0.0, moment = 0.0;
};
using ZeroSums = std::array<std::array<ZeroSum, 3>, 2>;

/// What a frame's parts share: read by every thread, except what each part writes for itself.
struct FrameJob {
    static constexpr int mostChannels = 3;

    const fourier::SpectrumLayout *layout = nullptr; ///< of all sources
    const fourier::CellLayout *cellLayout = nullptr;
    const FrameSource *sources = nullptr;
    int sourceCount = 1;
    /// How many images are made: one or three.
    int channels = 1;
    /// How many sums of the sources are: one that serves all images, or one each.
    int sums = 1;
    const FrameShading *shading = nullptr; ///< null: none
    scene::ImageDefinition image;
    bool wraps = false; ///< some |a_d.s| of the disc exceeds 1/2

    int columns = 0, rows = 0; ///< of the frequency grid, hence of the periodic image
    int imageColumns = 0, imageRows = 0;
    /// Grid cells of the spectrum per column and per row of the slice, by axis.
    std::array<double, 3> cellsPerColumn{}, cellsPerRow{};
    std::array<float, 3> edgeSlack{}; ///< see FrameGeometry
    const StripBounds *strips = nullptr;
    int stripCount = 0;
    const float *rollOff = nullptr;
    /// exp(+i ...) that moves the wrap voxel and the first pixel to where they are, by column
    /// (real parts, then imaginary parts, 16 x stripCount each) and by row 0..rows/2; the row's
    /// holds the frequency cell's area and the spectrum's unit too.
    const float *columnPhase = nullptr;
    const std::complex<float> *rowPhase = nullptr;

    const fourier::StripTransform *alongRows = nullptr;   ///< length rows
    const fourier::StripTransform *halfColumns = nullptr; ///< length columns / 2
    /// exp(+i 2 pi k / columns), k = 0..columns/2 - 1.
    const std::complex<float> *unpackReal = nullptr;

    /// After the transform along image rows' direction: [group of 16 image rows][column][strip], of
    /// each channel.
    std::array<float *, mostChannels> lines{};
    ZeroSums zero{};
    std::array<float *, mostChannels> samples{}; ///< imageRows x imageColumns each
};

/// Scratch of one thread: an array of `length` strips for each channel, one beside them, and a few
/// batches.
struct FrameScratch {
    std::array<float *, FrameJob::mostChannels> strips{};
    float *beside = nullptr;
    FrequencyBatch *batches = nullptr; ///< `batchesAhead` + 1 of them
    /// Time spent on strips, and on their interpolation alone, added up.
    double stripSeconds = 0.0, sliceSeconds = 0.0;
};
inline constexpr int batchesAhead = 3;
/// Cuts a frame's times in two: seconds since some moment.
double frameClockSeconds();

/// Interpolates one strip of the slice and transforms it along the rows.
void sliceStrip(const FrameJob &job, int strip, FrameScratch &scratch);
/// Transforms 16 image rows of a channel along the columns and stores what belongs to the image.
void finishRows(const FrameJob &job, int channel, int group, FrameScratch &scratch);
/// Three planes times a color each as pixels of red, green and blue. *Shape*: count samples each.
void joinPlanes(const std::array<const float *, 3> &planes, const std::array<float, 3> &color,
                std::size_t count, float *pixels);
/// The instruction set in use.
const char *instructionSet();

} // namespace pellucid::render
