// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/fourier/kernels/moment_kernel.h"
#include "core/fourier/spectrum.h"
#include "core/plan/energy_marginals.h"
#include "core/plan/slab_products.h"
#include "core/shading/slice_shading.h"

namespace pellucid::plan {

/// What the taps of an axis make of the samples of a block of it, at most. They make a(x, t) of a
/// sample at x (in periods from the wrap voxel) where a frequency lies t off the grid.
struct BlockAmplitudes {
    /// sum_m r^2, r = h(x + m)/h(x) the amplitude of the alias of x in period m: the mean of
    /// |a - 1|^2 over all t.
    double aliases = 0.0;
    /// Where the aliases add up in phase: |a - 1|^2 over the few t that the frequencies of a view
    /// along an axis may have, when the slice's steps and the grid's have a common one.
    double inPhase = 0.0;
    double inverse = 0.0; ///< 1/h(x)^2
};

/// What one axis of a layout leaves.
struct AxisError {
    std::vector<BlockAmplitudes> blocks; ///< see `blockRanges`
    /// The brightest alias: the largest amplitude r, times the square root of e relative to the
    /// brightest part of the axis.
    double brightest = 0.0;
    double kernelEnergy = 1.0; ///< integral H^2
    bool isShort = false;      ///< so few samples that their spectrum's cells round alike
    /// Of the moment kernel of a linear cue, with k its response and w^T C w the energies of
    /// `SlabProducts`: in views along the axis, w the difference of the sum over the taps and i x;
    /// close to it, w = k(x)/h(x) - x and k(x + m)/h(x); the larger of the two. And the largest of
    /// these amplitudes. *Units*: periods.
    double moment = 0.0, brightestMoment = 0.0;
};

/// *Shape*: one energy per sample of the axis; *Units*: padded in samples.
AxisError axisError(const fourier::Kernel &kernel, int padded, const std::vector<double> &energy);
/// Adds what the kernel of a linear cue leaves.
void addMomentError(AxisError &error, const fourier::Kernel &kernel,
                    const fourier::MomentKernel &moment, int padded, const SlabProducts &slabs);

/// What a graphics card's own linear filter adds along one axis where it reads pairs of taps in one
/// fetch, squared and relative to the energy of the field: its weights have 8 fraction bits, wrong
/// by 2^-8/sqrt(12) on average, times the difference of the neighbouring cells of each pair:
///   2^-16/12 sum_pairs (sum of the pair's taps)^2 sum_x e(x) 4 sin^2(pi x) / h(x)^2.
/// Infinite for a kernel with negative taps, which cannot be paired. *Shape*: as of axisError.
double filterError(const fourier::Kernel &kernel, int padded, const std::vector<double> &energy);

/// The root mean square of a cue over all depths, including those far beyond the volume, where
/// aliases lie. For a linear cue, whose own aliases are counted apart, over the depths of the
/// volume.
double cueRms(const shading::DepthCue &cue);

/// How a depth cue weighs the errors against the image.
struct CueWeight {
    /// Of aliases: the root mean square of the cue where they lie, over the least that the cue can
    /// leave of the image, seen from any side: its value at the middle of the field's energy, or,
    /// of a curve, its root mean square over the depths of the energy.
    double aliases = 1.0;
    /// Of the moments along each axis: how much depth a period is, times the cue's slope.
    std::array<double, 3> moments{};
};
/// *Shape*: the energies of the samples of the layout's box, and where they lie; *Units*: radiusMm
/// is the R of the cue.
CueWeight cueWeight(const shading::DepthCue &cue, const volume::Lattice &lattice, double radiusMm,
                    const fourier::SpectrumLayout &layout, const EnergyMarginals &energy);

/// The relative L2 error of an image from any direction, at most. The error is the projection of
/// f (a - 1). For parts f_b of a field without negative samples
///   |P(f w)|^2 <= sum_b max_b(w)^2 <P f_b, P f>, since <P f_a, P f_b> >= 0,
/// and each <P f_b, P f> / |P f|^2 is at most `EnergySpread::peakedness` times the part's share of
/// the mass: the worst parts have as much as they can have. Of a field with negative samples, which
/// can cancel, it is what is expected, and a margin. Aliases of several axes add up in amplitude,
/// as where they fall onto each other or onto the projection: for any slice grid there are views
/// close to it. `share`: how much of the projection's energy the image holds. Rounding to binary16
/// leaves 2.1e-4 of each cell, spread evenly over the period; rounding to float and summing 3e-7.
double predictRelativeError(const std::array<AxisError, 3> &axes, fourier::Storage storage,
                            const EnergyMarginals &field, double share, const CueWeight &cue = {});

/// The largest error of a pixel relative to the largest pixel, roughly: the brightest aliases of
/// the axes, and the rounding at 4.5 standard deviations of an image whose mean square is a fifth
/// of its peak's. Beside metal it says what the relative L2 error hides.
double predictMaximum(const std::array<AxisError, 3> &axes, fourier::Storage storage,
                      const EnergyMarginals &field, const CueWeight &cue = {});

} // namespace pellucid::plan
