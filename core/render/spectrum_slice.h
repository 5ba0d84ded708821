// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/render/projection_engine.h"
#include "core/scene/camera.h"
#include "core/task/progress.h"

namespace pellucid::render {

/// The magnitude of the central slice of a spectrum over the whole band of a picture.
struct SpectrumSlice {
    int side = 0;            ///< frequencies along U and along V
    double stepPerMm = 0.0;  ///< from one frequency to the next, cycles per mm
    double limitPerMm = 0.0; ///< radius of the band's disc: half a cycle per pixel of the camera
    /// 20 log10(|D(s)| / |D(0)|), at least `lowestDecibels`. *Shape*: side x side, U to the right,
    /// V upward, rows from the top; frequency 0 is in row and column side/2.
    std::vector<float> decibels;
};

/// The value for frequencies this weak or weaker, including zero.
inline constexpr double lowestDecibels = -200.0;
/// The level shown as black; 0 dB is white.
inline constexpr double blackDecibels = -100.0;

/// Samples |D(s)| at s = stepPerMm (n U + m V), with stepPerMm = 1/(side camera.pixelMm): the
/// frequencies that a frame of this camera transforms, before reconstruction, roll-off, cue and
/// light. It reads the same cells as a frame, with the kernel of the plan, so it shows the spectrum
/// with its interpolation errors. It also samples the corners outside the disc, which a frame
/// omits. Several fields count as their sum, each with the mean of its weights in red, green and
/// blue. *Requires*: side is at least 2; the engine has a field. *Throws* Error{unusable} if the
/// sum is 0 at frequency 0, so that there is no reference level; Error{outOfMemory}; Cancelled.
/// *Source*: Cheng 2007, figures 4.2 to 4.9.
SpectrumSlice spectrumSlice(const EngineParts &engine, const scene::Camera &camera, int side,
                            const task::Progress &progress = {});

/// Grey levels of a slice, linear in decibels: black at `blackDecibels` and below, white at 0 and
/// above. *Shape*: side x side x 4, opaque RGBA.
std::vector<std::uint8_t> greyLevels(const SpectrumSlice &slice);

} // namespace pellucid::render
