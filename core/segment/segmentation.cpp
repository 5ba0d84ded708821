// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/segment/segmentation.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/decoding/client/decoder.h"
#include "core/decoding/client/read_volume_file.h"
#include "core/decoding/client/reasons.h"
#include "core/segment/contour_masks.h"
#include "core/segment/reasons.h"
#include "core/segment/stored_masks.h"
#include "core/system/text.h"
#include "core/task/naming.h"
#include "core/volume/volume_file.h"

namespace pellucid::segment {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using decoding::Decoder;
using decoding::InstanceHeader;
using decoding::SegmentationKind;
using decoding::SegmentDescription;
using task::Error;
using task::ErrorCode;
using task::naming;
using volume::Coverage;
using volume::Lattice;
using volume::Volume;

// A whole set of labels; a volume with more different values is an image.
constexpr int maxLabel = 65535;

void requireSameStudy(const InstanceHeader &header, const volume::VolumeNotes &notes) {
    const auto differ = [](const std::string &a, const std::string &b) {
        return !a.empty() && !b.empty() && a != b;
    };
    if (differ(header.studyUid, notes.studyUid))
        throw Error(ErrorCode::unusable, because::belongsToAnotherStudy);
    if (differ(header.frameOfReferenceUid, notes.frameOfReferenceUid))
        throw Error(ErrorCode::unusable, because::hasAnotherFrameOfReference);
}

Segment segmentOf(const SegmentDescription &described, const std::string &otherwise) {
    Segment segment{
        described.label, described.color, described.category, described.type, {}, 0.0, 0};
    if (segment.name.empty())
        segment.name = described.type.meaning.empty() ? otherwise : described.type.meaning;
    return segment;
}

std::string numbered(int number) {
    return fmt::format("Segment {}", number);
}

// Collects the segments that are in a volume, and the warnings about them.
class Collector {
public:
    explicit Collector(const Volume &volume) : m_lattice(volume.lattice()) {}

    // Returns the name that the segment gets, or nothing if it is outside the volume.
    std::optional<std::string> add(Segment segment, Coverage coverage) {
        if (coverage.isEmpty()) {
            m_outside.push_back(segment.name);
            return std::nullopt;
        }
        segment.name = system::uniqueName(segment.name, m_names);
        segment.volumeMm3 = coverage.total() * m_lattice.cellVolumeMm3();
        static std::atomic<std::uint64_t> next = 1;
        segment.id = next++;
        segment.coverage = std::make_shared<const Coverage>(std::move(coverage));
        m_result.segments.push_back(std::move(segment));
        return m_result.segments.back().name;
    }
    // `farthestMm`: of the pixels from the volume's samples.
    void addMasks(std::vector<Segment> segments, PlacedMasks placed, double farthestMm) {
        if (farthestMm > 0.0)
            warn(because::segmentsBetweenSamples(millimetres(farthestMm)));
        else
            m_isResampled = m_isResampled || placed.isResampled;
        for (std::size_t n = 0; n < segments.size(); ++n)
            add(std::move(segments[n]), std::move(placed.coverages[n]));
    }
    // `betweenSlicesMm`: see FilledContours.
    void addContours(Segment segment, PlacedMasks placed, double betweenSlicesMm) {
        const auto name = add(std::move(segment), std::move(placed.coverages.front()));
        if (!name)
            return;
        m_isResampled = m_isResampled || (placed.isResampled && betweenSlicesMm == 0.0);
        if (betweenSlicesMm > 0.0)
            m_betweenSlices.push_back(*name);
        m_betweenSlicesMm = std::max(m_betweenSlicesMm, betweenSlicesMm);
    }
    void warn(task::Reason warning) { m_result.warnings.push_back(std::move(warning)); }

    Segmentation take(std::string title) {
        if (m_result.segments.empty())
            throw Error(ErrorCode::unusable, because::noSegmentInTheVolume);
        m_result.title = std::move(title);
        if (m_isResampled)
            warn(because::segmentsResampled);
        if (!m_betweenSlices.empty())
            warn(because::contoursBetweenSlices(millimetres(m_betweenSlicesMm), namesBetween()));
        if (m_outside.size() > maxNamed)
            warn(because::segmentsNotInTheVolume(m_outside.size()));
        else
            for (const std::string &name : m_outside)
                warn(because::segmentNotInTheVolume(name));
        return std::move(m_result);
    }

private:
    static constexpr std::size_t maxNamed = 5;

