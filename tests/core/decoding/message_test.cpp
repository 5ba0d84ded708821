// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/client/message.h"

#include <concepts>
#include <limits>
#include <random>
#include <tuple>
#include <type_traits>

#include <gtest/gtest.h>

#include "core/decoding/client/reasons.h"
#include "core/decoding/process/reasons.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::decoding {

namespace {

namespace because = task::because;

InstanceHeader someHeader() {
    InstanceHeader h;
    h.patientName = "Zhang^Wei=\xE5\xBC\xA0";
    h.seriesUid = "1.2.3";
    h.rows = 512;
    h.columns = 7;
    h.pixelRepresentation = 1;
    h.paddingValue = -2000;
    h.windows = {{40.0, 400.0, "soft"}, {-600.0, 1500.0, ""}};
    h.modalityTable = {1, 2, 65535};
    FrameHeader frame;
    frame.positionMm = glm::dvec3(1.5, -2.0, 1e-3);
    frame.spacingMm = glm::dvec2(0.5, 0.25);
    frame.rescale = {2.0, -1024.0};
    frame.dimensions = {{0x00180086, "1"}, {0x00189087, "800"}};
    h.frames = {frame, FrameHeader()};
    return h;
}

template <class T, class Message>
concept IsA = std::same_as<std::remove_const_t<T>, Message>;

// The fields of a message, in their order. A struct with more or fewer fields does not compile
// here.
auto fieldsOf(IsA<Rescale> auto &r) {
    auto &[slope, intercept, isSlopeZero, isSlopeReadable, isInterceptReadable, isSlopeStated,
           isInterceptStated] = r;
    return std::tie(slope, intercept, isSlopeZero, isSlopeReadable, isInterceptReadable,
                    isSlopeStated, isInterceptStated);
}
auto fieldsOf(IsA<FrameHeader> auto &f) {
    auto &[positionMm, rowAxis, columnAxis, spacingMm, sliceThicknessMm, rescale, segment,
           dimensions] = f;
    return std::tie(positionMm, rowAxis, columnAxis, spacingMm, sliceThicknessMm, rescale, segment,
                    dimensions);
}
auto fieldsOf(IsA<InstanceHeader> auto &h) {
    auto &[sopClassUid, sopClassName, sopInstanceUid, transferSyntax, unsupportedSyntax, patientId,
           patientName, birthDate, sex, studyUid, studyDate, studyDescription, frameOfReferenceUid,
           seriesUid, seriesDescription, modality, bodyPart, seriesNumber, instanceNumber,
           hasPixels, floatPixels, rows, columns, samplesPerPixel, declaredFrames, pixelBytes,
           bitsAllocated, bitsStored, highBit, pixelRepresentation, lossy, hasDamagedPixels,
           oddities, mosaicSide, photometric, rescaleType, isInverse, spacingPlace, paddingValue,
           paddingLimit, pet, windows, modalityTable, modalityTableFirst, frames] = h;
    return std::tie(sopClassUid, sopClassName, sopInstanceUid, transferSyntax, unsupportedSyntax,
                    patientId, patientName, birthDate, sex, studyUid, studyDate, studyDescription,
                    frameOfReferenceUid, seriesUid, seriesDescription, modality, bodyPart,
                    seriesNumber, instanceNumber, hasPixels, floatPixels, rows, columns,
                    samplesPerPixel, declaredFrames, pixelBytes, bitsAllocated, bitsStored, highBit,
                    pixelRepresentation, lossy, hasDamagedPixels, oddities, mosaicSide, photometric,
                    rescaleType, isInverse, spacingPlace, paddingValue, paddingLimit, pet, windows,
                    modalityTable, modalityTableFirst, frames);
}
auto fieldsOf(IsA<PetHeader> auto &p) {
    auto &[units, uptakeType, decayCorrection, seriesDate, seriesTime, acquisitionDate,
           acquisitionTime, injectionTime, injectionDateTime, timezone, radionuclide, weightKg,
           injectedBq, halfLifeS, frameReferenceS, frameDurationS, injections, uptakePerCount,
           corrections, isDynamic] = p;
    return std::tie(units, uptakeType, decayCorrection, seriesDate, seriesTime, acquisitionDate,
                    acquisitionTime, injectionTime, injectionDateTime, timezone, radionuclide,
                    weightKg, injectedBq, halfLifeS, frameReferenceS, frameDurationS, injections,
                    uptakePerCount, corrections, isDynamic);
}
auto fieldsOf(IsA<VolumeLayout> auto &l) {
    auto &[size, volumes, originMm, stepsMm, scalar, slope, intercept, isDeflated, isSwapped,
           isOfPatient, segments, dataFile, at, skip] = l;
    return std::tie(size, volumes, originMm, stepsMm, scalar, slope, intercept, isDeflated,
                    isSwapped, isOfPatient, segments, dataFile, at, skip);
}
auto fieldsOf(IsA<CodedConcept> auto &c) {
    auto &[value, scheme, meaning] = c;
    return std::tie(value, scheme, meaning);
}
auto fieldsOf(IsA<SegmentDescription> auto &s) {
    auto &[number, label, color, category, type] = s;
    return std::tie(number, label, color, category, type);
}
auto fieldsOf(IsA<Structure> auto &s) {
    auto &[number, name, color, type, contourSizes, ignoredContours] = s;
    return std::tie(number, name, color, type, contourSizes, ignoredContours);
}
auto fieldsOf(IsA<ArchiveFile> auto &f) {
    auto &[name, bytes, isEncrypted, isLink] = f;
    return std::tie(name, bytes, isEncrypted, isLink);
}

// Gives each field a valid value that differs from its default and from all other fields.
class Fill {
public:
    template <class T>
    requires std::is_arithmetic_v<T>
    void operator()(T &value) {
        if constexpr (std::same_as<T, bool>)
            value = !value;
        else
            value = T(++m_number); // at most 31 where a field is limited
    }
    void operator()(std::string &text) { text = "text " + std::to_string(++m_text); }
    void operator()(glm::dvec2 &vector) {
        for (int d = 0; d < 2; ++d)
            (*this)(vector[d]);
    }
    void operator()(glm::dvec3 &vector) {
        for (int d = 0; d < 3; ++d)
            (*this)(vector[d]);
    }
    template <class T> void operator()(std::optional<T> &value) { (*this)(value.emplace()); }
    void operator()(volume::GridSize &size) {
        for (int *const n : {&size.i, &size.j, &size.k})
            (*this)(*n);
    }
    void operator()(StoredScalar &scalar) { scalar = StoredScalar::f32; }
    template <class T, std::size_t N> void operator()(std::array<T, N> &values) {
        for (T &value : values)
            (*this)(value);
    }
    template <class T> void operator()(std::vector<T> &values) {
        values.resize(2);
        for (T &value : values)
            (*this)(value);
    }
    void operator()(std::map<std::uint32_t, std::string> &texts) {
        texts = {{0x00180086, "1"}, {0x00189087, "800"}};
    }
    void operator()(volume::ValueWindow &window) {
        (*this)(window.center);
        (*this)(window.width);
        (*this)(window.name);
        window.function = volume::WindowFunction::table;
        window.curve = std::make_shared<const std::vector<float>>(std::vector<float>{0.0F, 0.25F});
    }
    void operator()(volume::SpacingPlace &place) { place = volume::SpacingPlace::calibrated; }
    // The second frame keeps its defaults.
    void operator()(std::vector<FrameHeader> &frames) {
        frames.resize(2);
        fillFields(frames.front());
        frames.front().rowAxis = glm::dvec3(0.6, 0.8, 0.0); // unit vectors at right angles
        frames.front().columnAxis = glm::dvec3(0.0, 0.0, -1.0);
    }
    void operator()(SegmentDescription &segment) {
        fillFields(segment);
        segment.color = glm::dvec3(0.25, 0.5, 1.0); // components are 0 to 1
    }
    template <class T>
    requires IsA<T, Rescale> || IsA<T, ArchiveFile> || IsA<T, CodedConcept> || IsA<T, PetHeader>
    void operator()(T &message) { fillFields(message); }
    template <class T> void fillFields(T &message) {
        std::apply([this](auto &...field) { ((*this)(field), ...); }, fieldsOf(message));
    }

private:
    int m_number = 1, m_text = 0; // the defaults of numbers are 0 and 1
};

template <class T> T filled() {
    T message;
    Fill().fillFields(message);
    return message;
}

void expectSame(const std::vector<FrameHeader> &got, const std::vector<FrameHeader> &sent,
                std::size_t field);
template <class T> void expectSame(const T &got, const T &sent, std::size_t field) {
    EXPECT_TRUE(got == sent) << "field " << field;
}

template <class T> void expectSameFields(const T &got, const T &sent) {
    [ a = fieldsOf(got), b = fieldsOf(sent) ]<std::size_t... n>(std::index_sequence<n...>) {
        (expectSame(std::get<n>(a), std::get<n>(b), n), ...);
    }
    (std::make_index_sequence<std::tuple_size_v<decltype(fieldsOf(got))>>());
}

void expectSame(const std::vector<FrameHeader> &got, const std::vector<FrameHeader> &sent,
                std::size_t field) {
    ASSERT_EQ(got.size(), sent.size()) << "field " << field;
    for (std::size_t n = 0; n < got.size(); ++n)
        expectSameFields(got[n], sent[n]);
}

std::span<const std::byte> bytesOf(const std::string &body) {
    return std::as_bytes(std::span(body));
}

} // namespace

