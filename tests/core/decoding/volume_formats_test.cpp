// SPDX-License-Identifier: GPL-3.0-or-later
// NIfTI and MetaImage are compared with files written by ITK, which shares no code with ours, and
// with bytes laid out as the formats specify.
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <functional>

#include <itkImage.h>
#include <itkImageFileWriter.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>

#include "core/decoding/client/read_volume_file.h"
#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/task/error.h"
#include "core/volume/reasons.h"
#include "tests/support/fields.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {

namespace {

using decoding::readVolumeFile;
using volume::Volume;

template <class T> using Image = itk::Image<T, 3>;

// Values 1, 2, ... on a lattice with right angles, the only kind that ITK's images have.
template <class T> typename Image<T>::Pointer imageOn(const volume::Lattice &lattice) {
    auto image = Image<T>::New();
    typename Image<T>::SizeType size;
    typename Image<T>::SpacingType spacing;
    typename Image<T>::PointType origin;
    typename Image<T>::DirectionType direction;
    for (int d = 0; d < 3; ++d) {
        size[unsigned(d)] = std::size_t(lattice.size()[d]);
        spacing[unsigned(d)] = lattice.spacingMm(d);
        origin[unsigned(d)] = lattice.origin().mm[d];
        for (int row = 0; row < 3; ++row)
            direction[unsigned(row)][unsigned(d)] = lattice.step(d)[row] / lattice.spacingMm(d);
    }
    image->SetRegions(size);
    image->SetSpacing(spacing);
    image->SetOrigin(origin);
    image->SetDirection(direction);
    image->Allocate();
    for (std::size_t n = 0; n < lattice.size().count(); ++n)
        image->GetBufferPointer()[n] = T(n + 1);
    return image;
}

volume::Lattice turnedLattice() {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(1.0, 2.0, -0.5));
    const glm::dvec3 u = glm::normalize(glm::cross(axis, glm::dvec3(0.0, 0.0, 1.0))),
                     v = glm::cross(axis, u);
    return volume::Lattice::make({5, 4, 3}, {{-12.5, 33.25, 7.0}}, {0.7 * u, 0.9 * v, 2.5 * axis});
}

void expectOn(const Volume &volume, const volume::Lattice &lattice, double mm) {
    ASSERT_EQ(volume.lattice().size(), lattice.size());
    EXPECT_LT(glm::distance(volume.lattice().origin().mm, lattice.origin().mm), mm);
    for (int d = 0; d < 3; ++d)
        EXPECT_LT(glm::distance(volume.lattice().step(d), lattice.step(d)), mm);
    double next = 1.0;
    for (int k = 0; k < lattice.size().k; ++k)
        for (int j = 0; j < lattice.size().j; ++j)
            for (int i = 0; i < lattice.size().i; ++i)
                EXPECT_EQ(volume.value({i, j, k}), next++);
}

class VolumeFormats : public testing::Test {
protected:
    template <class T, class Io> void expectRoundTrip(const std::string &name, bool isDeflated) {
        const volume::Lattice lattice = turnedLattice();
        auto writer = itk::ImageFileWriter<Image<T>>::New();
        writer->SetInput(imageOn<T>(lattice));
        writer->SetImageIO(Io::New());
        writer->SetFileName((folder / name).string());
        writer->SetUseCompression(isDeflated);
        writer->Update();
        SCOPED_TRACE(name);
        const Volume volume = readVolumeFile(folder / name);
        // NIfTI keeps floats.
        expectOn(volume, lattice, 1e-5);
        EXPECT_TRUE(volume.notes().warnings.empty());
        EXPECT_EQ(volume.notes().title, "v");
    }

    test::TemporaryFolder folder;
};

