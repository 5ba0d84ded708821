// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/write_capture.h"

#include <ctime>
#include <vector>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>
#include <fmt/chrono.h>

#include "core/dcmtk/codecs.h"
#include "core/dicom/reasons.h"
#include "core/dicom/write_dataset.h"
#include "core/system/memory.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::dicom {

namespace {

std::string now(const char *format) {
    char text[32] = {};
    const std::tm local = fmt::localtime(std::time(nullptr)); // std::localtime is for one thread
    std::strftime(text, sizeof text, format, &local);
    return text;
}

bool isGrey(std::span<const std::uint8_t> rgba) {
    for (std::size_t n = 0; n + 3 < rgba.size(); n += 4)
        if (rgba[n] != rgba[n + 1] || rgba[n] != rgba[n + 2])
            return false;
    return true;
}

void append(std::vector<std::uint8_t> &out, std::span<const std::uint8_t> rgba, bool grey) {
    for (std::size_t n = 0; n + 3 < rgba.size(); n += 4) {
        out.push_back(rgba[n]);
        if (!grey)
            out.insert(out.end(), {rgba[n + 1], rgba[n + 2]});
    }
}

// The profile's code (PS3.16, CID 7050).
void putProfile(DcmDataset &d) {
    DcmItem *code = nullptr;
    if (d.findOrCreateSequenceItem(DCM_DeidentificationMethodCodeSequence, code).bad())
        throw task::Error(task::ErrorCode::internal, task::because::profileCannotBeWritten);
    put(*code, DCM_CodeValue, "113100");
    put(*code, DCM_CodingSchemeDesignator, "DCM");
    put(*code, DCM_CodeMeaning, "Basic Application Confidentiality Profile");
}

// Patient and study.
void putIdentity(DcmDataset &d, const CaptureLabels &labels, const char *sopClass) {
    put(d, DCM_SpecificCharacterSet, "ISO_IR 192");
    put(d, DCM_ImageType, "DERIVED\\SECONDARY");
    put(d, DCM_SOPClassUID, sopClass);
    put(d, DCM_SOPInstanceUID,
        !labels.instanceUid.empty() ? labels.instanceUid
        : labels.isDeidentified     ? randomUid()
                                    : newUid(UidKind::instance));
    put(d, DCM_StudyDate, labels.studyDate);
    put(d, DCM_StudyTime, "");
    // The date of the picture would reveal the date of the visit.
    const bool isDated = labels.isDated && !labels.isDeidentified;
    put(d, DCM_ContentDate, isDated ? now("%Y%m%d") : "");
    put(d, DCM_ContentTime, isDated ? now("%H%M%S") : "");
    if (labels.isDeidentified) {
        put(d, DCM_PatientIdentityRemoved, "YES");
        put(d, DCM_DeidentificationMethod, "Attributes of patient and study removed by Pellucid");
        putProfile(d);
        put(d, DCM_LongitudinalTemporalInformationModified, "REMOVED");
    } else {
        put(d, DCM_StudyDescription, labels.studyDescription);
        put(d, DCM_SeriesDescription, labels.seriesDescription);
        put(d, DCM_DerivationDescription, labels.derivation);
        std::string comments = "Not for diagnostic use";
        constexpr std::size_t maxBytes = 10240; // of Long Text
        for (const std::string &warning : labels.warnings)
            if (comments.size() + warning.size() + 2 <= maxBytes)
                comments += "\r\n" + warning;
        put(d, DCM_ImageComments, comments);
    }
    put(d, DCM_AccessionNumber, "");
    put(d, DCM_Modality, "OT");
    put(d, DCM_ConversionType, "WSD");
    put(d, DCM_Manufacturer, "Pellucid");
    put(d, DCM_ReferringPhysicianName, "");
    put(d, DCM_SecondaryCaptureDeviceManufacturer, "Pellucid");
    put(d, DCM_PatientName, labels.patientName);
    put(d, DCM_PatientID, labels.patientId);
    put(d, DCM_PatientBirthDate, labels.birthDate);
    put(d, DCM_PatientSex, labels.sex);
    put(d, DCM_StudyInstanceUID,
        labels.studyUid.empty() ? newUid(UidKind::study) : labels.studyUid);
    put(d, DCM_SeriesInstanceUID, labels.seriesUid.empty() ? newSeriesUid() : labels.seriesUid);
    put(d, DCM_StudyID, "");
    put(d, DCM_SeriesNumber, std::to_string(labels.seriesNumber));
    put(d, DCM_InstanceNumber, std::to_string(labels.instanceNumber));
    put(d, DCM_PatientOrientation, labels.patientOrientation);
    if (labels.positionerDeg) {
        put(d, DCM_PositionerPrimaryAngle, fmt::format("{:.4f}", (*labels.positionerDeg)[0]));
        put(d, DCM_PositionerSecondaryAngle, fmt::format("{:.4f}", (*labels.positionerDeg)[1]));
    }
    put(d, DCM_BurnedInAnnotation, labels.isNamedInPicture ? "YES" : "NO");
}

// *Shape*: of `samples`: frames x height x width x channels, padded to an even length, as DICOM
// requires.
void putPixels(DcmDataset &d, std::span<const std::uint8_t> samples, int height, int width,
               bool grey) {
    d.putAndInsertUint16(DCM_SamplesPerPixel, grey ? 1 : 3);
    put(d, DCM_PhotometricInterpretation, grey ? "MONOCHROME2" : "RGB");
    if (!grey)
        d.putAndInsertUint16(DCM_PlanarConfiguration, 0);
    d.putAndInsertUint16(DCM_Rows, Uint16(height));
    d.putAndInsertUint16(DCM_Columns, Uint16(width));
    d.putAndInsertUint16(DCM_BitsAllocated, 8);
    d.putAndInsertUint16(DCM_BitsStored, 8);
    d.putAndInsertUint16(DCM_HighBit, 7);
    d.putAndInsertUint16(DCM_PixelRepresentation, 0);
    d.putAndInsertUint8Array(DCM_PixelData, samples.data(),
                             static_cast<unsigned long>(samples.size()));
}

} // namespace

