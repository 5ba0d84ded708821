// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/volume/volume.h"
#include "tests/support/dicom_writer.h"

namespace pellucid::test {

/// The study, series and frame of reference of what `sliceOf` writes.
inline const std::string knobsRoot = "1.2.826.0.1.3680043.8.498.";

/// A data set of a DICOM segmentation, byte by byte: frames of masks on a lattice, which may be
/// that of the images or another.
struct SegmentationKnobs {
    std::string type = "BINARY"; ///< FRACTIONAL, LABELMAP
    std::vector<std::string> labels{"liver"};
    volume::Lattice lattice;
    /// The stored value of a pixel of a segment (from 1) in a slice. Of a label map: segment 0.
    std::function<int(int segment, int column, int row, int slice)> value;
    /// Changes each frame's groups last.
    std::function<void(DicomWriter &, int segment, int slice)> changeFrame;
};

inline DicomWriter codeItem(const std::string &value, const std::string &meaning) {
    DicomWriter code;
    code.put({0x0008, 0x0100}, "SH", value);
    code.put({0x0008, 0x0102}, "SH", std::string("SCT"));
    code.put({0x0008, 0x0104}, "LO", meaning);
    return code;
}

inline DicomWriter segmentItem(int number, const std::string &label) {
    DicomWriter segment;
    segment.putShort({0x0062, 0x0004}, number);
    segment.put({0x0062, 0x0005}, "LO", label);
    segment.put({0x0062, 0x0008}, "CS", std::string("AUTOMATIC"));
    segment.putSequence({0x0062, 0x0003}, {codeItem("123037004", "Anatomical Structure")});
    segment.putSequence({0x0062, 0x000F}, {codeItem("10200004", label)});
    return segment;
}

inline DicomWriter segmentationFile(const SegmentationKnobs &knobs) {
    const volume::GridSize size = knobs.lattice.size();
    const bool isLabelMap = knobs.type == "LABELMAP", isBinary = knobs.type == "BINARY";
    DicomWriter w;
    w.put(
        {0x0008, 0x0016}, "UI",
        std::string(isLabelMap ? "1.2.840.10008.5.1.4.1.1.66.7" : "1.2.840.10008.5.1.4.1.1.66.4"));
    w.put({0x0008, 0x0018}, "UI", knobsRoot + "9");
    w.put({0x0008, 0x0060}, "CS", std::string("SEG"));
    w.put({0x0008, 0x103E}, "LO", std::string("Organs"));
    w.put({0x0010, 0x0020}, "LO", std::string("knobs"));
    w.put({0x0020, 0x000D}, "UI", knobsRoot + "2");
    w.put({0x0020, 0x000E}, "UI", knobsRoot + "8");
    w.put({0x0020, 0x0052}, "UI", knobsRoot + "4");
    w.putShort({0x0028, 0x0002}, 1);
    w.put({0x0028, 0x0004}, "CS", std::string("MONOCHROME2"));
    w.putShort({0x0028, 0x0010}, size.j);
    w.putShort({0x0028, 0x0011}, size.i);
    const int bits = isBinary ? 1 : isLabelMap ? 16 : 8;
    w.putShort({0x0028, 0x0100}, bits);
    w.putShort({0x0028, 0x0101}, bits);
    w.putShort({0x0028, 0x0102}, bits - 1);
    w.putShort({0x0028, 0x0103}, 0);
    w.put({0x0062, 0x0001}, "CS", knobs.type);
    if (knobs.type == "FRACTIONAL") {
        w.putShort({0x0062, 0x000E}, 200);
        w.put({0x0062, 0x0010}, "CS", std::string("OCCUPANCY"));
    }
    std::vector<DicomWriter> segments;
    for (std::size_t n = 0; n < knobs.labels.size(); ++n)
        segments.push_back(segmentItem(int(n) + 1, knobs.labels[n]));
    w.putSequence({0x0062, 0x0002}, segments);

    const auto unit = [&](int axis) {
        return knobs.lattice.step(axis) / knobs.lattice.spacingMm(axis);
    };
    DicomWriter measures, orientation, shared;
    measures.putNumbers({0x0028, 0x0030}, {knobs.lattice.spacingMm(1), knobs.lattice.spacingMm(0)});
    measures.putNumbers({0x0018, 0x0050}, {knobs.lattice.sliceDistanceMm()});
    orientation.putNumbers({0x0020, 0x0037},
                           {unit(0).x, unit(0).y, unit(0).z, unit(1).x, unit(1).y, unit(1).z});
    shared.putSequence({0x0028, 0x9110}, {measures});
    shared.putSequence({0x0020, 0x9116}, {orientation});
    w.putSequence({0x5200, 0x9229}, {shared});

    std::vector<DicomWriter> frames;
    std::string pixels;
    std::size_t bit = 0;
    for (int segment = isLabelMap ? 0 : 1; segment <= (isLabelMap ? 0 : int(knobs.labels.size()));
         ++segment)
        for (int k = 0; k < size.k; ++k) {
            DicomWriter position, identification, frame;
            const glm::dvec3 at = knobs.lattice.patient(volume::VoxelIndex{0, 0, k}).mm;
            position.putNumbers({0x0020, 0x0032}, {at.x, at.y, at.z});
            frame.putSequence({0x0020, 0x9113}, {position});
            if (!isLabelMap) {
                identification.putShort({0x0062, 0x000B}, segment);
                frame.putSequence({0x0062, 0x000A}, {identification});
            }
            if (knobs.changeFrame)
                knobs.changeFrame(frame, segment, k);
            frames.push_back(frame);
            for (int j = 0; j < size.j; ++j)
                for (int i = 0; i < size.i; ++i) {
                    const int value = knobs.value(segment, i, j, k);
                    if (!isBinary) {
                        pixels += char(value & 0xFF);
                        if (isLabelMap)
                            pixels += char(value >> 8);
                        continue;
                    }
                    if (bit % 8 == 0)
                        pixels += '\0';
                    if (value != 0)
                        pixels.back() = char(std::uint8_t(pixels.back()) | 1U << (bit % 8));
                    ++bit;
                }
        }
    w.put({0x0028, 0x0008}, "IS", std::to_string(frames.size()));
    w.putSequence({0x5200, 0x9230}, frames);
    w.put(DicomWriter::pixelData, isLabelMap ? "OW" : "OB", pixels);
    return w;
}

/// A data set of an RT structure set with closed planar contours.
struct StructureKnobs {
    std::string name = "organ";
    std::vector<std::vector<glm::dvec3>> contours;
};

inline DicomWriter contourItem(const std::vector<glm::dvec3> &points) {
    DicomWriter contour;
    contour.put({0x3006, 0x0042}, "CS", std::string("CLOSED_PLANAR"));
    contour.put({0x3006, 0x0046}, "IS", std::to_string(points.size()));
    std::vector<double> numbers;
    for (const glm::dvec3 &p : points)
        numbers.insert(numbers.end(), {p.x, p.y, p.z});
    contour.putNumbers({0x3006, 0x0050}, numbers);
    return contour;
}

inline DicomWriter structureSetFile(const std::vector<StructureKnobs> &structures) {
    DicomWriter w;
    w.put({0x0008, 0x0016}, "UI", std::string("1.2.840.10008.5.1.4.1.1.481.3"));
    w.put({0x0008, 0x0018}, "UI", knobsRoot + "7");
    w.put({0x0008, 0x0060}, "CS", std::string("RTSTRUCT"));
    w.put({0x0010, 0x0020}, "LO", std::string("knobs"));
    w.put({0x0020, 0x000D}, "UI", knobsRoot + "2");
    w.put({0x0020, 0x000E}, "UI", knobsRoot + "6");
    std::vector<DicomWriter> regions, contours, observations;
    for (std::size_t n = 0; n < structures.size(); ++n) {
        const std::string number = std::to_string(n + 1);
        DicomWriter region, of, observation;
        region.put({0x3006, 0x0022}, "IS", number);
        region.put({0x3006, 0x0024}, "UI", knobsRoot + "4");
        region.put({0x3006, 0x0026}, "LO", structures[n].name);
        of.put({0x3006, 0x0084}, "IS", number);
        of.put({0x3006, 0x002A}, "IS", std::string("255\\128\\0"));
        std::vector<DicomWriter> items;
        for (const auto &points : structures[n].contours)
            items.push_back(contourItem(points));
        of.putSequence({0x3006, 0x0040}, items);
        observation.put({0x3006, 0x0084}, "IS", number);
        observation.put({0x3006, 0x00A4}, "CS", std::string("ORGAN"));
        regions.push_back(region);
        contours.push_back(of);
        observations.push_back(observation);
    }
    w.putSequence({0x3006, 0x0020}, regions);
    w.putSequence({0x3006, 0x0039}, contours);
    w.putSequence({0x3006, 0x0080}, observations);
    return w;
}

/// A volume of the study that the files belong to.
inline volume::Volume volumeOn(const volume::Lattice &lattice) {
    volume::VolumeNotes notes;
    notes.studyUid = knobsRoot + "2";
    notes.frameOfReferenceUid = knobsRoot + "4";
    return volume::Volume(lattice, std::vector<std::int16_t>(lattice.size().count(), 100),
                          volume::ValueUnit::none, notes);
}

inline volume::Lattice tilted(const volume::GridSize &size) {
    return volume::Lattice::make(
        size, {glm::dvec3(-10.0, 20.0, 30.0)},
        {glm::dvec3(0.75, 0.0, 0.0), glm::dvec3(0.0, 0.6, -0.45), glm::dvec3(0.0, 0.0, 2.5)});
}

} // namespace pellucid::test
