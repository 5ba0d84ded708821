// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/dicom/attribute_columns.h"
#include "core/dicom/stack_geometry.h"

namespace pellucid::dicom {

/// The places of frames along an axis of their planes, as an attribute. Places that differ by a
/// part of a pixel are equal. The label is the middle of the field of view in patient space.
struct PlaceColumn {
    Column column;
    /// Frames of one depth show different parts of the patient, such as two knees: they share less
    /// than half of the field of view. Otherwise it is one part that moves.
    bool isApart = false;
};

/// Columns for the axes along which frames of one depth have different places: rows, columns.
/// *Shape*: sorted by depth.
std::vector<PlaceColumn> placeColumns(const std::vector<PlacedFrame> &sorted);

} // namespace pellucid::dicom
