// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/decoding/client/instance.h"
#include "core/task/reason.h"

namespace pellucid::dicom {

/// Problems with the values of files, and how many files have them: more pixels than the header
/// describes, a rescale slope of 0, and violations of the standard.
std::vector<task::Reason>
warningsOfValues(const std::vector<const decoding::InstanceHeader *> &files);

/// Whether a warning comes from `warningsOfValues`.
bool isValueWarning(const task::Reason &warning);

} // namespace pellucid::dicom
