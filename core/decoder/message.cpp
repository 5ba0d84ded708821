// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoder/message.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>

#include "core/decoder/reasons.h"
#include "core/helper/packing.h"
#include "core/task/error.h"

// In the archives' namespace, where the templates of packing.h find them.
namespace pellucid::helper {

using namespace decoder;

template <class A, glm::length_t N> void pass(A &archive, glm::vec<N, double> &value) {
    for (glm::length_t n = 0; n < N; ++n)
        archive.number(value[n]);
}

template <class A> void pass(A &archive, volume::ValueWindow &window) {
    pass(archive, window.center);
    pass(archive, window.width);
    pass(archive, window.name);
    pass(archive, window.function);
    std::vector<float> curve;
    if (!A::isReading && window.curve)
        curve = *window.curve;
    pass(archive, curve);
    if (A::isReading && !curve.empty())
        window.curve = std::make_shared<const std::vector<float>>(std::move(curve));
}

template <class A> void pass(A &archive, PetHeader &pet) {
    for (std::string *const text :
         {&pet.units, &pet.uptakeType, &pet.decayCorrection, &pet.seriesDate, &pet.seriesTime,
          &pet.acquisitionDate, &pet.acquisitionTime, &pet.injectionTime, &pet.injectionDateTime,
          &pet.timezone, &pet.radionuclide, &pet.corrections})
        pass(archive, *text);
    for (double *const number : {&pet.weightKg, &pet.injectedBq, &pet.halfLifeS,
                                 &pet.uptakePerCount, &pet.frameReferenceS, &pet.frameDurationS})
        pass(archive, *number);
    pass(archive, pet.injections);
    pass(archive, pet.isDynamic);
}

template <class A> void pass(A &archive, FrameHeader &frame) {
    pass(archive, frame.positionMm);
    pass(archive, frame.rowAxis);
    pass(archive, frame.columnAxis);
    pass(archive, frame.spacingMm);
    pass(archive, frame.sliceThicknessMm);
    pass(archive, frame.rescale.slope);
    pass(archive, frame.rescale.intercept);
    pass(archive, frame.rescale.isSlopeZero);
    pass(archive, frame.rescale.isSlopeReadable);
    pass(archive, frame.rescale.isInterceptReadable);
    pass(archive, frame.rescale.isSlopeStated);
    pass(archive, frame.rescale.isInterceptStated);
    pass(archive, frame.segment);
    pass(archive, frame.dimensions);
}

template <class A> void pass(A &archive, InstanceHeader &h) {
    for (std::string *const text :
         {&h.sopClassUid, &h.sopClassName, &h.sopInstanceUid, &h.transferSyntax, &h.patientId,
          &h.patientName, &h.birthDate, &h.sex, &h.studyUid, &h.studyDate, &h.studyDescription,
          &h.seriesUid, &h.seriesDescription, &h.modality, &h.bodyPart, &h.photometric,
          &h.rescaleType, &h.frameOfReferenceUid, &h.unsupportedSyntax})
        pass(archive, *text);
    for (int *const number :
         {&h.seriesNumber, &h.instanceNumber, &h.rows, &h.columns, &h.samplesPerPixel,
          &h.declaredFrames, &h.bitsAllocated, &h.bitsStored, &h.highBit, &h.pixelRepresentation,
          &h.modalityTableFirst, &h.mosaicSide})
        pass(archive, *number);
    pass(archive, h.pixelBytes);
    pass(archive, h.oddities);
    for (bool *const flag : {&h.hasPixels, &h.floatPixels, &h.lossy, &h.hasDamagedPixels})
        pass(archive, *flag);
    pass(archive, h.paddingValue);
    pass(archive, h.paddingLimit);
    pass(archive, h.pet);
    pass(archive, h.isInverse);
    pass(archive, h.spacingPlace);
    pass(archive, h.windows);
    pass(archive, h.modalityTable);
    pass(archive, h.frames);
}

template <class A> void pass(A &archive, DirectoryFile &directory) {
    pass(archive, directory.isDirectory);
    pass(archive, directory.files);
}

template <class A> void pass(A &archive, Attribute &attribute) {
    pass(archive, attribute.depth);
    pass(archive, attribute.tag);
    pass(archive, attribute.vr);
    pass(archive, attribute.name);
    pass(archive, attribute.value);
}

template <class A> void pass(A &archive, AttributeList &list) {
    pass(archive, list.attributes);
    pass(archive, list.isComplete);
}

template <class A> void pass(A &archive, ArchiveFile &file) {
    pass(archive, file.name);
    pass(archive, file.bytes);
    pass(archive, file.isEncrypted);
    pass(archive, file.isLink);
}

template <class A> void pass(A &archive, VolumeLayout &layout) {
    for (int *const number : {&layout.size.i, &layout.size.j, &layout.size.k, &layout.volumes})
        pass(archive, *number);
    pass(archive, layout.originMm);
    for (glm::dvec3 &step : layout.stepsMm)
        pass(archive, step);
    auto scalar = std::int32_t(layout.scalar);
    pass(archive, scalar);
    layout.scalar = StoredScalar(scalar);
    pass(archive, layout.slope);
    pass(archive, layout.intercept);
    pass(archive, layout.isDeflated);
    pass(archive, layout.isSwapped);
    pass(archive, layout.hasPatientSpace);
    pass(archive, layout.segments);
    pass(archive, layout.dataFile);
    pass(archive, layout.at);
    pass(archive, layout.skip);
}

template <class A> void pass(A &archive, CodedConcept &code) {
    for (std::string *const text : {&code.value, &code.scheme, &code.meaning})
        pass(archive, *text);
}

template <class A> void pass(A &archive, SegmentDescription &segment) {
    pass(archive, segment.number);
    pass(archive, segment.label);
    pass(archive, segment.color);
    pass(archive, segment.category);
    pass(archive, segment.type);
}

template <class A> void pass(A &archive, SegmentationHeader &header) {
    pass(archive, header.instance);
    auto kind = std::int32_t(header.kind);
    pass(archive, kind);
    header.kind = SegmentationKind(kind);
    pass(archive, header.largestFraction);
    pass(archive, header.segments);
}

template <class A> void pass(A &archive, Structure &structure) {
    pass(archive, structure.number);
    pass(archive, structure.name);
    pass(archive, structure.color);
    pass(archive, structure.type);
    pass(archive, structure.contourSizes);
    pass(archive, structure.ignoredContours);
}

template <class A> void pass(A &archive, StructureSetHeader &header) {
    pass(archive, header.instance);
    pass(archive, header.structures);
}

} // namespace pellucid::helper

