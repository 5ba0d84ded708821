// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>

#include "app/cli/input.h"
#include "app/cli/scene_options.h"

namespace pellucid::cli {

/// The options for cue and lights, which do not affect a spectrum.
inline constexpr std::array shadingOptions{"--depth-cue", "--light", "--light-frame", "--ambient"};

/// *Throws* Error{usage} unless the path ends in .png or .npy, or if one of `shadingOptions` is
/// given.
void checkSpectrum(const std::filesystem::path &out, const CLI::App &command);

/// Writes the slice of the spectrum that a view takes: grey levels from 0 to -100 dB (.png) or
/// decibels (.npy), with as many frequencies per side as the longer side of the picture has pixels.
/// `asJson`: prints a report on stdout. *Throws* as openInput, sceneFor, render::spectrumSlice.
void writeSpectrum(const std::filesystem::path &out, const InputOptions &input,
                   const SceneOptions &options, const CLI::App &command, bool asJson,
                   const Context &context);

} // namespace pellucid::cli
