// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/decoding/client/volume_layout.h"

namespace pellucid::decoding::process {

// Not the readers of teem or ITK: only headers are parsed here, in the confined process, which
// opens no further file. The formats among which `parseVolumeLayout` chooses by the first bytes of
// a file. All *throw* Error{unusable} naming the damaged or unsupported part.
VolumeLayout parseNrrd(std::span<const std::byte> file);
/// `isDeflated`: `header` was inflated from the file.
VolumeLayout parseNifti(std::span<const std::byte> header, bool isDeflated);
VolumeLayout parseMetaImage(std::span<const std::byte> file);

/// Whether a file starts like a NIfTI header, in either byte order.
bool looksLikeNifti(std::span<const std::byte> start);
inline constexpr std::size_t niftiHeaderBytes = 544;

/// A size whose number of samples is valid. *Throws* Error{unusable}.
volume::GridSize gridSize(const std::array<long long, 3> &sizes);
/// Checks that steps and positions make a lattice of a plausible size for a body. *Throws*
/// Error{unusable}.
void requireLattice(const VolumeLayout &layout);

/// The first bytes of gzip data, or fewer if there are not as many.
std::vector<std::byte> inflatedStart(std::span<const std::byte> deflated, std::size_t maxBytes);

std::string trimmed(std::string_view text);

} // namespace pellucid::decoding::process
