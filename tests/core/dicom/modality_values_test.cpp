// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "core/dicom/modality_values.h"

namespace pellucid {

namespace {

constexpr int columns = 5000; // more than are converted at once

struct Stored {
    std::vector<std::uint16_t> codes = std::vector<std::uint16_t>(columns, 0);
    bool isSigned = false;
    double slope = 1.0, intercept = 0.0;
    std::optional<int> padding, paddingLimit;
};

// Empty if one of the values does not fit 16 bits.
std::optional<std::vector<std::int16_t>> valuesOf(const Stored &stored) {
    decoding::DecodedFile file;
    file.header.rows = 1;
    file.header.columns = columns;
    file.header.bitsStored = 16;
    file.header.pixelRepresentation = stored.isSigned ? 1 : 0;
    file.header.paddingValue = stored.padding;
    file.header.paddingLimit = stored.paddingLimit;
    file.header.frames.resize(1);
    file.header.frames[0].rescale.slope = stored.slope;
    file.header.frames[0].rescale.intercept = stored.intercept;
    file.samples = stored.codes;
    std::vector<std::int16_t> out(columns);
    volume::Narrowing narrowing(columns);
    if (!dicom::writeValues(file, 0, {}, out.data(), narrowing))
        return std::nullopt;
    return out;
}

TEST(ModalityValues, AreRescaledWithTheirSign) {
    Stored stored;
    stored.codes[0] = 7;
    stored.codes[columns - 1] = 0xffff;
    stored.isSigned = true;
    stored.slope = -3.0;
    stored.intercept = 100.0;
    const auto values = valuesOf(stored);
    ASSERT_TRUE(values);
    EXPECT_EQ(values->front(), 79);
    EXPECT_EQ((*values)[1], 100);
    EXPECT_EQ(values->back(), 103);
    // Slopes on both sides of what is computed in whole numbers, and one that is not whole.
    stored.codes[0] = 2;
    stored.intercept = 0.0;
    for (const double slope : {16383.0, 16384.0, 16385.0, 0.5}) {
        stored.slope = slope;
        const bool fits = 2.0 * slope <= 32767.0;
        ASSERT_EQ(bool(valuesOf(stored)), fits) << slope;
        if (fits)
            EXPECT_EQ(valuesOf(stored)->front(), std::int16_t(2.0 * slope));
    }
}

TEST(ModalityValues, ThatDoNotFitAreRefusedWhereverTheyAre) {
    for (const int at : {0, columns - 1}) {
        Stored stored;
        stored.codes[std::size_t(at)] = 32767;
        EXPECT_TRUE(valuesOf(stored));
        stored.intercept = 1.0;
        EXPECT_FALSE(valuesOf(stored));
        stored.isSigned = true;
        stored.intercept = 0.0;
        stored.codes[std::size_t(at)] = 0x8001;
        EXPECT_TRUE(valuesOf(stored));
        stored.codes[std::size_t(at)] = 0x8000; // the lowest code marks missing samples
        EXPECT_FALSE(valuesOf(stored));
    }
}

TEST(ModalityValues, PaddingIsMissingWhateverItsValue) {
    Stored stored;
    stored.intercept = 32000.0;
    stored.codes[3] = 2000;
    stored.codes[4] = 2005;
    EXPECT_FALSE(valuesOf(stored));
    stored.padding = 2005;
    stored.paddingLimit = 1999;
    auto values = valuesOf(stored);
    ASSERT_TRUE(values);
    EXPECT_EQ((*values)[3], dicom::missingValue<std::int16_t>());
    EXPECT_EQ((*values)[4], dicom::missingValue<std::int16_t>());
    dicom::fillMissing(*values);
    EXPECT_EQ((*values)[3], 32000);
}

TEST(ModalityValues, MissingOnesBecomeTheLowestOther) {
    std::vector<std::int16_t> codes{dicom::missingValue<std::int16_t>(), 5, -32767};
    dicom::fillMissing(codes);
    EXPECT_EQ(codes, (std::vector<std::int16_t>{-32767, 5, -32767}));
    std::vector<std::int16_t> none(3, dicom::missingValue<std::int16_t>());
    dicom::fillMissing(none);
    EXPECT_EQ(none, std::vector<std::int16_t>(3, 0));
    std::vector<float> values{dicom::missingValue<float>(), 2.0F, -1.0F};
    dicom::fillMissing(values);
    EXPECT_EQ(values, (std::vector<float>{-1.0F, 2.0F, -1.0F}));
}

} // namespace
} // namespace pellucid