TEST_F(VolumeFormats, WhatItkWritesIsReadWithItsPlace) {
    const auto each = [&]<class T>(T) {
        expectRoundTrip<T, itk::NiftiImageIO>("v.nii", false);
        expectRoundTrip<T, itk::NiftiImageIO>("v.nii.gz", true);
        for (const bool isDeflated : {false, true}) {
            expectRoundTrip<T, itk::MetaImageIO>("v.mha", isDeflated);
            expectRoundTrip<T, itk::MetaImageIO>("v.mhd", isDeflated);
        }
    };
    each(std::uint8_t());
    each(std::int16_t());
    each(std::uint16_t());
    each(std::int32_t());
    each(float());
    each(double());
}

// A NIfTI header, written at its offsets, in either byte order.
class NiftiBytes {
public:
    explicit NiftiBytes(bool isVersion2, bool isBig = false)
        : m_isVersion2(isVersion2), m_isBig(isBig), m_bytes(isVersion2 ? 544 : 352, '\0') {
        put<std::int32_t>(0, isVersion2 ? 540 : 348);
        const std::string magic = isVersion2 ? std::string("n+2\0\r\n\032\n", 8) : "n+1";
        m_bytes.replace(isVersion2 ? 4 : 344, magic.size(), magic);
        const std::array<int, 5> sizes{4, 3, 2, 2, 2};
        for (std::size_t n = 0; n < sizes.size(); ++n)
            number<std::int16_t, std::int64_t>(40 + 2 * n, 16 + 8 * n, sizes[n]);
        put<std::int16_t>(isVersion2 ? 12 : 70, 4);
        for (std::size_t n = 0; n < 4; ++n)
            number<float, double>(76 + 4 * n, 104 + 8 * n, n == 0 ? 1.0 : double(n));
        number<float, std::int64_t>(108, 168, double(m_bytes.size()));
        // Rows of the affine transform, in right, anterior, superior.
        number<std::int16_t, std::int32_t>(254, 348, 1);
        const double rows[3][4] = {{-2, 0, 0, 5}, {0, 0, 3, 6}, {0, 1.5, 0, 7}};
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t n = 0; n < 4; ++n)
                number<float, double>(280 + 16 * row + 4 * n, 400 + 32 * row + 8 * n, rows[row][n]);
    }
    template <class T1, class T2> void number(std::size_t at1, std::size_t at2, double value) {
        if (m_isVersion2)
            put<T2>(at2, T2(value));
        else
            put<T1>(at1, T1(value));
    }
    // Two volumes of 3 x 2 x 2: 0, 1, ... 23.
    std::string file() const {
        std::string bytes = m_bytes;
        for (std::int16_t n = 0; n < 24; ++n) {
            std::string one(reinterpret_cast<const char *>(&n), 2);
            if (m_isBig)
                std::reverse(one.begin(), one.end());
            bytes += one;
        }
        return bytes;
    }

private:
    template <class T> void put(std::size_t at, T value) {
        std::string one(reinterpret_cast<const char *>(&value), sizeof(T));
        if (m_isBig)
            std::reverse(one.begin(), one.end());
        m_bytes.replace(at, sizeof(T), one);
    }

    bool m_isVersion2, m_isBig;
    std::string m_bytes;
};

TEST_F(VolumeFormats, NiftiOfBothVersionsAndByteOrdersIsPlacedByItsTransform) {
    for (const bool isVersion2 : {false, true})
        for (const bool isBig : {false, true}) {
            test::writeText(folder / "t.nii", NiftiBytes(isVersion2, isBig).file());
            for (int n = 0; n < 2; ++n) {
                const Volume volume = readVolumeFile(folder / "t.nii", {}, n);
                EXPECT_FALSE(volume.isFloat());
                EXPECT_EQ(volume.value({2, 1, 1}), 11.0 + 12.0 * n);
                const auto &lattice = volume.lattice();
                EXPECT_EQ(lattice.origin().mm, glm::dvec3(-5, -6, 7));
                EXPECT_EQ(lattice.step(0), glm::dvec3(2, 0, 0));
                EXPECT_EQ(lattice.step(1), glm::dvec3(0, 0, 1.5));
                EXPECT_EQ(lattice.step(2), glm::dvec3(0, -3, 0));
            }
            EXPECT_THROW(readVolumeFile(folder / "t.nii", {}, 2), task::Error);
        }
}

