// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/decoder/instance.h"
#include "core/parse/character_sets.h"

class DcmDataset;
class DcmItem;

namespace pellucid::parse {

/// The display windows that an item states, each once.
std::vector<volume::ValueWindow> readWindows(DcmItem &item, const CharacterSets &sets);

/// Reads the frames of a data set into its header: place, rescale and dimensions of each, from the
/// top of the data set, the groups that frames share, and those of each frame. Windows and the type
/// of the rescale come from the groups only if the header has none yet. `fileBytes` bounds how many
/// frames are believed: each takes a byte at least.
void readFrames(DcmDataset &dataset, const CharacterSets &sets, std::size_t fileBytes,
                decoder::InstanceHeader &header);

} // namespace pellucid::parse
