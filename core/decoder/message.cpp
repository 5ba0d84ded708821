// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoder/message.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstring>
#include <set>
#include <type_traits>

#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>

#include "core/task/error.h"

namespace pellucid::decoder {

namespace {

// The parser truncates longer ones.
constexpr std::uint64_t longestString = 1 << 16;
constexpr std::uint64_t maxElements = 1'000'000;
constexpr std::size_t longestReason = 2000; // a text of a header has up to 1024 bytes

[[noreturn]] void fail() {
    throw task::Error(task::ErrorCode::unusable, task::because::decodedToNonsense);
}

// Writer and reader visit the same fields in the same order.
class Writer {
public:
    static constexpr bool isReading = false;

    template <class T>
    requires std::is_arithmetic_v<T>
    void number(T &value) {
        const std::size_t at = bytes.size();
        bytes.resize(at + sizeof(T));
        std::memcpy(bytes.data() + at, &value, sizeof(T));
    }
    void text(std::string &value) {
        std::uint64_t size = std::min<std::uint64_t>(value.size(), longestString);
        number(size);
        bytes.append(value, 0, size);
    }
    std::uint64_t count(std::uint64_t size) {
        number(size);
        return size;
    }

    std::string bytes;
};

class Reader {
public:
    static constexpr bool isReading = true;

    explicit Reader(std::span<const std::byte> bytes) : m_rest(bytes) {}

    template <class T>
    requires std::is_arithmetic_v<T>
    void number(T &value) {
        if constexpr (std::same_as<T, bool>) { // any other byte is not a valid bool
            unsigned char byte = 0;
            number(byte);
            value = byte != 0;
        } else {
            if (m_rest.size() < sizeof(T))
                fail();
            std::memcpy(&value, m_rest.data(), sizeof(T));
            m_rest = m_rest.subspan(sizeof(T));
            if constexpr (std::is_floating_point_v<T>)
                if (!std::isfinite(value))
                    fail();
        }
    }
    void text(std::string &value) {
        const std::uint64_t size = count(0);
        if (size > std::min<std::uint64_t>(longestString, m_rest.size()))
            fail();
        value.assign(reinterpret_cast<const char *>(m_rest.data()), size);
        m_rest = m_rest.subspan(size);
    }
    // Nothing is reserved: elements are created only as their bytes are present.
    std::uint64_t count(std::uint64_t) {
        std::uint64_t size = 0;
        number(size);
        if (size > std::min<std::uint64_t>(maxElements, m_rest.size()))
            fail();
        return size;
    }
    void end() const {
        if (!m_rest.empty())
            fail();
    }

private:
    std::span<const std::byte> m_rest;
};

template <class A, class T>
requires std::is_arithmetic_v<T>
void pass(A &archive, T &value) {
    archive.number(value);
}

template <class A> void pass(A &archive, std::string &value) {
    archive.text(value);
}

template <class A, glm::length_t N> void pass(A &archive, glm::vec<N, double> &value) {
    for (glm::length_t n = 0; n < N; ++n)
        archive.number(value[n]);
}

template <class A, class T> void pass(A &archive, std::optional<T> &value);
template <class A, class T> void pass(A &archive, std::vector<T> &values);
template <class A, class K, class V> void pass(A &archive, std::map<K, V> &values);

template <class A> void pass(A &archive, volume::ValueWindow &window) {
    pass(archive, window.center);
    pass(archive, window.width);
    pass(archive, window.name);
}

template <class A> void pass(A &archive, PetHeader &pet) {
    for (std::string *const text :
         {&pet.units, &pet.uptakeType, &pet.decayCorrection, &pet.seriesDate, &pet.seriesTime,
          &pet.acquisitionDate, &pet.acquisitionTime, &pet.injectionTime, &pet.injectionDateTime})
        pass(archive, *text);
    for (double *const number :
         {&pet.weightKg, &pet.injectedBq, &pet.halfLifeS, &pet.uptakePerCount})
        pass(archive, *number);
    pass(archive, pet.isAttenuationCorrected);
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
    pass(archive, frame.imageType);
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

template <class A, class T> void pass(A &archive, std::optional<T> &value) {
    bool isThere = value.has_value();
    pass(archive, isThere);
    if constexpr (A::isReading)
        value = isThere ? std::optional(T()) : std::nullopt;
    if (isThere)
        pass(archive, *value);
}

template <class A, class T> void pass(A &archive, std::vector<T> &values) {
    const std::uint64_t size = archive.count(values.size());
    for (std::uint64_t n = 0; n < size; ++n) {
        if constexpr (A::isReading)
            values.emplace_back();
        pass(archive, values[n]);
    }
}

template <class A, class K, class V> void pass(A &archive, std::map<K, V> &values) {
    const std::uint64_t size = archive.count(values.size());
    if constexpr (A::isReading) {
        for (std::uint64_t n = 0; n < size; ++n) {
            K key;
            pass(archive, key);
            pass(archive, values[key]);
        }
    } else {
        for (auto &[key, value] : values) {
            K copy = key;
            pass(archive, copy);
            pass(archive, value);
        }
    }
}

template <class T> std::string packed(const T &value) {
    Writer writer;
    T copy = value; // a reader assigns to the fields
    pass(writer, copy);
    return std::move(writer.bytes);
}

template <class T> T unpacked(std::span<const std::byte> body) {
    Reader reader(body);
    T value;
    pass(reader, value);
    reader.end();
    return value;
}

} // namespace

namespace {

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
            std::replace_if(
                text->begin(), text->end(), [](char c) { return (unsigned char)(c) < 0x20; }, ' ');
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
    if (body.size() > longestReason)
        fail();
    std::string text(reinterpret_cast<const char *>(body.data()), body.size());
    // The encoding has no such bytes itself, and counts those of the texts.
    std::replace_if(
        text.begin(), text.end(), [](char c) { return (unsigned char)(c) < 0x20; }, ' ');
    auto reason = task::Reason::decoded(text);
    if (!reason)
        fail();
    return *std::move(reason);
}

} // namespace pellucid::decoder
