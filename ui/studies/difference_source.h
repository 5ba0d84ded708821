// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "ui/studies/study_source.h"

namespace pellucid::ui {

/// Gives the source of this key another description.
using RenameSource = std::function<void(const QString &key, const QString &description)>;

/// The difference of two volumes on the lattice of the first, as a volume of the first one's study.
/// Loading it loads both. `isAligned`: the second is registered first, by rotation and shift.
/// `onLoaded` is called from the thread that loads, with a description that says what the alignment
/// found or why one is needed; it may be empty. *Errors* of the load: those of both loads, of
/// subtraction::registerRigidly, and of subtraction::difference.
StudySource differenceSource(const StudySource &minuend, const StudySource &subtrahend,
                             bool isAligned, RenameSource onLoaded);

} // namespace pellucid::ui
