// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoder/message.h"

#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "core/task/error.h"

namespace pellucid::decoder {

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
    frame.dimensions = {{"echo", "1"}, {"b-value", "800"}};
    h.frames = {frame, FrameHeader()};
    return h;
}

std::span<const std::byte> bytesOf(const std::string &body) {
    return std::as_bytes(std::span(body));
}

} // namespace

TEST(Message, headersComeThrough) {
    const InstanceHeader sent = someHeader(), got = unpackHeader(bytesOf(pack(sent)));
    EXPECT_EQ(got.patientName, sent.patientName);
    EXPECT_EQ(got.seriesUid, sent.seriesUid);
    EXPECT_EQ(got.columns, 7);
    EXPECT_TRUE(got.isSigned());
    EXPECT_FALSE(got.lossy);
    EXPECT_EQ(got.paddingValue, sent.paddingValue);
    EXPECT_FALSE(got.paddingLimit);
    ASSERT_EQ(got.windows.size(), 2U);
    EXPECT_EQ(got.windows[1].center, -600.0);
    EXPECT_EQ(got.modalityTable, sent.modalityTable);
    ASSERT_EQ(got.frames.size(), 2U);
    EXPECT_EQ(got.frames[0].positionMm, sent.frames[0].positionMm);
    EXPECT_EQ(got.frames[0].spacingMm, sent.frames[0].spacingMm);
    EXPECT_EQ(got.frames[0].rescale, sent.frames[0].rescale);
    EXPECT_EQ(got.frames[0].dimensions, sent.frames[0].dimensions);
    EXPECT_FALSE(got.frames[1].positionMm);
}

// Whatever a decoder sends that a file has taken over: a header or a refusal, in little memory.
TEST(Message, nonsenseIsRefused) {
    const std::string good = pack(someHeader());
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_THROW(unpackHeader(bytesOf(good).first(size)), task::Error) << size;
    EXPECT_THROW(unpackHeader(bytesOf(good + "x")), task::Error);
    std::mt19937 random(7);
    for (int round = 0; round < 20000; ++round) {
        std::string bad = good;
        for (int n = 0; n < 3; ++n)
            bad[random() % bad.size()] = char(random() % 4 == 0 ? 0xFF : random());
        try {
            for (const FrameHeader &frame : unpackHeader(bytesOf(bad)).frames)
                if (frame.positionMm) {
                    EXPECT_TRUE(std::isfinite(frame.positionMm->x));
                }
        } catch (const task::Error &) {
        }
    }
    InstanceHeader endless = someHeader();
    endless.frames[0].rescale.slope = std::numeric_limits<double>::infinity();
    EXPECT_THROW(unpackHeader(bytesOf(pack(endless))), task::Error);
    InstanceHeader without = someHeader();
    without.frames.clear();
    EXPECT_THROW(unpackHeader(bytesOf(pack(without))), task::Error);
}

TEST(Message, layoutsOfNrrdComeThroughOrAreRefused) {
    VolumeLayout sent;
    sent.size = {4, 3, 2};
    sent.stepsMm = {glm::dvec3(1, 0, 0), glm::dvec3(0, 2, 0), glm::dvec3(0, 0.5, 3)};
    sent.originMm = {1, 2, 3};
    sent.scalar = StoredScalar::f32;
    sent.isSwapped = true;
    sent.dataFile = "samples.raw";
    const VolumeLayout got = unpackLayout(bytesOf(pack(sent)));
    EXPECT_EQ(got.size, sent.size);
    EXPECT_EQ(got.stepsMm, sent.stepsMm);
    EXPECT_EQ(got.originMm, sent.originMm);
    EXPECT_EQ(got.scalar, sent.scalar);
    EXPECT_TRUE(got.isSwapped);
    EXPECT_FALSE(got.isDeflated);
    EXPECT_EQ(got.dataFile, sent.dataFile);
    const auto refused = [&](auto change) {
        VolumeLayout bad = sent;
        change(bad);
        EXPECT_THROW(unpackLayout(bytesOf(pack(bad))), task::Error);
    };
    refused([](VolumeLayout &l) { l.size.j = 0; });
    refused([](VolumeLayout &l) { l.size.k = -2; });
    refused([](VolumeLayout &l) { l.size = {1 << 20, 1 << 20, 1 << 24}; }); // the product wraps
    refused([](VolumeLayout &l) { l.scalar = StoredScalar(10); });
    refused([](VolumeLayout &l) { l.scalar = StoredScalar(-1); });
    refused([](VolumeLayout &l) { l.stepsMm[1].y = std::numeric_limits<double>::quiet_NaN(); });
}

TEST(Message, reasonsComeThroughOnOneLine) {
    const auto got = [](const task::Reason &sent) { return unpackReason(bytesOf(sent.encoded())); };
    const auto nested = because::jpeg2000(because::damagedHeader);
    EXPECT_EQ(got(because::isEmpty), because::isEmpty);
    EXPECT_EQ(got(nested), nested);
    EXPECT_EQ(got(because::isDamagedBy("broken\n\x1B[2Jhere")),
              because::isDamagedBy("broken  [2Jhere"));
    // The longest that a text of a header makes.
    const auto longest = because::isAColorImage(std::string(1024, 'x'));
    EXPECT_EQ(got(longest), longest);
}

TEST(Message, whatIsNoReasonIsRefused) {
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
            EXPECT_EQ(error.reason(), because::decodedToNonsense);
        }
}

} // namespace pellucid::decoder
