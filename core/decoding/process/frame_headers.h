// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/decoding/client/instance.h"
#include "core/dicom_text/character_sets.h"

class DcmDataset;
class DcmItem;

namespace pellucid::decoding::process {

/// The display windows in an item, each once.
std::vector<volume::ValueWindow> readWindows(DcmItem &item, const dicom_text::CharacterSets &sets);

/// Reads the frames of a data set into its header: position, rescale and dimensions of each, from
/// the top level, the shared functional groups and those of each frame. Windows and the rescale
/// type come from the groups only if the header has none yet. `fileBytes` limits the number of
/// frames: each takes at least one byte.
void readFrames(DcmDataset &dataset, const dicom_text::CharacterSets &sets, std::size_t fileBytes,
                InstanceHeader &header);

} // namespace pellucid::decoding::process
