// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::gpu::bindings {

// The same as shaders/lib/bindings.glsl; a test compares the two.
inline constexpr int frameBlock = 0;
inline constexpr int discRows = 0;
inline constexpr int rotations = 1;
inline constexpr int slice = 2;
inline constexpr int lines = 3;
inline constexpr int tileWidths = 4;
inline constexpr int picture = 0;
inline constexpr int firstSpectrum = 0;
inline constexpr int maxSpectra = 64;
inline constexpr int maxPages = 16;
inline constexpr int maxTerms = 16;
inline constexpr int maxPairs = 4;
inline constexpr int maxPairVectors = 3;
inline constexpr int maxWidth = 7;
inline constexpr int tileColumns = 16;
inline constexpr int tileRows = 16;
inline constexpr int threads = 128;

} // namespace pellucid::gpu::bindings
