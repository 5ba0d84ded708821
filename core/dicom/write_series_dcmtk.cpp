// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/write_series.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <mutex>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmjpeg/djrplol.h>
#include <dcmtk/dcmjpls/djrparam.h>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/dcmtk/codecs.h"
#include "core/dcmtk/encode_jpeg2000.h"
#include "core/dicom/reasons.h"
#include "core/dicom/write_dataset.h"
#include "core/files/reasons.h"
#include "core/task/error.h"

namespace pellucid::dicom {

namespace {

namespace fs = std::filesystem;
namespace because = task::because;
using task::Error;
using task::ErrorCode;

struct Syntax {
    const char *name;
    E_TransferSyntax transfer;
};

const std::array<Syntax, 8> &syntaxes() {
    static const std::array<Syntax, 8> all{{
        {"implicit", EXS_LittleEndianImplicit},
        {"explicit", EXS_LittleEndianExplicit},
        {"big-endian", EXS_BigEndianExplicit},
        {"deflated", EXS_DeflatedLittleEndianExplicit},
        {"rle", EXS_RLELossless},
        {"jpeg-lossless", EXS_JPEGProcess14SV1},
        {"jpeg-ls", EXS_JPEGLSLossless},
        {"jpeg-2000", EXS_JPEG2000LosslessOnly},
    }};
    return all;
}

// Converts uncompressed pixels to a JPEG 2000 codestream, which DCMTK cannot write.
void compressJpeg2000(DcmDataset &dataset, const std::int16_t *slice, volume::GridSize size) {
    const dcmtk::Jpeg2000Image image{
        size.j, size.i, 16, true,
        std::vector<std::int32_t>(slice, slice + std::size_t(size.i) * size.j)};
    std::vector<std::byte> stream = dcmtk::encodeJpeg2000(image);
    auto *sequence = new DcmPixelSequence(DCM_PixelSequenceTag);
    auto *offsets = new DcmPixelItem(DCM_PixelItemTag);
    sequence->insert(offsets);
    DcmOffsetList fragments;
    sequence->storeCompressedFrame(fragments, reinterpret_cast<Uint8 *>(stream.data()),
                                   Uint32(stream.size()), 0);
    offsets->createOffsetTable(fragments);
    auto *pixels = new DcmPixelData(DCM_PixelData);
    pixels->putOriginalRepresentation(EXS_JPEG2000LosslessOnly, nullptr, sequence);
    dataset.insert(pixels, OFTrue);
}

class SeriesWriter {
public:
    SeriesWriter(const volume::Volume &volume, const SeriesLabels &labels, TransferSyntax syntax)
        : m_volume(volume), m_labels(labels), m_syntax(syntaxes()[std::size_t(syntax)].transfer),
          m_study(newUid(UidKind::study)), m_series(newUid(UidKind::series)),
          m_frame(newUid(UidKind::series)) {}

    void write(int slice, const std::int16_t *samples, const fs::path &path) const {
        DcmFileFormat file;
        DcmDataset &d = *file.getDataset();
        putIdentity(d, slice);
        putPosition(d, slice);
        putValues(d);
        if (m_syntax == EXS_JPEG2000LosslessOnly) {
            compressJpeg2000(d, samples, m_volume.lattice().size());
        } else {
            d.putAndInsertUint16Array(
                DCM_PixelData, reinterpret_cast<const Uint16 *>(samples),
                static_cast<unsigned long>(m_volume.lattice().size().offsetOf(0, 0, 1)));
            compress(d);
        }
        writeDataset(file, m_syntax, path);
    }

private:
    // Patient, study and series.
    void putIdentity(DcmDataset &d, int slice) const {
        put(d, DCM_SpecificCharacterSet, "ISO_IR 192");
        put(d, DCM_ImageType, "ORIGINAL\\PRIMARY\\AXIAL");
        put(d, DCM_SOPClassUID, UID_CTImageStorage);
        put(d, DCM_SOPInstanceUID, newUid(UidKind::instance));
        put(d, DCM_StudyDate, "20260101");
        put(d, DCM_StudyTime, "120000");
        put(d, DCM_AccessionNumber, "");
        put(d, DCM_Modality, "CT");
        put(d, DCM_Manufacturer, "Pellucid");
        put(d, DCM_ReferringPhysicianName, "");
        put(d, DCM_StudyDescription, m_labels.studyDescription);
        put(d, DCM_SeriesDescription, m_labels.seriesDescription);
        put(d, DCM_PatientName, m_labels.patientName);
        put(d, DCM_PatientID, m_labels.patientId);
        put(d, DCM_PatientBirthDate, "");
        put(d, DCM_PatientSex, "O");
        put(d, DCM_BodyPartExamined, m_labels.bodyPart);
        put(d, DCM_KVP, "");
        put(d, DCM_StudyInstanceUID, m_study);
        put(d, DCM_SeriesInstanceUID, m_series);
        put(d, DCM_StudyID, "1");
        put(d, DCM_SeriesNumber, std::to_string(m_labels.seriesNumber));
        put(d, DCM_AcquisitionNumber, "1");
        put(d, DCM_InstanceNumber, std::to_string(slice + 1));
    }