TEST(Message, everyFieldOfAHeaderComesThrough) {
    InstanceHeader plain; // without optional values
    plain.frames.resize(1);
    for (const InstanceHeader &sent : {filled<InstanceHeader>(), plain})
        expectSameFields(unpack<InstanceHeader>(bytesOf(pack(sent))), sent);
}

TEST(Message, everyFieldOfAnArchivesListComesThrough) {
    const std::vector<ArchiveFile> sent{filled<ArchiveFile>(), ArchiveFile()};
    const auto got = unpack<std::vector<ArchiveFile>>(bytesOf(pack(sent)));
    ASSERT_EQ(got.size(), sent.size());
    for (std::size_t n = 0; n < got.size(); ++n)
        expectSameFields(got[n], sent[n]);
}

TEST(Message, aDirectoryComesThrough) {
    const DirectoryFile sent{true, {{"DICOM", "IM1"}, {}, {"IM2"}}};
    const DirectoryFile got = unpack<DirectoryFile>(bytesOf(pack(sent)));
    EXPECT_TRUE(got.isDirectory);
    EXPECT_EQ(got.files, sent.files);
}

// A decoder that a file has taken over may send any bytes: they are a header or are refused, in
// little memory.
TEST(Message, nonsenseIsRefused) {
    const std::string good = pack(someHeader());
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_THROW(unpack<InstanceHeader>(bytesOf(good).first(size)), task::Error) << size;
    EXPECT_THROW(unpack<InstanceHeader>(bytesOf(good + "x")), task::Error);
    std::mt19937 random(7);
    int taken = 0, refused = 0;
    for (int round = 0; round < 20000; ++round) {
        std::string bad = good;
        for (int n = 0; n < 3; ++n)
            bad[random() % bad.size()] = char(random() % 4 == 0 ? 0xFF : random());
        try {
            for (const FrameHeader &frame : unpack<InstanceHeader>(bytesOf(bad)).frames)
                if (frame.positionMm) {
                    EXPECT_TRUE(std::isfinite(frame.positionMm->x));
                }
            ++taken;
        } catch (const task::Error &) {
            ++refused;
        }
    }
    EXPECT_GT(taken, 0); // a name with another letter is valid
    EXPECT_GT(refused, 0);
    InstanceHeader endless = someHeader();
    endless.frames[0].rescale.slope = std::numeric_limits<double>::infinity();
    EXPECT_THROW(unpack<InstanceHeader>(bytesOf(pack(endless))), task::Error);
    InstanceHeader without = someHeader();
    without.frames.clear();
    EXPECT_THROW(unpack<InstanceHeader>(bytesOf(pack(without))), task::Error);
}

