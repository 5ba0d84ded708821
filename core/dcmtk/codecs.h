// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::dcmtk {

/// Loads the data dictionary and registers the codecs, once. Thread-safe. *Throws* Error{internal}
/// if the dictionary is missing.
void prepareDcmtk();

} // namespace pellucid::dcmtk