    // The position of the slice.
    void putPosition(DcmDataset &d, int slice) const {
        const volume::Lattice &lattice = m_volume.lattice();
        const glm::dvec3 position = lattice.patient(volume::VoxelIndex{0, 0, slice}).mm;
        const glm::dvec3 row = lattice.step(0) / lattice.spacingMm(0),
                         column = lattice.step(1) / lattice.spacingMm(1);
        put(d, DCM_ImagePositionPatient, decimals({position.x, position.y, position.z}));
        put(d, DCM_ImageOrientationPatient,
            decimals({row.x, row.y, row.z, column.x, column.y, column.z}));
        put(d, DCM_FrameOfReferenceUID, m_frame);
        put(d, DCM_PositionReferenceIndicator, "");
        put(d, DCM_PixelSpacing, decimals({lattice.spacingMm(1), lattice.spacingMm(0)}));
        put(d, DCM_SliceThickness, decimal(lattice.sliceDistanceMm()));
    }

    // The storage and display of its values.
    void putValues(DcmDataset &d) const {
        const volume::GridSize size = m_volume.lattice().size();
        d.putAndInsertUint16(DCM_SamplesPerPixel, 1);
        put(d, DCM_PhotometricInterpretation, "MONOCHROME2");
        d.putAndInsertUint16(DCM_Rows, Uint16(size.j));
        d.putAndInsertUint16(DCM_Columns, Uint16(size.i));
        d.putAndInsertUint16(DCM_BitsAllocated, 16);
        d.putAndInsertUint16(DCM_BitsStored, 16);
        d.putAndInsertUint16(DCM_HighBit, 15);
        d.putAndInsertUint16(DCM_PixelRepresentation, 1);
        std::string centers, widths;
        for (const volume::ValueWindow &window : m_labels.windows) {
            centers += (centers.empty() ? "" : "\\") + decimal(window.center);
            widths += (widths.empty() ? "" : "\\") + decimal(window.width);
        }
        if (!centers.empty()) {
            put(d, DCM_WindowCenter, centers);
            put(d, DCM_WindowWidth, widths);
        }
        put(d, DCM_RescaleIntercept, "0");
        put(d, DCM_RescaleSlope, "1");
        put(d, DCM_RescaleType, "HU");
    }

    void compress(DcmDataset &d) const {
        OFCondition done = EC_Normal;
        if (m_syntax == EXS_JPEGProcess14SV1) {
            const DJ_RPLossless parameters;
            done = d.chooseRepresentation(m_syntax, &parameters);
        } else if (m_syntax == EXS_JPEGLSLossless) {
            const DJLSRepresentationParameter parameters;
            done = d.chooseRepresentation(m_syntax, &parameters);
        } else if (m_syntax == EXS_RLELossless) {
            done = d.chooseRepresentation(m_syntax, nullptr);
        }
        if (done.bad())
            throw Error(ErrorCode::internal, because::compressionFailed(done.text()));
    }

    const volume::Volume &m_volume;
    const SeriesLabels &m_labels;
    E_TransferSyntax m_syntax;
    std::string m_study, m_series, m_frame;
};

} // namespace

TransferSyntax transferSyntaxFromName(const std::string &name) {
    std::string known;
    for (std::size_t n = 0; n < syntaxes().size(); ++n) {
        if (name == syntaxes()[n].name || name == DcmXfer(syntaxes()[n].transfer).getXferID())
            return TransferSyntax(n);
        known += std::string(known.empty() ? "" : ", ") + syntaxes()[n].name;
    }
    throw Error(ErrorCode::usage, because::unknownTransferSyntax(name, known));
}

std::vector<std::string> transferSyntaxNames() {
    std::vector<std::string> names;
    for (const Syntax &s : syntaxes())
        names.emplace_back(s.name);
    return names;
}

void writeCtSeries(const fs::path &folder, const volume::Volume &volume, const SeriesLabels &labels,
                   TransferSyntax syntax, const task::Progress &progress) {
    dcmtk::prepareDcmtk();
    if (volume.isFloat())
        throw Error(ErrorCode::usage, because::onlyWholeHuAreCt);
    std::error_code error;
    const bool made = fs::create_directories(folder, error);
    if (error)
        throw Error(ErrorCode::output, because::cannotBeMade(task::systemReason(error)), folder);
    const SeriesWriter writer(volume, labels, syntax);
    const volume::GridSize size = volume.lattice().size();
    std::vector<fs::path> paths;
    for (int k = 0; k < size.k; ++k)
        paths.push_back(folder / fmt::format("IM{:04d}.dcm", k + 1));
    for (const fs::path &path : paths)
        if (fs::exists(fs::symlink_status(path, error)))
            throw Error(ErrorCode::output, because::existsAlready, path);
    std::mutex guard;
    int done = 0;
    std::vector<fs::path> written;
    const auto writeSlice = [&](int k, const std::int16_t *slice) {
        progress.check();
        writer.write(k, slice, paths[std::size_t(k)]);
        const std::lock_guard lock(guard);
        written.push_back(paths[std::size_t(k)]);
        progress.report(double(++done) / size.k);
    };
    try {
        volume.visit([&](auto samples) {
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(samples[0])>, std::int16_t>)
                tbb::parallel_for(0, size.k, [&](int k) {
                    writeSlice(k, samples.data() + size.offsetOf(0, 0, k));
                });
        });
    } catch (...) {
        for (const fs::path &path : written)
            fs::remove(path, error);
        if (made)
            fs::remove(folder, error);
        throw;
    }
}

} // namespace pellucid::dicom