TEST(Message, everyFieldOfALayoutComesThroughOrIsRefused) {
    const auto sent = filled<VolumeLayout>();
    expectSameFields(unpack<VolumeLayout>(bytesOf(pack(sent))), sent);
    const auto refused = [&](auto change) {
        VolumeLayout bad = sent;
        change(bad);
        EXPECT_THROW(unpack<VolumeLayout>(bytesOf(pack(bad))), task::Error);
    };
    refused([](VolumeLayout &l) { l.size.j = 0; });
    refused([](VolumeLayout &l) { l.size.k = -2; });
    refused([](VolumeLayout &l) { l.size = {1 << 20, 1 << 20, 1 << 24}; }); // the product wraps
    refused([](VolumeLayout &l) { l.scalar = StoredScalar(10); });
    refused([](VolumeLayout &l) { l.scalar = StoredScalar(-1); });
    refused([](VolumeLayout &l) { l.stepsMm[1].y = std::numeric_limits<double>::quiet_NaN(); });
}

SegmentationHeader someSegmentation() {
    SegmentationHeader header{filled<InstanceHeader>(), SegmentationKind::fractional, 200, {}};
    Fill fill;
    fill(header.segments);
    for (FrameHeader &frame : header.instance.frames) {
        frame = filled<InstanceHeader>().frames.front();
        frame.segment = header.segments.back().number;
    }
    return header;
}

