// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/client/message.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>

#include "core/confined/packing.h"
#include "core/decoding/client/reasons.h"
#include "core/task/error.h"

// In the archives' namespace, where the templates of packing.h find them.
namespace pellucid::confined {

using namespace decoding;

template <class A, glm::length_t N> void pass(A &archive, glm::vec<N, double> &value) {
    for (glm::length_t n = 0; n < N; ++n)
        archive.number(value[n]);
}

template <class A> void pass(A &archive, volume::ValueWindow &window) {
    passAll(archive, window.center, window.width, window.name, window.isInverted, window.function);
    std::vector<float> curve;
    if (!A::isReading && window.curve)
        curve = *window.curve;
    pass(archive, curve);
    if (A::isReading && !curve.empty())
        window.curve = std::make_shared<const std::vector<float>>(std::move(curve));
}

template <class A> void pass(A &archive, PetHeader &pet) {
    passAll(archive, pet.units, pet.uptakeType, pet.decayCorrection, pet.seriesDate, pet.seriesTime,
            pet.acquisitionDate, pet.acquisitionTime, pet.injectionTime, pet.injectionDateTime,
            pet.timezone, pet.radionuclide, pet.corrections, pet.weightKg, pet.injectedBq,
            pet.halfLifeS, pet.uptakePerCount, pet.frameReferenceS, pet.frameDurationS,
            pet.injections, pet.isDynamic);
}

template <class A> void pass(A &archive, FrameHeader &frame) {
    passAll(archive, frame.positionMm, frame.rowAxis, frame.columnAxis, frame.spacingMm,
            frame.sliceThicknessMm, frame.rescale.slope, frame.rescale.intercept,
            frame.rescale.isSlopeZero, frame.rescale.isSlopeReadable,
            frame.rescale.isInterceptReadable, frame.rescale.isSlopeStated,
            frame.rescale.isInterceptStated, frame.segment, frame.dimensions);
}

template <class A> void pass(A &archive, InstanceHeader &h) {
    passAll(archive, h.sopClassUid, h.sopClassName, h.sopInstanceUid, h.transferSyntax, h.patientId,
            h.patientName, h.birthDate, h.sex, h.studyUid, h.studyDate, h.studyDescription,
            h.seriesUid, h.seriesDescription, h.modality, h.bodyPart, h.photometric, h.rescaleType,
            h.frameOfReferenceUid, h.unsupportedSyntax, h.seriesNumber, h.instanceNumber, h.rows,
            h.columns, h.samplesPerPixel, h.declaredFrames, h.bitsAllocated, h.bitsStored,
            h.highBit, h.pixelRepresentation, h.modalityTableFirst, h.mosaicSide, h.pixelBytes,
            h.oddities, h.hasPixels, h.floatPixels, h.lossy, h.hasDamagedPixels, h.paddingValue,
            h.paddingLimit, h.pet, h.isInverse, h.spacingPlace, h.windows, h.modalityTable,
            h.frames);
}

template <class A> void pass(A &archive, DirectoryFile &directory) {
    passAll(archive, directory.isDirectory, directory.files);
}

template <class A> void pass(A &archive, Attribute &attribute) {
    passAll(archive, attribute.depth, attribute.tag, attribute.vr, attribute.name, attribute.value);
}

template <class A> void pass(A &archive, AttributeList &list) {
    passAll(archive, list.attributes, list.isComplete);
}

template <class A> void pass(A &archive, ArchiveFile &file) {
    passAll(archive, file.name, file.bytes, file.isEncrypted, file.isLink);
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
    passAll(archive, code.value, code.scheme, code.meaning);
}

template <class A> void pass(A &archive, SegmentDescription &segment) {
    passAll(archive, segment.number, segment.label, segment.color, segment.category, segment.type);
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
    passAll(archive, structure.number, structure.name, structure.color, structure.type,
            structure.contourSizes, structure.ignoredContours);
}

template <class A> void pass(A &archive, StructureSetHeader &header) {
    passAll(archive, header.instance, header.structures);
}

} // namespace pellucid::confined

namespace pellucid::decoding {

namespace {

[[noreturn]] void fail() {
    throw task::Error(task::ErrorCode::unusable, task::because::implausibleAnswer);
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

void requireValid(const SegmentationHeader &header) {
    requireValid(header.instance);
    if (header.kind < SegmentationKind::binary || header.kind > SegmentationKind::labelMap ||
        header.largestFraction < 1 || header.largestFraction > 65535 || header.segments.empty())
        fail();
    const std::set<int> numbers = numbersOf(header.segments);
    for (const FrameHeader &frame : header.instance.frames)
        if (!frame.positionMm || !frame.rowAxis || !frame.columnAxis || !frame.spacingMm ||
            (header.kind != SegmentationKind::labelMap && !numbers.contains(frame.segment)))
            fail();
}

void requireValid(const StructureSetHeader &header) {
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
}

// Also makes its texts one line.
void requireValid(AttributeList &list) {
    if (list.attributes.size() > maxAttributes)
        fail();
    int above = -1; // the depth of the attribute before
    for (Attribute &attribute : list.attributes) {
        if (attribute.depth < 0 || attribute.depth > above + 1 ||
            attribute.depth > maxAttributeDepth)
            fail();
        above = attribute.depth;
        for (std::string *const text : {&attribute.vr, &attribute.name, &attribute.value})
            confined::makeOneLine(*text);
    }
}

void requireValid(const VolumeLayout &layout) {
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
}

void requireValid(const DirectoryFile & /*directory*/) {}
void requireValid(const std::vector<ArchiveFile> & /*files*/) {}

} // namespace

template <class T> std::string pack(const T &value) {
    return confined::packed(value);
}

template <class T> T unpack(std::span<const std::byte> body) {
    auto value = confined::unpacked<T>(body, task::because::implausibleAnswer);
    requireValid(value);
    return value;
}

template std::string pack(const InstanceHeader &);
template std::string pack(const DirectoryFile &);
template std::string pack(const std::vector<ArchiveFile> &);
template std::string pack(const VolumeLayout &);
template std::string pack(const SegmentationHeader &);
template std::string pack(const StructureSetHeader &);
template std::string pack(const AttributeList &);
template InstanceHeader unpack(std::span<const std::byte>);
template DirectoryFile unpack(std::span<const std::byte>);
template std::vector<ArchiveFile> unpack(std::span<const std::byte>);
template VolumeLayout unpack(std::span<const std::byte>);
template SegmentationHeader unpack(std::span<const std::byte>);
template StructureSetHeader unpack(std::span<const std::byte>);
template AttributeList unpack(std::span<const std::byte>);

task::Reason unpackReason(std::span<const std::byte> body) {
    return confined::unpackedReason(body, task::because::implausibleAnswer);
}

} // namespace pellucid::decoding
