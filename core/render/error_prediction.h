// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/fourier/moment_kernel.h"
#include "core/fourier/spectrum.h"
#include "core/render/energy_marginals.h"
#include "core/shading/slice_shading.h"

namespace pellucid::render {

/// What one axis of a layout leaves, relative to the energy of the field.
struct AxisError {
    /// sum_x e(x) sum_m r^2 with r = h(x + m)/h(x), the amplitude of the ghost of x in period m.
    double ghosts = 0.0;
    /// The same of a frequency on the grid of the axis, where the ghosts add up in phase:
    /// sum_x e(x) |S(x)/h(x) - 1|^2 with S the transform of the taps.
    double inPhase = 0.0;
    /// The brightest ghost: the largest amplitude r, times the square root of e relative to the
    /// brightest part of the axis.
    double brightest = 0.0;
    /// integral H^2 times sum_x e(x)/h(x)^2: how rounding of the cells reaches the image.
    double noise = 1.0;
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

/// How a depth cue weighs the errors against the image.
struct CueWeight {
    /// Of ghosts: the root mean square of the cue where they lie, over the least that the cue can
    /// leave of the image, seen from any side: its value at the middle of the field's energy, or,
    /// of a curve, its root mean square over the depths of the energy.
    double ghosts = 1.0;
    /// Of the moments along each axis: how much depth a period is, times the cue's slope.
    std::array<double, 3> moments{};
};
/// *Shape*: the energies of the samples of the layout's box, and where they lie; *Units*: radiusMm
/// is the R of the cue.
CueWeight cueWeight(const shading::DepthCue &cue, const volume::Lattice &lattice, double radiusMm,
                    const fourier::SpectrumLayout &layout, const EnergyMarginals &energy);

/// How much of what the ghosts spread over the period falls into the image, relative to the share
/// of the projection's energy that the image holds.
struct ImageShare {
    std::array<double, 3> inImage{1.0, 1.0, 1.0}; ///< of the ghosts along each axis
};

/// The relative L2 error of an image from a direction that no axis is close to, or along an axis,
/// whichever is worse. A ghost lies one or more padded periods away along its axis. Seen across the
/// axis it lands anywhere in the slice's period, hence in the image by its share of the area; seen
/// along the axis all of it falls onto the projection, in phase with the ghosts of the other
/// periods. Rounding to binary16 leaves 2.1e-4 of each cell, spread evenly over the period;
/// rounding to float and summing 3e-7.
double predictRelativeError(const std::array<AxisError, 3> &axes, fourier::Storage storage,
                            const ImageShare &share, const CueWeight &cue = {});

/// The largest error of a pixel relative to the largest pixel, roughly: the brightest ghosts of the
/// axes, and the rounding at 4.5 standard deviations of an image whose mean square is a fifth of
/// its peak's. Beside metal it says what the relative L2 error hides.
double predictMaximum(const std::array<AxisError, 3> &axes, fourier::Storage storage,
                      const CueWeight &cue = {});

} // namespace pellucid::render
