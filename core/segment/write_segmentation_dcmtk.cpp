// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/segment/write_segmentation.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmfg/fgfracon.h>
#include <dcmtk/dcmfg/fgpixmsr.h>
#include <dcmtk/dcmfg/fgplanor.h>
#include <dcmtk/dcmfg/fgplanpo.h>
#include <dcmtk/dcmiod/cielabutil.h>
#include <dcmtk/dcmseg/segdoc.h>
#include <dcmtk/dcmseg/segment.h>

#include <fmt/format.h>

#include "core/dcmtk/codecs.h"
#include "core/decoding/client/reasons.h"
#include "core/dicom/write_dataset.h"
#include "core/segment/reasons.h"
#include "core/system/memory.h"
#include "core/task/error.h"
#include "core/volume/nrrd.h"
#include "core/volume/reasons.h"

namespace pellucid::segment {

namespace {

namespace because = task::because;
using dicom::decimal;
using dicom::decimals;
using task::Error;
using task::ErrorCode;
using volume::Coverage;
using volume::GridSize;
using volume::Lattice;

void require(const OFCondition &done) {
    if (done.bad())
        throw Error(ErrorCode::internal, because::segmentationNotWritten(done.text()));
}

// Terms for a segment without codes (PS3.16, CID 7150 and 7151).
const decoding::CodedConcept otherCategory{"85756007", "SCT", "Tissue"};

bool isComplete(const decoding::CodedConcept &code) {
    return !code.value.empty() && !code.scheme.empty() && !code.meaning.empty();
}

const decoding::CodedConcept &orOther(const decoding::CodedConcept &code) {
    return isComplete(code) ? code : otherCategory;
}

CodeSequenceMacro codeOf(const decoding::CodedConcept &given) {
    const decoding::CodedConcept &code = orOther(given);
    return {code.value.c_str(), code.scheme.c_str(), "-"}; // the meaning follows, see putTexts
}

// A text of a limited length (LO: 64 characters), not cut within a character of UTF-8, and without
// the character that separates values.
std::string shortText(std::string text) {
    constexpr std::size_t longest = 64;
    std::replace(text.begin(), text.end(), '\\', '/');
    std::size_t characters = 0, end = 0;
    while (end < text.size() && characters < longest) {
        ++characters;
        do
            ++end;
        while (end < text.size() && (text[end] & 0xC0) == 0x80);
    }
    text.resize(end);
    return text;
}

bool isBinary(const std::vector<Segment> &segments) {
    return std::all_of(segments.begin(), segments.end(), [](const Segment &segment) {
        return std::all_of(
            segment.coverage->shares.begin(), segment.coverage->shares.end(),
            [](std::uint8_t share) { return share == 0 || share == Coverage::whole; });
    });
}

// Collects segments and frames in DCMTK's object.
class Writer {
public:
    Writer(const Lattice &lattice, const SegmentationLabels &labels, bool isBinary)
        : m_lattice(lattice), m_size(lattice.size()), m_labels(labels) {
        const IODGeneralEquipmentModule::EquipmentInfo equipment("Pellucid", "Pellucid", "1", "1");
        ContentIdentificationMacro content("1", "SEGMENTATION", "", "");
        DcmSegmentation *made = nullptr;
        const auto rows = Uint16(m_size.j), columns = Uint16(m_size.i);
        require(isBinary ? DcmSegmentation::createBinarySegmentation(made, rows, columns, equipment,
                                                                     content)
                         : DcmSegmentation::createFractionalSegmentation(
                               made, rows, columns, DcmSegTypes::SFT_OCCUPANCY, Coverage::whole,
                               equipment, content));
        m_document.reset(made);
        putIdentity();
        putGeometry();
    }

    void add(const Segment &segment, const task::Progress &progress) {
        DcmSegment *made = nullptr;
        require(DcmSegment::create(made, "segment", codeOf(segment.category), codeOf(segment.type),
                                   DcmSegTypes::SAT_SEMIAUTOMATIC, "Pellucid"));
        if (segment.color) {
            double l = 0.0, a = 0.0, b = 0.0;
            IODCIELabUtil::rgb2DicomLab(l, a, b, segment.color->x, segment.color->y,
                                        segment.color->z);
            const auto rounded = [](double v) {
                return Uint16(std::lround(std::clamp(v, 0.0, 65535.0)));
            };
            require(made->setRecommendedDisplayCIELabValue(rounded(l), rounded(a), rounded(b)));
        }
        m_texts.push_back({shortText(segment.name), shortText(orOther(segment.category).meaning),
                           shortText(orOther(segment.type).meaning)});
        Uint16 number = 0;
        require(m_document->addSegment(made, number));
        const Coverage &coverage = *segment.coverage;
        std::vector<Uint8> frame(m_size.offsetOf(0, 0, 1));
        for (int k = coverage.box.lo.k; k < coverage.box.hi.k; ++k) {
            progress.check();
            if (fill(frame, coverage, k))
                addFrame(frame, number, k);
        }
    }

