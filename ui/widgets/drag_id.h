// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::ui {

/// Edits of one drag carry the same number and merge.
using DragId = int;

/// The number of an edit outside a drag; it never merges.
inline constexpr DragId noDrag = 0;

/// A number that no other drag has.
inline DragId nextDragId() {
    static DragId last = 0;
    return ++last;
}

} // namespace pellucid::ui