TEST_F(VolumeFormats, NiftiWithAQuaternionOrNoPlaceAtAll) {
    NiftiBytes turned(false);
    turned.number<std::int16_t, std::int32_t>(254, 348, 0);
    turned.number<std::int16_t, std::int32_t>(252, 344, 1);
    // Half a turn about the third axis, which is flipped.
    turned.number<float, double>(264, 368, 1.0);
    turned.number<float, double>(76, 104, -1.0);
    turned.number<float, double>(268, 376, 10.0);
    test::writeText(folder / "q.nii", turned.file());
    const auto lattice = readVolumeFile(folder / "q.nii").lattice();
    EXPECT_EQ(lattice.step(0), glm::dvec3(1, 0, 0)); // right and anterior are turned, then LPS
    EXPECT_EQ(lattice.step(1), glm::dvec3(0, 2, 0));
    EXPECT_EQ(lattice.step(2), glm::dvec3(0, 0, -3));
    EXPECT_EQ(lattice.origin().mm, glm::dvec3(-10, 0, 0));

    NiftiBytes nowhere(true);
    nowhere.number<std::int16_t, std::int32_t>(254, 348, 0);
    test::writeText(folder / "n.nii", nowhere.file());
    const Volume volume = readVolumeFile(folder / "n.nii");
    EXPECT_EQ(volume.lattice().spacingMm(2), 3.0);
    EXPECT_EQ(volume.notes().warnings.size(), 1U);
}

TEST_F(VolumeFormats, NiftiIsRescaledAndKeepsWholeNumbersAsSuch) {
    for (const auto &[slope, intercept, isFloat] :
         {std::tuple(2.0, -1024.0, false), std::tuple(0.5, 3.0, true),
          std::tuple(0.0, 7.0, false)}) {
        NiftiBytes bytes(false);
        bytes.number<float, double>(112, 176, slope);
        bytes.number<float, double>(116, 184, intercept);
        test::writeText(folder / "s.nii", bytes.file());
        const Volume volume = readVolumeFile(folder / "s.nii");
        EXPECT_EQ(volume.isFloat(), isFloat) << slope;
        EXPECT_EQ(volume.value({2, 1, 1}), slope == 0.0 ? 11.0 : 11.0 * slope + intercept);
    }
}

// A file of four dimensions is one series with a volume for each time.
TEST_F(VolumeFormats, VolumesOfAFourthAxisArePhases) {
    test::writeText(folder / "t.nii", NiftiBytes(true).file());
    const auto catalogue = dicom::scan({folder / "t.nii"});
    const auto all = dicom::selections(catalogue);
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].series, all[1].series);
    EXPECT_EQ(dicom::labelText(all[1].volume->label), "temporal position 2");
    EXPECT_EQ(dicom::loadVolume(*all[1].volume).volume.value({0, 0, 0}), 12.0);
}

