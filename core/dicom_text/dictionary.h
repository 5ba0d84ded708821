// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::dicom_text {

/// Loads DCMTK's data dictionary, once. Thread-safe. *Throws* Error{internal} if it is missing.
void prepareDictionary();

} // namespace pellucid::dicom_text
