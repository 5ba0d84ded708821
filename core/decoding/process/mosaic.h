// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/decoding/client/instance.h"

class DcmItem;

namespace pellucid::decoding::process {

/// Slices that Siemens MR scanners store as tiles of one image, row by row.
struct Mosaic {
    int slices = 0, side = 0; ///< side: tiles along a side of the image
    glm::dvec3 normal{0.0};   ///< direction from slice to slice
};

/// Whether ImageType contains MOSAIC.
bool isMosaic(const InstanceHeader &header);

/// Empty unless ImageType contains MOSAIC and the number of slices is known and fits the image.
/// `header`: that of the whole image, as read.
std::optional<Mosaic> mosaicOf(DcmItem &dataset, const InstanceHeader &header);

/// The same where the number of slices is lost, as some anonymisers remove it: the size of a tile
/// is that of the acquired matrix, and tiles at the end without a sample other than 0 are no
/// slices. `image`: the samples of the whole image; none: as if all tiles were slices.
std::optional<Mosaic> guessedMosaic(DcmItem &dataset, const InstanceHeader &header,
                                    std::span<const std::uint16_t> image);

/// Makes the tiles the frames of a header, each at its position. In the file, positions refer to
/// the corner of the whole image as if it were centred on the tile.
void splitTiles(InstanceHeader &header, const Mosaic &mosaic);

/// The tiles of an image one after the other. *Shape*: rows x columns of a tile.
std::vector<std::uint16_t> tilesOf(std::span<const std::uint16_t> image, const Mosaic &mosaic,
                                   int rows, int columns);

} // namespace pellucid::decoding::process