CaptureLabels captureLabels(const Selection &s) {
    CaptureLabels labels;
    labels.studyUid = s.study->uid;
    if (!s.volume->volumeFile.empty())
        return labels; // a file has no patient
    labels.patientId = s.patient->id;
    labels.patientName = s.patient->name;
    labels.birthDate = s.patient->birthDate;
    labels.sex = s.patient->sex;
    labels.studyDate = s.study->date;
    labels.studyDescription = s.study->description;
    return labels;
}

CaptureLabels deidentified(const CaptureLabels &labels) {
    CaptureLabels anonymous = labels;
    for (std::string *const text :
         {&anonymous.patientId, &anonymous.patientName, &anonymous.birthDate, &anonymous.sex,
          &anonymous.studyDate, &anonymous.studyDescription})
        text->clear();
    anonymous.warnings.clear(); // some name files
    anonymous.studyUid = randomUid();
    anonymous.seriesUid = randomUid();
    anonymous.isDeidentified = true;
    return anonymous;
}

std::string newSeriesUid() {
    return newUid(UidKind::series);
}

void writeCapture(const std::filesystem::path &path, std::span<const std::uint8_t> rgba, int height,
                  int width, const CaptureLabels &labels) {
    dcmtk::prepareDcmtk();
    DcmFileFormat file;
    DcmDataset &d = *file.getDataset();
    putIdentity(d, labels, UID_SecondaryCaptureImageStorage);
    if (labels.pixelMm > 0.0)
        put(d, DCM_PixelSpacing, decimals({labels.pixelMm, labels.pixelMm}));
    const bool grey = isGrey(rgba);
    std::vector<std::uint8_t> samples;
    samples.reserve(rgba.size() / 4 * (grey ? 1 : 3) + 1);
    append(samples, rgba, grey);
    if (samples.size() % 2 != 0)
        samples.push_back(0);
    putPixels(d, samples, height, width, grey);
    writeDataset(file, EXS_LittleEndianExplicit, path);
}

CaptureLoop::CaptureLoop(int frames, int height, int width, bool isGrey, double frameMs)
    : m_height(height), m_width(width), m_isGrey(isGrey), m_frameMs(frameMs) {
    const std::uint64_t bytes = bytesOf(frames, height, width, isGrey);
    if (2 * bytes > system::availableMemoryBytes()) // the data set has its own copy
        throw task::Error(task::ErrorCode::outOfMemory, task::because::notEnoughMemory);
    m_samples.reserve(bytes + 1);
}

std::uint64_t CaptureLoop::bytesOf(int frames, int height, int width, bool isGrey) {
    return std::uint64_t(frames) * std::uint64_t(height) * std::uint64_t(width) * (isGrey ? 1 : 3);
}

void CaptureLoop::add(std::span<const std::uint8_t> rgba) {
    append(m_samples, rgba, m_isGrey);
    ++m_frames;
}

void CaptureLoop::write(const std::filesystem::path &path, const CaptureLabels &labels) {
    dcmtk::prepareDcmtk();
    DcmFileFormat file;
    DcmDataset &d = *file.getDataset();
    putIdentity(d, labels,
                m_isGrey ? UID_MultiframeGrayscaleByteSecondaryCaptureImageStorage
                         : UID_MultiframeTrueColorSecondaryCaptureImageStorage);
    if (labels.pixelMm > 0.0)
        put(d, DCM_PixelSpacing, decimals({labels.pixelMm, labels.pixelMm}));
    put(d, DCM_NumberOfFrames, std::to_string(m_frames));
    put(d, DCM_FrameTime, decimals({m_frameMs}));
    d.putAndInsertTagKey(DCM_FrameIncrementPointer, DCM_FrameTime);
    if (m_isGrey) {
        put(d, DCM_PresentationLUTShape, "IDENTITY");
        put(d, DCM_RescaleIntercept, "0");
        put(d, DCM_RescaleSlope, "1");
        put(d, DCM_RescaleType, "US");
    }
    if (m_samples.size() % 2 != 0) // room was reserved
        m_samples.push_back(0);
    putPixels(d, m_samples, m_height, m_width, m_isGrey);
    writeDataset(file, EXS_LittleEndianExplicit, path);
}

} // namespace pellucid::dicom
