// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dicom/write_capture.h"

namespace pellucid::ui {

class Document;

/// The patient and the study of the open volume, for a DICOM file that is written to its study;
/// empty for phantoms and volume files, which have no patient. *Requires*: a volume is open.
dicom::CaptureLabels studyLabels(const Document &document);

} // namespace pellucid::ui
