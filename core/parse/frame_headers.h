// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/decoder/instance.h"
#include "core/parse/character_sets.h"

class DcmDataset;
class DcmItem;

namespace pellucid::parse {

/// The display windows in an item, each once.
std::vector<volume::ValueWindow> readWindows(DcmItem &item, const CharacterSets &sets);

/// Reads the frames of a data set into its header: position, rescale and dimensions of each, from
/// the top level, the shared functional groups and those of each frame. Windows and the rescale
/// type come from the groups only if the header has none yet. `fileBytes` limits the number of
/// frames: each takes at least one byte.
void readFrames(DcmDataset &dataset, const CharacterSets &sets, std::size_t fileBytes,
                decoder::InstanceHeader &header);

} // namespace pellucid::parse
