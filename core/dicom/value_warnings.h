// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/decoder/instance.h"
#include "core/task/reason.h"

namespace pellucid::dicom {

/// What is wrong with the values of files, and how many files have it: pixels beyond those that the
/// header describes, a rescale slope of 0, and what the standard forbids.
std::vector<task::Reason>
warningsOfValues(const std::vector<const decoder::InstanceHeader *> &files);

/// Whether a warning is one of those.
bool isOfValues(const task::Reason &warning);

} // namespace pellucid::dicom
