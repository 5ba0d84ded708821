// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "core/dicom/catalogue.h"

namespace pellucid::dicom {

/// Whose picture a Secondary Capture is, and of what.
struct CaptureLabels {
    std::string patientId, patientName, birthDate, sex; ///< as in headers
    std::string studyUid, studyDate, studyDescription;
    /// One for all pictures that belong together; empty: a new one.
    std::string seriesUid;
    std::string seriesDescription = "Projection";
    std::string derivation = "Fourier volume rendering, parallel projection";
    int seriesNumber = 9001, instanceNumber = 1;
    std::string patientOrientation; ///< of rows and columns, "L\F"; may be empty
    double pixelMm = 0.0;           ///< of a pixel in the plane of the picture; 0: not told
    bool isDeidentified = false;    ///< and is marked so
};

/// The same without whose it is: what the Basic Application Level Confidentiality Profile (PS3.15,
/// E.2) removes, empties or replaces of what `writeCapture` writes; UIDs are random ones, which
/// tell neither machine nor time.
CaptureLabels deidentified(const CaptureLabels &labels);

/// Of the study that a volume belongs to.
CaptureLabels captureLabels(const Selection &selection);
/// A series UID for pictures that belong together.
std::string newSeriesUid();

/// Writes a picture as a Secondary Capture Image (PS3.3 A.8.1) in explicit little endian: grey in 8
/// bits where all its pixels are grey, else RGB; marked as derived, without burned-in names, and
/// "Not for diagnostic use". *Shape*: height x width x 4, RGBA, rows from the top; alpha is
/// ignored. The file appears only when complete. *Throws* Error{output}.
void writeCapture(const std::filesystem::path &path, std::span<const std::uint8_t> rgba, int height,
                  int width, const CaptureLabels &labels);

} // namespace pellucid::dicom
