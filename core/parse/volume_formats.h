// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/decoder/volume_layout.h"

namespace pellucid::parse {

using decoder::StoredScalar;
using decoder::VolumeLayout;

// The formats that `parseVolumeLayout` tells apart by how files begin. All *throw* Error{unusable}
// naming what is damaged or not supported.
VolumeLayout parseNrrd(std::span<const std::byte> file);
/// `isDeflated`: `header` was inflated out of the file.
VolumeLayout parseNifti(std::span<const std::byte> header, bool isDeflated);
VolumeLayout parseMetaImage(std::span<const std::byte> file);

/// Whether a file begins as a NIfTI header does, in either byte order.
bool looksLikeNifti(std::span<const std::byte> start);
inline constexpr std::size_t niftiHeaderBytes = 544;

/// A size whose samples can be counted. *Throws* Error{unusable}.
volume::GridSize gridSize(const std::array<long long, 3> &sizes);
/// That a lattice can be made of it, of steps and places as bodies have. *Throws* Error{unusable}.
void requireLattice(const VolumeLayout &layout);

/// The first bytes of what is deflated as gzip does; fewer if there are fewer.
std::vector<std::byte> inflatedStart(std::span<const std::byte> deflated, std::size_t most);

std::string trimmed(std::string_view text);

} // namespace pellucid::parse
