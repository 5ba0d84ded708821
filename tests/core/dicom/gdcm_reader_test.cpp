// SPDX-License-Identifier: GPL-3.0-or-later
// Another reader must see what we wrote: ITK's GDCM, which shares no code with DCMTK.
#include <gtest/gtest.h>

#include <itkGDCMImageIO.h>
#include <itkGDCMSeriesFileNames.h>
#include <itkImageFileReader.h>

#include "core/dicom/write_series.h"
#include "core/phantom/phantom.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {

namespace {

class OtherReader : public testing::TestWithParam<std::string> {};

TEST_P(OtherReader, GdcmReadsEverySliceWithItsPlace) {
    const test::TemporaryFolder folder;
    const auto head = phantom::makePhantom(
        phantom::Kind::head,
        phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{30, 28, 6},
                                                      .spacingMm = glm::dvec3(6, 7, 35),
                                                      .tiltRad = 0.25}));
    dicom::writeCtSeries(folder.path(), head, {}, dicom::transferSyntaxFromName(GetParam()));
    using Image = itk::Image<short, 3>;
    for (int k = 0; k < 6; ++k) {
        auto reader = itk::ImageFileReader<Image>::New();
        auto io = itk::GDCMImageIO::New();
        reader->SetImageIO(io);
        reader->SetFileName((folder / ("IM000" + std::to_string(k + 1) + ".dcm")).string());
        reader->Update();
        const Image &slice = *reader->GetOutput();
        const auto expected = head.lattice().patient(volume::VoxelIndex{0, 0, k}).mm;
        for (int d = 0; d < 3; ++d)
            EXPECT_NEAR(slice.GetOrigin()[d], expected[d], 1e-4);
        EXPECT_NEAR(slice.GetSpacing()[0], 6.0, 1e-6);
        EXPECT_NEAR(slice.GetSpacing()[1], 7.0, 1e-6);
        EXPECT_NEAR(slice.GetDirection()[2][1], -std::sin(0.25), 1e-5);
        for (const auto &[i, j] : {std::pair{0, 0}, {15, 14}, {29, 27}, {10, 20}})
            EXPECT_EQ(slice.GetPixel({{i, j, 0}}), short(head.value({i, j, k})));
    }
}

// GDCM's own RLE and JPEG-LS readers are older than our encoders and correct. It does not read the
// deflated syntax.
INSTANTIATE_TEST_SUITE_P(TransferSyntaxes, OtherReader,
                         testing::Values("implicit", "explicit", "big-endian", "rle",
                                         "jpeg-lossless", "jpeg-ls", "jpeg-2000"),
                         [](const auto &parameter) {
                             std::string name = parameter.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

} // namespace
} // namespace pellucid