    void write(const std::filesystem::path &path) {
        // The structure is checked by writing; checking each frame's groups takes as long again.
        m_document->setCheckFGOnWrite(OFFalse);
        DcmFileFormat file;
        DcmDataset &d = *file.getDataset();
        require(m_document->writeDataset(d));
        putTexts(d);
        dicom::writeDataset(file, EXS_LittleEndianExplicit, path);
    }

private:
    void putIdentity() {
        const dicom::CaptureLabels &study = m_labels.study;
        require(m_document->getSOPCommon().setSpecificCharacterSet("ISO_IR 192"));
        IODGeneralStudyModule &general = m_document->getStudy();
        const std::string uid =
            study.studyUid.empty() ? dicom::newUid(dicom::UidKind::study) : study.studyUid;
        require(general.setStudyInstanceUID(uid.c_str(), OFFalse));
        require(m_document->getSeries().setSeriesNumber(std::to_string(seriesNumber).c_str()));
        const std::string frame = m_labels.frameOfReferenceUid.empty()
                                      ? dicom::newUid(dicom::UidKind::series)
                                      : m_labels.frameOfReferenceUid;
        require(m_document->getFrameOfReference().setFrameOfReferenceUID(frame.c_str(), OFFalse));
    }

    // DCMTK's object refuses letters beyond ASCII, whatever the character set: texts are written
    // into its data set.
    void putTexts(DcmDataset &d) const {
        const dicom::CaptureLabels &study = m_labels.study;
        dicom::put(d, DCM_PatientName, study.patientName);
        dicom::put(d, DCM_PatientID, study.patientId);
        dicom::put(d, DCM_PatientBirthDate, study.birthDate);
        dicom::put(d, DCM_PatientSex, study.sex);
        dicom::put(d, DCM_StudyDate, study.studyDate);
        if (!study.studyDescription.empty())
            dicom::put(d, DCM_StudyDescription, study.studyDescription);
        dicom::put(d, DCM_SeriesDescription, shortText(m_labels.seriesDescription));
        for (std::size_t n = 0; n < m_texts.size(); ++n) {
            DcmItem *segment = nullptr;
            require(d.findAndGetSequenceItem(DCM_SegmentSequence, segment, long(n)));
            dicom::put(*segment, DCM_SegmentLabel, m_texts[n].name);
            putMeaning(*segment, DCM_SegmentedPropertyCategoryCodeSequence, m_texts[n].category);
            putMeaning(*segment, DCM_SegmentedPropertyTypeCodeSequence, m_texts[n].type);
        }
    }

    static void putMeaning(DcmItem &segment, const DcmTagKey &sequence,
                           const std::string &meaning) {
        DcmItem *code = nullptr;
        require(segment.findAndGetSequenceItem(sequence, code));
        dicom::put(*code, DCM_CodeMeaning, meaning);
    }

    // Writes what all frames share, and what distinguishes each.
    void putGeometry() {
        FGPixelMeasures measures;
        require(measures.setPixelSpacing(
            decimals({m_lattice.spacingMm(1), m_lattice.spacingMm(0)}).c_str()));
        require(measures.setSliceThickness(decimal(m_lattice.sliceDistanceMm()).c_str()));
        require(measures.setSpacingBetweenSlices(decimal(m_lattice.sliceDistanceMm()).c_str()));
        require(m_document->addForAllFrames(measures));
        const glm::dvec3 row = m_lattice.step(0) / m_lattice.spacingMm(0),
                         column = m_lattice.step(1) / m_lattice.spacingMm(1);
        FGPlaneOrientationPatient orientation;
        require(orientation.setImageOrientationPatient(
            decimal(row.x).c_str(), decimal(row.y).c_str(), decimal(row.z).c_str(),
            decimal(column.x).c_str(), decimal(column.y).c_str(), decimal(column.z).c_str()));
        require(m_document->addForAllFrames(orientation));
        IODMultiframeDimensionModule &dimensions = m_document->getDimensions();
        const std::string organization = dicom::newUid(dicom::UidKind::instance);
        require(dimensions.addDimensionIndex(DCM_ReferencedSegmentNumber, organization.c_str(),
                                             DCM_SegmentIdentificationSequence,
                                             "ReferencedSegmentNumber"));
        require(dimensions.addDimensionIndex(DCM_ImagePositionPatient, organization.c_str(),
                                             DCM_PlanePositionSequence, "ImagePositionPatient"));
    }

    // The shares in a slice. False if all are 0.
    bool fill(std::vector<Uint8> &frame, const Coverage &coverage, int k) const {
        std::fill(frame.begin(), frame.end(), Uint8(0));
        bool hasSome = false;
        const volume::VoxelBox &box = coverage.box;
        for (int j = box.lo.j; j < box.hi.j; ++j) {
            const std::uint8_t *const from =
                coverage.shares.data() + coverage.offsetOf({box.lo.i, j, k});
            std::copy_n(from, box.size().i,
                        frame.begin() + std::ptrdiff_t(m_size.offsetOf(box.lo.i, j, 0)));
            hasSome = hasSome || std::any_of(from, from + box.size().i,
                                             [](std::uint8_t share) { return share != 0; });
        }
        return hasSome;
    }