TEST_F(VolumeFormats, UnsupportedFilesAreRefusedWithTheReason) {
    const auto reason = [&](const std::string &name, const std::string &bytes) -> std::string {
        test::writeText(folder / name, bytes);
        try {
            readVolumeFile(folder / name);
        } catch (const task::Error &error) {
            EXPECT_EQ(error.path(), folder / name);
            return error.reason().english();
        }
        return "read";
    };
    const std::string nifti = NiftiBytes(false).file();
    EXPECT_EQ(reason("short.nii", nifti.substr(0, nifti.size() - 30)), "is truncated");
    EXPECT_EQ(reason("header.nii", nifti.substr(0, 200)), "is truncated");
    NiftiBytes colors(false);
    colors.number<std::int16_t, std::int16_t>(70, 12, 128);
    EXPECT_EQ(reason("colors.nii", colors.file()),
              "contains colors; only one value per voxel is supported");
    NiftiBytes tensors(false);
    tensors.number<std::int16_t, std::int64_t>(40, 16, 5);
    tensors.number<std::int16_t, std::int64_t>(50, 56, 6);
    EXPECT_EQ(reason("tensors.nii", tensors.file()),
              "has several values per voxel; only one is supported");
    EXPECT_EQ(reason("nothing.nii", "nothing at all"), "is not a NRRD, NIfTI or MetaImage file");
    const std::string meta = "ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\n";
    EXPECT_EQ(
        reason("type.mha", meta + "ElementType = MET_OTHER\nElementDataFile = LOCAL\n12345678"),
        "MetaImage type 'MET_OTHER' is not supported");
    EXPECT_EQ(reason("list.mhd", meta + "ElementType = MET_UCHAR\nElementDataFile = LIST\na\nb\n"),
              "MetaImage samples in a list of files are not supported");
    EXPECT_EQ(reason("out.mhd", meta + "ElementType = MET_UCHAR\nElementDataFile = ../a.raw\n"),
              "refers to a file outside its folder");
    EXPECT_EQ(reason("end.mha", meta), "the MetaImage header has no 'ElementDataFile'");
    EXPECT_EQ(reason("few.mha", meta + "ElementType = MET_SHORT\nElementDataFile = LOCAL\n123"),
              "is truncated");
}

// Values that are one number in 24 bits are refused if they make up the whole range. If other
// values widen the range, they are shown with a warning.
TEST_F(VolumeFormats, ValuesThatFloatsCannotDistinguishAreReported) {
    const auto read = [&](const std::function<double(int)> &value) -> std::string {
        std::string bytes = "NRRD0004\ntype: double\ndimension: 3\nsizes: 10 10 10\nencoding: "
                            "raw\nendian: little\n\n";
        for (int n = 0; n < 1000; ++n) {
            const double one = value(n);
            bytes.append(reinterpret_cast<const char *>(&one), sizeof(one));
        }
        test::writeText(folder / "d.nrrd", bytes);
        try {
            const volume::VolumeNotes notes = readVolumeFile(folder / "d.nrrd").notes();
            for (const task::Reason &warning : notes.warnings)
                if (warning.is(task::because::valuesAreShownAsEqual))
                    return "equal";
        } catch (const task::Error &error) {
            return error.reason().is(task::because::valuesAreOne) ? "refused"
                                                                  : error.reason().english();
        }
        return "read";
    };
    const auto noise = [](double base, double range) {
        return [=](int n) { return base + range * double((n * 7919) % 1000) / 999.0; };
    };
    EXPECT_EQ(read(noise(0.0, 1.0)), "read");
    EXPECT_EQ(read(noise(1e7, 1e7)), "read");
    EXPECT_EQ(read(noise(-1024.0, 4000.0)), "read");
    EXPECT_EQ(read(noise(1e7 + 0.5, 0.0)), "read"); // all the same
    for (const auto &[base, range] :
         {std::pair(1e7, 1.0), std::pair(1e8, 1.0), std::pair(-1e7, 10.0)})
        EXPECT_EQ(read(noise(base, range)), "refused") << base;
    EXPECT_EQ(read(noise(300.0, 1.0)), "read");
    EXPECT_EQ(read([](int n) { return 3000.0 + 0.1 * (n % 2); }), "read");
    EXPECT_EQ(read([](int n) { return -1000.0 + 1e-10 * (n % 7); }), "read"); // nothing but air
    // One voxel of background, or half of the volume.
    for (const int background : {1, 500})
        EXPECT_EQ(read([&](int n) { return n < background ? 0.0 : noise(1e7, 1.0)(n); }), "equal")
            << background;
    EXPECT_EQ(read([](int n) { return n % 20 == 0 ? 2e7 + n / 20 % 2 : 0.0; }), "equal");
    // Labels, and a constant background that resampling left a little noise in.
    EXPECT_EQ(read([](int n) { return 0.1 * (n % 7); }), "read");
    EXPECT_EQ(
        read([&](int n) { return n < 500 ? -1000.0 + 1e-12 * (n % 17) : noise(0.0, 100.0)(n); }),
        "read");
}

} // namespace
} // namespace pellucid
