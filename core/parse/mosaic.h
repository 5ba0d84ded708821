// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/decoder/instance.h"

class DcmItem;

namespace pellucid::parse {

/// Slices that Siemens MR scanners store side by side as tiles of one image, row by row.
struct Mosaic {
    int slices = 0, side = 0; ///< side: tiles along a side of the image
    glm::dvec3 normal{0.0};   ///< direction from slice to slice
};

/// Whether ImageType says MOSAIC.
bool isMosaic(const decoder::InstanceHeader &header);

/// Empty unless ImageType says MOSAIC and the number of slices is known and fits the image.
/// `header`: as read, of the whole image.
std::optional<Mosaic> mosaicOf(DcmItem &dataset, const decoder::InstanceHeader &header);

/// A header whose frames are the tiles, each at its place. Positions are those of the whole image's
/// corner in the file, as if it lay around the tile.
void takeApart(decoder::InstanceHeader &header, const Mosaic &mosaic);

/// The tiles of an image one after the other. *Shape*: rows x columns of a tile.
std::vector<std::uint16_t> tilesOf(std::span<const std::uint16_t> image, const Mosaic &mosaic,
                                   int rows, int columns);

} // namespace pellucid::parse
