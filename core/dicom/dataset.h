// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dicom/instance.h"

class DcmDataset;

namespace pellucid::dicom {

/// The header of a loaded dataset. *Throws* Error{unusable} if it is no DICOM object at all.
InstanceHeader headerOf(DcmDataset &dataset);

} // namespace pellucid::dicom
