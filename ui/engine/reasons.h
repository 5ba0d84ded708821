// SPDX-License-Identifier: GPL-3.0-or-later
/// The sentences of this room.
#pragma once

#include "core/task/reason.h"

namespace pellucid::task::because {

// clang-format off
// Graphics cards and OpenGL
PELLUCID_REASON(processorChosen, "the processor was chosen")
PELLUCID_REASON(cardChosen, "the graphics card was chosen")
PELLUCID_REASON(cardFound, "a graphics card was found")
PELLUCID_REASON(noOpenGl, "OpenGL is not available")
PELLUCID_REASON(oldOpenGl, "OpenGL %1.%2 is too old; showing images needs 3.3")
PELLUCID_REASON(softwareOpenGl, "OpenGL runs on a software renderer")
PELLUCID_REASON(noSecondContext, "a second OpenGL context cannot be created")
PELLUCID_REASON(contextsDoNotShare, "OpenGL contexts cannot share their objects")

// The window
PELLUCID_REASON(noProjectionYet, "there is no projection yet")
PELLUCID_REASON(fieldsNeedMemory, "the look needs %1 MB of memory, more than is available")

// Which engine makes the pictures
PELLUCID_REASON(noMemoryToCopyToCard, "not enough memory to copy to the graphics card")
PELLUCID_REASON(copyWasCancelled, "the copy to the graphics card was cancelled")
PELLUCID_REASON(firstCoarsePicture, "a first, coarse picture")
PELLUCID_REASON(notOnCardYet, "not on the graphics card yet")
PELLUCID_REASON(cardIsBeingPrepared, "the graphics card is being prepared")
// clang-format on

} // namespace pellucid::task::because
