// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/field/energy_marginals.h"
#include "core/field/slab_products.h"
#include "core/fourier/kernels/moment_kernel.h"
#include "core/fourier/spectrum.h"
#include "core/shading/slice_shading.h"

namespace pellucid::plan {

/// Upper bounds on the errors that the taps of an axis make in a block of samples. The taps
/// multiply a sample at x (in periods from the wrap voxel) by a(x, t), where a frequency is t off
/// the grid.
struct BlockAmplitudes {
    /// sum_m r^2, where r = h(x + m)/h(x) is the amplitude of the alias of x in period m. It equals
    /// the mean of |a - 1|^2 over all t.
    double aliases = 0.0;
    /// The same where aliases add up in phase: the mean of |a - 1|^2 over the few t of a view along
    /// an axis, where the steps of slice and grid are commensurate.
    double inPhase = 0.0;
    double inverse = 0.0; ///< 1/h(x)^2
};

/// The errors of one axis of a layout.
struct AxisError {
    std::vector<BlockAmplitudes> blocks; ///< see `field::blockRanges`
    double kernelEnergy = 1.0;           ///< integral H^2
    double periodMm = 0.0;               ///< of the padded axis
    /// The error of the moment kernel of a linear cue, as the larger of two energies w^T C w, with
    /// C of `field::SlabProducts` and k the kernel's response. In views along the axis, w is the
    /// difference between the sum over the taps and i x; in views close to it, w is k(x)/h(x) - x
    /// and k(x + m)/h(x). *Units*: periods.
    double moment = 0.0;
};

/// The errors of an axis with this many samples. *Units*: `padded` in samples.
AxisError axisError(const fourier::Kernel &kernel, int padded, int samples, double stepMm);
/// Raises `error.moment` to that of this field, for a linear cue.
void addMomentError(AxisError &error, const fourier::Kernel &kernel,
                    const fourier::MomentKernel &moment, int padded,
                    const field::SlabProducts &slabs);

/// The largest error of the taps of an axis at the samples up to x from the wrap voxel, for any
/// frequency, relative to the amplitude of the sample. *Units*: x in periods.
double largestTapError(const fourier::Kernel &kernel, double x);

/// The root mean square of a cue over all depths, including those far beyond the volume, where
/// aliases occur. A linear cue, whose own aliases count separately, is averaged over the depths of
/// the volume.
double cueRms(const shading::DepthCue &cue);

/// The weights of errors relative to the image under a depth cue.
struct CueWeight {
    /// For aliases: the cue's root mean square where they occur, divided by the least that the cue
    /// can leave of the image in any view. That is its value at the centre of the field's energy
    /// or, for a curve, its root mean square over the depths of the energy.
    double aliases = 1.0;
    /// For the moments along each axis: the depth of a period times the cue's slope.
    std::array<double, 3> moments{};
};
/// *Shape*: `energy` holds the samples of the layout's box. *Units*: `radiusMm` is the R of the
/// cue.
CueWeight cueWeight(const shading::DepthCue &cue, const volume::Lattice &lattice, double radiusMm,
                    const fourier::SpectrumLayout &layout, const field::EnergyMarginals &energy);

/// An upper bound on the relative L2 error of an image in any direction; for a field with negative
/// samples, whose parts can cancel, the expected error. The error is the projection of f (a - 1).
/// For parts f_b of a field without negative samples
///   |P(f w)|^2 <= sum_b max_b(w)^2 <P f_b, P f>, since <P f_a, P f_b> >= 0,
/// and each <P f_b, P f> / |P f|^2 is at most `field::EnergySpread::peakedness` times the part's
/// share of the mass: the worst parts get the largest shares that they can have. Aliases of several
/// axes add up in amplitude, as where they overlap each other or the projection: every slice grid
/// has views close to that. `share`: the image's share of the projection's energy.
///
/// Rounding to binary16 changes each cell by 2.1e-4 on average (root mean square), and by at most
/// 4.9e-4. The average holds if a slice has many cells that round independently.
/// - No cell has more than the share s of a slice's energy that frequency 0 can have, 1 / (area of
///   a period x `field::EnergySpread::leastProjection`). A slice therefore has at least 1/s cells,
///   and the energy of the error scatters by 1.05 sqrt(s) of its mean. The bound adds sqrt(s) of
///   the distance from the mean to the maximum: all of it for a single cell, 4.2 standard
///   deviations for many.
/// - Cells along an axis are equal if the field lies in one layer across it; all cells of a slice
///   are if that holds for two axes. The share of pairs of the energy that lie in one layer
///   measures how nearly.
/// Rounding to float and summing add 3e-7.
double predictRelativeError(const std::array<AxisError, 3> &axes, fourier::Storage storage,
                            const field::EnergyMarginals &field, double share,
                            const CueWeight &cue = {});

} // namespace pellucid::plan