TEST(Message, everyFieldOfASegmentationComesThroughOrIsRefused) {
    const SegmentationHeader sent = someSegmentation();
    const SegmentationHeader got = unpack<SegmentationHeader>(bytesOf(pack(sent)));
    expectSameFields(got.instance, sent.instance);
    EXPECT_EQ(got.kind, sent.kind);
    EXPECT_EQ(got.largestFraction, sent.largestFraction);
    ASSERT_EQ(got.segments.size(), sent.segments.size());
    for (std::size_t n = 0; n < sent.segments.size(); ++n)
        expectSameFields(got.segments[n], sent.segments[n]);
    const auto refused = [&](auto change) {
        SegmentationHeader bad = sent;
        change(bad);
        EXPECT_THROW(unpack<SegmentationHeader>(bytesOf(pack(bad))), task::Error);
    };
    refused([](SegmentationHeader &h) { h.kind = SegmentationKind(3); });
    refused([](SegmentationHeader &h) { h.kind = SegmentationKind(-1); });
    refused([](SegmentationHeader &h) { h.largestFraction = 0; });
    refused([](SegmentationHeader &h) { h.segments.clear(); });
    refused([](SegmentationHeader &h) { h.segments[0].number = 0; });
    refused([](SegmentationHeader &h) { h.segments[1].number = h.segments[0].number; });
    refused([](SegmentationHeader &h) { h.segments[0].color = glm::dvec3(0.0, 0.0, 1.5); });
    refused([](SegmentationHeader &h) { h.instance.frames[0].segment = 77; });
    refused([](SegmentationHeader &h) { h.instance.frames[1].positionMm.reset(); });
    refused([](SegmentationHeader &h) { h.instance.frames[1].spacingMm.reset(); });
}

TEST(Message, everyFieldOfAStructureSetComesThroughOrIsRefused) {
    Structure structure;
    Fill().fillFields(structure);
    structure.color = glm::dvec3(1.0, 0.5, 0.0);
    structure.contourSizes = {3, 4000};
    const StructureSetHeader sent{filled<InstanceHeader>(), {structure}};
    const StructureSetHeader got = unpack<StructureSetHeader>(bytesOf(pack(sent)));
    expectSameFields(got.instance, sent.instance);
    ASSERT_EQ(got.structures.size(), 1U);
    expectSameFields(got.structures[0], structure);
    EXPECT_EQ(pointCount(got), 4003U);
    const auto refused = [&](auto change) {
        StructureSetHeader bad = sent;
        change(bad);
        EXPECT_THROW(unpack<StructureSetHeader>(bytesOf(pack(bad))), task::Error);
    };
    refused([](StructureSetHeader &h) { h.structures.clear(); });
    refused([](StructureSetHeader &h) { h.structures[0].contourSizes[0] = 2; });
    refused([](StructureSetHeader &h) { h.structures[0].contourSizes[0] = 0xFFFFFFFF; });
    refused([](StructureSetHeader &h) {
        h.structures[0].contourSizes.assign(3, std::uint32_t(maxContourPoints / 2));
    });
    refused([](StructureSetHeader &h) { h.structures[0].ignoredContours = -1; });
}

TEST(Message, reasonsComeThroughOnOneLine) {
    const auto got = [](const task::Reason &sent) { return unpackReason(bytesOf(sent.encoded())); };
    const auto nested = because::jpeg2000(because::damagedHeader);
    EXPECT_EQ(got(because::isEmpty), because::isEmpty);
    EXPECT_EQ(got(nested), nested);
    EXPECT_EQ(got(because::isDamagedBy("broken\n\x1B[2Jhere")),
              because::isDamagedBy("broken  [2Jhere"));
    // The longest reason with a text from a header.
    const auto longest = because::isAColorImage(std::string(1024, 'x'));
    EXPECT_EQ(got(longest), longest);
}

TEST(Message, bytesThatAreNoReasonAreRefused) {
    const std::string good = because::jpeg2000(because::isDamagedBy("text")).encoded();
    std::vector<std::string> all{good + "x", "is damaged",
                                 because::isDamagedBy(std::string(100000, 'x')).encoded(),
                                 std::string(100000, 'x'), std::string("isDamaged\0;", 11)};
    for (std::size_t size = 0; size < good.size(); ++size)
        all.push_back(good.substr(0, size));
    for (const std::string &text : all)
        try {
            unpackReason(bytesOf(text));
            ADD_FAILURE() << text;
        } catch (const task::Error &error) {
            EXPECT_EQ(error.code(), task::ErrorCode::unusable);
            EXPECT_EQ(error.reason(), because::implausibleAnswer);
        }
}

} // namespace pellucid::decoding
