// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/dicom/catalogue.h"

namespace pellucid::dicom {

/// The patient and study of a Secondary Capture, and a description of the picture.
struct CaptureLabels {
    std::string patientId, patientName, birthDate, sex; ///< as in headers
    std::string studyUid, studyDate, studyDescription;
    /// The same for all pictures of one series; empty: a new series.
    std::string seriesUid;
    /// Empty: a new one.
    std::string instanceUid;
    /// Whether the file tells when it was made. Without it, and with given UIDs, two runs write the
    /// same bytes.
    bool isDated = true;
    std::string seriesDescription = "Projection";
    std::string derivation = "Fourier volume rendering, parallel projection";
    /// Warnings about the picture, one per line of its Image Comments.
    std::vector<std::string> warnings;
    int seriesNumber = 9001, instanceNumber = 1;
    std::string patientOrientation; ///< of rows and columns, "L\F"; may be empty
    double pixelMm = 0.0;           ///< in the plane of the picture; 0: unknown
    /// Positioner Primary and Secondary Angle of a projection, degrees; none: not one of a patient.
    std::optional<std::array<double, 2>> positionerDeg;
    bool isDeidentified = false;   ///< the file states it
    bool isNamedInPicture = false; ///< the pixels identify the patient
};

/// The same without identifying attributes: removes, empties or replaces what the Basic Application
/// Level Confidentiality Profile (PS3.15, E.2) requires, as far as `writeCapture` writes it. UIDs
/// become random ones, which reveal neither machine nor time.
CaptureLabels deidentified(const CaptureLabels &labels);

/// The labels of the study that a volume belongs to.
CaptureLabels captureLabels(const Selection &selection);
/// A new series UID.
std::string newSeriesUid();

/// Writes a picture as a Secondary Capture Image (PS3.3 A.8.1) in explicit little endian: 8-bit
/// grey if all its pixels are grey, else RGB; marked as derived and "Not for diagnostic use".
/// *Shape*: height x width x 4, RGBA, rows from the top; alpha is ignored. The file appears only
/// when complete. *Throws* Error{output}.
void writeCapture(const std::filesystem::path &path, std::span<const std::uint8_t> rgba, int height,
                  int width, const CaptureLabels &labels);

/// Collects the frames of a loop for one Multi-frame Secondary Capture Image.
class CaptureLoop {
public:
    /// The most bytes of samples that a loop may have: some readers keep lengths as signed numbers.
    static constexpr std::uint64_t maxBytes = (std::uint64_t(1) << 31) - 2;

    /// `isGrey`: frames are written as 8-bit grey (the red channel), else as RGB. `frameMs`: how
    /// long each is shown. *Throws* Error{outOfMemory}.
    CaptureLoop(int frames, int height, int width, bool isGrey, double frameMs);
    /// The bytes of samples of a loop.
    static std::uint64_t bytesOf(int frames, int height, int width, bool isGrey);

    /// *Shape*: height x width x 4, RGBA, rows from the top; alpha is ignored.
    void add(std::span<const std::uint8_t> rgba);
    /// Writes it in explicit little endian (PS3.3 A.8.3, A.8.5), with the marks of `writeCapture`.
    /// The file appears only when complete. *Throws* Error{output}.
    void write(const std::filesystem::path &path, const CaptureLabels &labels);

private:
    int m_height, m_width, m_frames = 0;
    bool m_isGrey;
    double m_frameMs;
    std::vector<std::uint8_t> m_samples;
};

} // namespace pellucid::dicom