    void addFrame(std::vector<Uint8> &frame, Uint16 number, int k) {
        const glm::dvec3 at = m_lattice.patient(volume::VoxelIndex{0, 0, k}).mm;
        FGPlanePosPatient position;
        require(position.setImagePositionPatient(decimal(at.x).c_str(), decimal(at.y).c_str(),
                                                 decimal(at.z).c_str()));
        FGFrameContent content;
        require(content.setDimensionIndexValues(number, 0));
        require(content.setDimensionIndexValues(Uint32(k) + 1, 1));
        OFVector<FGBase *> groups;
        groups.push_back(&position);
        groups.push_back(&content);
        require(m_document->addFrame(frame.data(), number, groups));
    }

    static constexpr int seriesNumber = 9002;

    const Lattice &m_lattice;
    GridSize m_size;
    const SegmentationLabels &m_labels;
    struct Texts {
        std::string name, category, type;
    };
    std::vector<Texts> m_texts; ///< of the segments
    std::unique_ptr<DcmSegmentation> m_document;
};

} // namespace

void writeSegmentation(const std::filesystem::path &path, const std::vector<Segment> &segments,
                       const Lattice &lattice, const SegmentationLabels &labels,
                       const task::Progress &progress) {
    if (std::max(lattice.size().i, lattice.size().j) > 65535)
        throw Error(ErrorCode::usage, because::hasATooLargeImage, path);
    constexpr double largestShear = 1e-3; // of the axes of a frame, which DICOM takes as orthogonal
    if (std::abs(glm::dot(lattice.step(0) / lattice.spacingMm(0),
                          lattice.step(1) / lattice.spacingMm(1))) > largestShear)
        throw Error(ErrorCode::usage, because::planesNotAtRightAngles, path);
    std::size_t frames = 0;
    for (const Segment &segment : segments)
        frames += std::size_t(segment.coverage->box.size().k);
    if (frames > decoding::maxFrames)
        throw Error(ErrorCode::usage, because::needsTooManyFrames(frames, decoding::maxFrames),
                    path);
    const bool areBits = isBinary(segments);
    // DCMTK holds the frames twice while it writes.
    system::requireMemory(2.0 * double(frames) * double(lattice.size().offsetOf(0, 0, 1)) /
                          (areBits ? 8.0 : 1.0));
    dcmtk::prepareDcmtk();
    Writer writer(lattice, labels, areBits);
    for (std::size_t n = 0; n < segments.size(); ++n) {
        writer.add(segments[n], progress);
        progress.report(0.9 * double(n + 1) / double(segments.size()));
    }
    writer.write(path);
}

std::vector<std::size_t> writeLabels(const std::filesystem::path &path,
                                     const std::vector<Segment> &segments, const Lattice &lattice,
                                     const task::Progress &progress) {
    const GridSize size = lattice.size();
    std::vector<std::int16_t> labels(size.count());
    std::vector<std::pair<std::string, std::string>> names;
    std::vector<std::size_t> counts(segments.size());
    for (std::size_t n = 0; n < segments.size(); ++n) {
        progress.check();
        const Segment &segment = segments[n];
        const Coverage &coverage = *segment.coverage;
        const volume::VoxelBox &box = coverage.box;
        for (int k = box.lo.k; k < box.hi.k; ++k)
            for (int j = box.lo.j; j < box.hi.j; ++j)
                for (int i = box.lo.i; i < box.hi.i; ++i) {
                    if (2 * coverage.at({i, j, k}) < Coverage::whole)
                        continue;
                    std::int16_t &label = labels[size.offsetOf(i, j, k)];
                    if (label != 0)
                        throw Error(ErrorCode::usage,
                                    because::segmentsOverlap(segments[std::size_t(label) - 1].name,
                                                             segment.name),
                                    path);
                    label = std::int16_t(n + 1);
                    ++counts[n];
                }
        const std::string key = fmt::format("Segment{}_", n);
        names.emplace_back(key + "ID", fmt::format("Segment_{}", n + 1));
        names.emplace_back(key + "Name", segment.name);
        names.emplace_back(key + "LabelValue", std::to_string(n + 1));
        names.emplace_back(key + "Layer", "0");
        if (const auto &c = segment.color)
            names.emplace_back(key + "Color",
                               fmt::format("{:.6g} {:.6g} {:.6g}", c->x, c->y, c->z));
    }
    volume::writeNrrd(path, volume::Volume(lattice, std::move(labels), volume::ValueUnit::none),
                      volume::NrrdEncoding::gzip, progress, names);
    return counts;
}

} // namespace pellucid::segment