    static std::string millimetres(double value) { return fmt::format("{:.3g}", value); }

    std::string namesBetween() const {
        std::string names;
        for (std::size_t n = 0; n < std::min(maxNamed, m_betweenSlices.size()); ++n)
            names += (n == 0 ? "" : ", ") + m_betweenSlices[n];
        return m_betweenSlices.size() > maxNamed ? names + ", \u2026" : names;
    }

    Lattice m_lattice;
    Segmentation m_result;
    std::set<std::string> m_names;
    std::vector<std::string> m_outside, m_betweenSlices;
    double m_betweenSlicesMm = 0.0;
    bool m_isResampled = false;
};

void addPlaced(const StoredMasks &masks, std::vector<Segment> segments, const Lattice &lattice,
               const task::Progress &progress, Collector &collector) {
    PlacedMasks onLattice = placed(masks, lattice, progress);
    const double farthestMm =
        onLattice.isResampled ? farthestFromSamplesMm(masks, lattice, progress) : 0.0;
    collector.addMasks(std::move(segments), std::move(onLattice), farthestMm);
}

Segmentation loadDicomSegmentation(const fs::path &path, const Volume &volume,
                                   const task::Progress &progress) {
    const decoding::DecodedSegmentation file =
        Decoder::shared().segmentation(path, progress.part(0.0, 0.4));
    const InstanceHeader &header = file.header.instance;
    requireSameStudy(header, volume.notes());
    StoredMasks masks;
    masks.kind = file.header.kind == SegmentationKind::binary       ? StoredMasks::Pixels::bits
                 : file.header.kind == SegmentationKind::fractional ? StoredMasks::Pixels::fractions
                                                                    : StoredMasks::Pixels::labels;
    masks.columns = header.columns;
    masks.rows = header.rows;
    masks.thicknessMm = header.frames.front().sliceThicknessMm;
    masks.pixels = file.pixels;
    masks.largestFraction = file.header.largestFraction;
    std::vector<Segment> segments;
    std::map<int, int> indices;
    masks.segmentOfLabel.assign(maxLabel + 1, -1);
    for (const SegmentDescription &described : file.header.segments) {
        const int index = int(segments.size());
        indices[described.number] = index;
        masks.segmentOfLabel[std::size_t(described.number)] = index;
        segments.push_back(segmentOf(described, numbered(described.number)));
    }
    masks.segments = int(segments.size());
    for (const decoding::FrameHeader &frame : header.frames)
        masks.planes.push_back(
            {*frame.positionMm, *frame.rowAxis * frame.spacingMm->x,
             *frame.columnAxis * frame.spacingMm->y,
             masks.kind == StoredMasks::Pixels::labels ? 0 : indices.at(frame.segment)});
    Collector collector(volume);
    addPlaced(masks, std::move(segments), volume.lattice(), progress.part(0.4, 1.0), collector);
    return collector.take(header.seriesDescription.empty() ? path.stem().string()
                                                           : header.seriesDescription);
}

Segmentation loadStructureSet(const fs::path &path, const Volume &volume,
                              const task::Progress &progress) {
    const decoding::DecodedStructureSet file =
        Decoder::shared().structureSet(path, progress.part(0.0, 0.3));
    requireSameStudy(file.header.instance, volume.notes());
    Collector collector(volume);
    std::span<const glm::dvec3> rest(file.points);
    double done = 0.3;
    int ignored = 0;
    for (const decoding::Structure &structure : file.header.structures) {
        std::vector<std::span<const glm::dvec3>> contours;
        for (const std::uint32_t points : structure.contourSizes) {
            contours.push_back(rest.first(points));
            rest = rest.subspan(points);
        }
        ignored += structure.ignoredContours;
        if (contours.empty())
            continue;
        Segment segment = segmentOf({structure.number, structure.name, structure.color, {}, {}},
                                    numbered(structure.number));
        segment.type.meaning = structure.type;
        const FilledContours planes = filled(contours, volume.lattice(), progress);
        PlacedMasks masks = placed(planes.masks, volume.lattice(), progress.part(done, done));
        collector.addContours(std::move(segment), std::move(masks), planes.betweenSlicesMm);
        done += 0.7 / double(file.header.structures.size());
        progress.report(done);
    }
    if (ignored > 0)
        collector.warn(because::contoursWithoutArea(ignored));
    const std::string &title = file.header.instance.seriesDescription;
    return collector.take(title.empty() ? path.stem().string() : title);
}

// The labels of a volume file as 16-bit numbers. *Throws* Error{unusable} for other values.
std::vector<std::uint16_t> labelsOf(const Volume &labels) {
    std::vector<std::uint16_t> result(labels.lattice().size().count());
    labels.visit([&](auto samples) {
        for (std::size_t n = 0; n < result.size(); ++n) {
            const auto value = double(samples[n]);
            if (!(value >= 0.0 && value <= maxLabel && value == std::floor(value)))
                throw Error(ErrorCode::unusable, because::isNoLabelVolume);
            result[n] = std::uint16_t(value);
        }
    });
    return result;
}

Segmentation loadLabelVolume(const fs::path &path, const Volume &volume,
                             const task::Progress &progress) {
    const decoding::VolumeFileHeader header = decoding::readVolumeFileHeader(path, progress);
    const Volume stored = decoding::readVolumeFile(path, progress.part(0.0, 0.5));
    const Lattice &own = stored.lattice();
    return task::orOutOfMemory(because::noMemoryForTheSegments, [&] {
        const std::vector<std::uint16_t> labels = labelsOf(stored);
        std::vector<bool> isUsed(std::size_t(maxLabel) + 1);
        for (const std::uint16_t label : labels)
            isUsed[label] = true;
        std::map<int, SegmentDescription> described;
        for (const SegmentDescription &segment : header.segments)
            described[segment.number] = segment;
        StoredMasks masks;
        masks.kind = StoredMasks::Pixels::labels;
        masks.columns = own.size().i;
        masks.rows = own.size().j;
        masks.thicknessMm = own.sliceDistanceMm();
        masks.pixels = std::as_bytes(std::span(labels));
        masks.segmentOfLabel.assign(isUsed.size(), -1);
        std::vector<Segment> segments;
        const auto used = std::count(isUsed.begin() + 1, isUsed.end(), true);
        for (int label = 1; label <= maxLabel; ++label) {
            if (!isUsed[std::size_t(label)])
                continue;
            if (segments.size() == decoding::maxSegments)
                throw Error(ErrorCode::unusable, because::isNoLabelVolume);
            masks.segmentOfLabel[std::size_t(label)] = int(segments.size());
            // Programs that write one file for each organ name the file after it.
            segments.push_back(
                segmentOf(described[label], used == 1 ? header.notes.title : numbered(label)));
        }
        if (segments.empty())
            throw Error(ErrorCode::unusable, because::hasNoSegments);
        masks.segments = int(segments.size());
        for (int k = 0; k < own.size().k; ++k)
            masks.planes.push_back(
                {own.patient(volume::VoxelIndex{0, 0, k}).mm, own.step(0), own.step(1), 0});
        Collector collector(volume);
        for (const task::Reason &warning : header.notes.warnings)
            collector.warn(warning);
        addPlaced(masks, std::move(segments), volume.lattice(), progress.part(0.5, 1.0), collector);
        return collector.take(header.notes.title);
    });
}

Segmentation load(const fs::path &path, const Volume &volume, const task::Progress &progress) {
    if (volume::isVolumeFile(path))
        return loadLabelVolume(path, volume, progress);
    const InstanceHeader header = Decoder::shared().header(path, progress);
    if (isSegmentation(header))
        return loadDicomSegmentation(path, volume, progress);
    if (isStructureSet(header))
        return loadStructureSet(path, volume, progress);
    throw Error(ErrorCode::unusable, because::isNoSegmentation);
}

} // namespace

std::vector<std::string> segmentNames(const fs::path &path, const task::Progress &progress) {
    std::vector<std::string> names;
    if (isStructureSet(Decoder::shared().header(path, progress))) {
        for (const decoding::Structure &structure :
             Decoder::shared().structureSet(path, progress).header.structures)
            names.push_back(structure.name.empty() ? numbered(structure.number) : structure.name);
        return names;
    }
    for (const SegmentDescription &described :
         Decoder::shared().segmentation(path, progress).header.segments)
        names.push_back(segmentOf(described, numbered(described.number)).name);
    return names;
}

Segmentation loadSegmentation(const fs::path &path, const Volume &volume,
                              const task::Progress &progress) {
    return naming(path, [&] {
        Segmentation loaded = load(path, volume, progress);
        loaded.path = path;
        return loaded;
    });
}

} // namespace pellucid::segment
