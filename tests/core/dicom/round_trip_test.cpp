// SPDX-License-Identifier: GPL-3.0-or-later
// A written series is read back unchanged.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "core/decoding/process/parse.h"
#include "core/dicom/write_series.h"
#include "core/task/error.h"
#include "tests/core/dicom/written_series.h"
#include "tests/support/files.h"
#include "tests/support/little_memory.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {

namespace {

namespace fs = std::filesystem;
using test::loadDefault;
using test::tiltedHead;

void expectSameSamples(const volume::Volume &a, const volume::Volume &b) {
    ASSERT_EQ(a.lattice().size(), b.lattice().size());
    a.visit([&](auto x) {
        b.visit([&](auto y) {
            std::size_t different = 0;
            for (std::size_t n = 0; n < x.size(); ++n)
                different += double(x[n]) != double(y[n]) ? 1 : 0;
            EXPECT_EQ(different, 0U);
        });
    });
}

class RoundTrip : public testing::TestWithParam<std::string> {};

TEST_P(RoundTrip, SamplesAndGeometryComeBack) {
    const test::TemporaryFolder folder;
    const volume::Volume head = tiltedHead();
    dicom::writeCtSeries(folder.path(), head, {.patientName = "Test^Patient", .patientId = "1"},
                         dicom::transferSyntaxFromName(GetParam()));
    const auto loaded = loadDefault(folder.path());
    EXPECT_TRUE(loaded.skipped.empty());
    EXPECT_EQ(loaded.volume.unit(), volume::ValueUnit::hounsfield);
    expectSameSamples(loaded.volume, head);
    // Positions are written with at least ten digits.
    const auto &a = loaded.volume.lattice(), &b = head.lattice();
    EXPECT_LT(glm::distance(a.origin().mm, b.origin().mm), 1e-6);
    for (int d = 0; d < 3; ++d)
        EXPECT_LT(glm::distance(a.step(d), b.step(d)), 1e-6);
    EXPECT_NEAR(a.shearRad(), 0.3, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(TransferSyntaxes, RoundTrip,
                         testing::ValuesIn(dicom::transferSyntaxNames()),
                         [](const auto &parameter) {
                             std::string name = parameter.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(Decode, ImpossibleSizesAreRefusedBeforeAllocation) {
    for (const auto syntax : {dicom::TransferSyntax::explicitLittle, dicom::TransferSyntax::rle,
                              dicom::TransferSyntax::jpeg2000, dicom::TransferSyntax::jpegLs}) {
        const test::TemporaryFolder folder;
        dicom::writeCtSeries(folder.path(), tiltedHead(), {}, syntax);
        auto bytes = test::readBytes(folder / "IM0001.dcm");
        // Rows (0028,0010) and Columns (0028,0011), US, two bytes each, become 65535.
        for (const char element : {'\x10', '\x11'}) {
            const std::string wanted{'\x28', '\0', element, '\0', 'U', 'S', '\x02', '\0'};
            const auto *text = reinterpret_cast<const char *>(bytes.data());
            const auto at = std::string_view(text, bytes.size()).find(wanted);
            ASSERT_NE(at, std::string_view::npos);
            bytes[at + 8] = bytes[at + 9] = std::byte(0xFF);
        }
#ifndef PELLUCID_SANITIZED // sanitizers reserve terabytes
        const test::LittleMemory little(256);
#endif
        try {
            decoding::process::decodeImage(bytes);
            ADD_FAILURE() << int(syntax);
        } catch (const task::Error &error) {
            EXPECT_EQ(error.reason().english(), "the pixel data is truncated") << int(syntax);
        }
    }
}

TEST(Write, CancellingLeavesNoFile) {
    const test::TemporaryFolder folder;
    std::stop_source source;
    const task::Progress progress(source.get_token(), [&](double fraction) {
        if (fraction > 0.3)
            source.request_stop();
    });
    EXPECT_THROW(dicom::writeCtSeries(folder / "series", tiltedHead(), {},
                                      dicom::TransferSyntax::rle, progress),
                 task::Cancelled);
    EXPECT_FALSE(fs::exists(folder / "series"));
}

} // namespace
} // namespace pellucid