namespace pellucid::decoder {

namespace {

using helper::packed;

[[noreturn]] void fail() {
    throw task::Error(task::ErrorCode::unusable, task::because::implausibleAnswer);
}

template <class T> T unpacked(std::span<const std::byte> body) {
    return helper::unpacked<T>(body, task::because::implausibleAnswer);
}

void requireValid(const volume::ValueWindow &window) {
    using volume::WindowFunction;
    const bool isTable = window.function == WindowFunction::table;
    if (!(window.width > 0.0) || window.function < WindowFunction::linearExact ||
        window.function > WindowFunction::table || isTable != bool(window.curve) ||
        (isTable && (window.curve->size() < 2 || window.curve->size() > 65536 ||
                     std::any_of(window.curve->begin(), window.curve->end(),
                                 [](float grey) { return !(grey >= 0.0F && grey <= 1.0F); }))))
        fail();
}

void requireValid(const InstanceHeader &header) {
    // Ranges that all other code relies on.
    const auto isWithin = [](double value, double most) { return std::abs(value) <= most; };
    const auto isUnit = [](const std::optional<glm::dvec3> &axis) {
        return !axis || std::abs(glm::length(*axis) - 1.0) < 1e-6;
    };
    if (header.frames.empty() || header.frames.size() > maxFrames ||
        header.modalityTable.size() > 65536 || header.windows.size() > 100 ||
        !isWithin(header.modalityTableFirst, 65536) || header.oddities > allOddities ||
        header.mosaicSide < 0 || header.mosaicSide > 100 ||
        !isWithin(header.paddingValue.value_or(0), 65536) ||
        !isWithin(header.paddingLimit.value_or(0), 65536))
        fail();
    if (header.spacingPlace < volume::SpacingPlace::patient ||
        header.spacingPlace > volume::SpacingPlace::calibrated)
        fail();
    for (const volume::ValueWindow &window : header.windows)
        requireValid(window);
    for (const FrameHeader &frame : header.frames) {
        const glm::dvec3 position = frame.positionMm.value_or(glm::dvec3(0.0));
        const glm::dvec2 spacing = frame.spacingMm.value_or(glm::dvec2(1.0));
        if (!isUnit(frame.rowAxis) || !isUnit(frame.columnAxis) ||
            (frame.rowAxis && frame.columnAxis &&
             std::abs(glm::dot(*frame.rowAxis, *frame.columnAxis)) > 1e-6) ||
            glm::length(position) > farthestMm || glm::compMin(spacing) < smallestSpacingMm ||
            glm::compMax(spacing) > largestSpacingMm ||
            !isWithin(frame.rescale.slope, largestRescale) ||
            !isWithin(frame.rescale.intercept, largestRescale) || frame.segment < 0 ||
            frame.segment > 65535)
            fail();
    }
}

void requireValid(const std::optional<glm::dvec3> &color) {
    if (color && !(glm::compMin(*color) >= 0.0 && glm::compMax(*color) <= 1.0))
        fail();
}

// Also checks the segments.
std::set<int> numbersOf(const std::vector<SegmentDescription> &segments) {
    std::set<int> numbers;
    if (segments.size() > maxSegments)
        fail();
    for (const SegmentDescription &segment : segments) {
        if (segment.number < 1 || segment.number > 65535 || !numbers.insert(segment.number).second)
            fail();
        requireValid(segment.color);
    }
    return numbers;
}

} // namespace

std::string pack(const InstanceHeader &header) {
    return packed(header);
}

InstanceHeader unpackHeader(std::span<const std::byte> body) {
    auto header = unpacked<InstanceHeader>(body);
    requireValid(header);
    return header;
}

std::string pack(const SegmentationHeader &header) {
    return packed(header);
}

SegmentationHeader unpackSegmentation(std::span<const std::byte> body) {
    auto header = unpacked<SegmentationHeader>(body);
    requireValid(header.instance);
    if (header.kind < SegmentationKind::binary || header.kind > SegmentationKind::labelMap ||
        header.largestFraction < 1 || header.largestFraction > 65535 || header.segments.empty())
        fail();
    const std::set<int> numbers = numbersOf(header.segments);
    for (const FrameHeader &frame : header.instance.frames)
        if (!frame.positionMm || !frame.rowAxis || !frame.columnAxis || !frame.spacingMm ||
            (header.kind != SegmentationKind::labelMap && !numbers.contains(frame.segment)))
            fail();
    return header;
}

std::string pack(const StructureSetHeader &header) {
    return packed(header);
}

StructureSetHeader unpackStructureSet(std::span<const std::byte> body) {
    auto header = unpacked<StructureSetHeader>(body);
    requireValid(header.instance);
    if (header.structures.empty() || header.structures.size() > maxSegments)
        fail();
    for (const Structure &structure : header.structures) {
        requireValid(structure.color);
        if (structure.ignoredContours < 0)
            fail();
        for (const std::uint32_t points : structure.contourSizes)
            if (points < 3 || points > maxContourPoints)
                fail();
    }
    if (pointCount(header) > maxContourPoints)
        fail();
    return header;
}

std::string pack(const AttributeList &list) {
    return packed(list);
}

AttributeList unpackAttributes(std::span<const std::byte> body) {
    auto list = unpacked<AttributeList>(body);
    if (list.attributes.size() > maxAttributes)
        fail();
    int above = -1; // the depth of the attribute before
    for (Attribute &attribute : list.attributes) {
        if (attribute.depth < 0 || attribute.depth > above + 1 ||
            attribute.depth > maxAttributeDepth)
            fail();
        above = attribute.depth;
        for (std::string *const text : {&attribute.vr, &attribute.name, &attribute.value})
            helper::makeOneLine(*text);
    }
    return list;
}

std::string pack(const DirectoryFile &directory) {
    return packed(directory);
}

DirectoryFile unpackDirectory(std::span<const std::byte> body) {
    return unpacked<DirectoryFile>(body);
}

std::string pack(const std::vector<ArchiveFile> &files) {
    return packed(files);
}

std::vector<ArchiveFile> unpackArchiveFiles(std::span<const std::byte> body) {
    return unpacked<std::vector<ArchiveFile>>(body);
}

std::string pack(const VolumeLayout &layout) {
    return packed(layout);
}

VolumeLayout unpackLayout(std::span<const std::byte> body) {
    const auto layout = unpacked<VolumeLayout>(body);
    const volume::GridSize n = layout.size;
    constexpr std::uint64_t maxSkipped = std::uint64_t(1) << 40;
    if (std::min({n.i, n.j, n.k}) < 1 || layout.volumes < 1 || layout.volumes > maxVolumes ||
        layout.at > maxSkipped || layout.skip > maxSkipped ||
        std::abs(layout.slope) > largestRescale || std::abs(layout.intercept) > largestRescale ||
        layout.slope == 0.0 || layout.scalar < StoredScalar::i8 ||
        layout.scalar > StoredScalar::f64)
        fail();
    for (const glm::dvec3 &step : layout.stepsMm)
        if (!(glm::length(step) >= smallestSpacingMm && glm::length(step) <= largestSpacingMm))
            fail();
    if (!(glm::length(layout.originMm) <= farthestMm))
        fail();
    (void)numbersOf(layout.segments); // checks them
    // Divided, not multiplied: the product of three sizes may wrap.
    if (std::uint64_t(n.i) >
        std::uint64_t(volume::maxSamples) / std::uint64_t(n.j) / std::uint64_t(n.k))
        fail();
    return layout;
}

task::Reason unpackReason(std::span<const std::byte> body) {
    return helper::unpackedReason(body, task::because::implausibleAnswer);
}

} // namespace pellucid::decoder
