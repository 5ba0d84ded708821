// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Scenes, plans and engines
PELLUCID_REASON(gpuEngine, "GPU engine, %1")

// Graphics cards and OpenGL
PELLUCID_REASON(noLibEgl, "libEGL is not installed")
PELLUCID_REASON(cardWasReset, "the graphics card was lost: its driver was reset")
PELLUCID_REASON(cardWasLost, "the graphics card was lost")
PELLUCID_REASON(cardDoesNotAnswer, "the graphics card no longer responds")
PELLUCID_REASON(cardLacksMemory, "the graphics card does not have enough memory for %1")
PELLUCID_REASON(spectraExceedCard, "the spectra need %1 MB, but the graphics card has only %2 MB free")
PELLUCID_REASON(spectrumExceedsTextures, "a spectrum of %1 x %2 x %3 cells is larger than the graphics card's largest texture, %4 a side")
PELLUCID_REASON(imageExceedsCard, "the image covers more cells than the graphics card can count")
PELLUCID_REASON(noLibOpenGl, "libOpenGL is not installed")
PELLUCID_REASON(noContext, "the graphics driver cannot create an OpenGL 3.3 context")
PELLUCID_REASON(noEglDevice, "EGL finds no device")
PELLUCID_REASON(noCard, "no graphics card was found")
PELLUCID_REASON(contextUnusable, "the OpenGL context cannot be used")
PELLUCID_REASON(tooOldOpenGl, "OpenGL %1.%2 (%3) is too old; the GPU engine needs 4.3")
PELLUCID_REASON(openGlError, "OpenGL error %1 (%2)")
PELLUCID_REASON(shaderDoesNotCompile, "shader %1: %2")
PELLUCID_REASON(tooManySpectraForCard, "%1 spectra in %2 textures are more than the graphics card can read at once")
PELLUCID_REASON(sliceExceedsCard, "the slice of this image, %1 x %2 cells, needs %3 MB in one piece; the graphics card allows %4 MB (larger pixels need fewer cells)")
PELLUCID_REASON(imageExceedsTextures, "an image of %1 x %2 pixels is larger than the graphics card's largest texture, %3 x %3")
// clang-format on

} // namespace pellucid::task::because
