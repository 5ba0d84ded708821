// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/client/read_volume_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>

#include <zlib.h>

#include "core/decoding/client/reasons.h"
#include "core/task/error.h"
#include "core/volume/nrrd.h"
#include "tests/support/fields.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {

namespace {

using decoding::readVolumeFile;
using decoding::readVolumeFileHeader;
using volume::Volume;

void write(const std::filesystem::path &path, const std::string &text) {
    std::ofstream(path, std::ios::binary) << text;
}

template <class T> std::string bytesOf(std::initializer_list<T> values, bool swap = false) {
    std::string bytes;
    for (T value : values) {
        std::string one(reinterpret_cast<const char *>(&value), sizeof(T));
        if (swap)
            std::reverse(one.begin(), one.end());
        bytes += one;
    }
    return bytes;
}

class Nrrd : public testing::Test {
protected:
    test::TemporaryFolder folder;
};

TEST_F(Nrrd, RoundTripsBothTypesAndEncodingsOnATiltedLattice) {
    const auto lattice = test::tiltedLattice({5, 4, 3}, {0.7, 0.9, 2.5}, 20.0);
    const Volume floats = test::noiseField(lattice).values.samples();
    std::vector<std::int16_t> shorts(60);
    for (int n = 0; n < 60; ++n)
        shorts[n] = std::int16_t(n * 1000 - 30000);
    for (const auto encoding : {volume::NrrdEncoding::raw, volume::NrrdEncoding::gzip})
        for (const Volume &volume : {floats, Volume(lattice, shorts, volume::ValueUnit::none)}) {
            volume::writeNrrd(folder / "v.nrrd", volume, encoding);
            const Volume back = readVolumeFile(folder / "v.nrrd");
            EXPECT_EQ(back.isFloat(), volume.isFloat());
            for (int k = 0; k < 3; ++k)
                for (int i = 0; i < 5; ++i)
                    EXPECT_EQ(back.value({i, 2, k}), volume.value({i, 2, k}));
            for (int d = 0; d < 3; ++d)
                EXPECT_LT(glm::distance(back.lattice().step(d), lattice.step(d)), 1e-12);
            EXPECT_LT(glm::distance(back.lattice().origin().mm, lattice.origin().mm), 1e-12);
        }
}

TEST_F(Nrrd, ReadsEveryScalarTypeInBothByteOrders) {
    const auto check = [&]<class T>(T, const char *name) {
        for (const bool big : {false, true}) {
            write(folder / "t.nrrd", std::string("NRRD0004\ntype: ") + name +
                                         "\ndimension: 3\nsizes: 3 1 1\nencoding: raw\nendian: " +
                                         (big ? "big" : "little") + "\n\n" +
                                         bytesOf<T>({T(1), T(2), T(100)}, big));
            EXPECT_EQ(readVolumeFile(folder / "t.nrrd").value({2, 0, 0}), 100.0) << name << big;
        }
    };
    check(std::int8_t(), "int8");
    check(std::uint8_t(), "unsigned char");
    check(std::int16_t(), "short");
    check(std::uint16_t(), "ushort");
    check(std::int32_t(), "int");
    check(std::uint32_t(), "uint32_t");
    check(std::int64_t(), "long long");
    check(std::uint64_t(), "uint64");
    check(float(), "float");
    check(double(), "double");
}

TEST_F(Nrrd, SurplusAndNonFiniteSamplesAreReported) {
    const std::string header =
        "type: float\ndimension: 3\nsizes: 3 1 1\nendian: little\nspace: LPS\nencoding: ";
    constexpr float none = std::numeric_limits<float>::quiet_NaN(),
                    endless = std::numeric_limits<float>::infinity();
    const auto three = bytesOf<float>({1.0F, none, -endless}), four = three + bytesOf<float>({2});
    const std::vector<task::Reason> odd{task::because::samplesNotFinite(2)};
    const std::vector<task::Reason> both{task::because::moreSamplesThanDeclared, odd[0]};
    const auto warnings = [&](const std::string &name) {
        return readVolumeFile(folder / name).notes().warnings;
    };
    for (const auto &[samples, expected] : {std::pair(three, odd), std::pair(four, both)}) {
        write(folder / "raw.nrrd", "NRRD0001\n" + header + "raw\n\n" + samples);
        EXPECT_EQ(warnings("raw.nrrd"), expected);
        write(folder / "samples", samples);
        write(folder / "raw.nhdr", "NRRD0001\n" + header + "raw\ndata file: samples\n");
        EXPECT_EQ(warnings("raw.nhdr"), expected);
        gzFile gz = gzopen((folder / "samples.gz").string().c_str(), "wb");
        gzwrite(gz, samples.data(), unsigned(samples.size()));
        gzclose(gz);
        write(folder / "gzip.nhdr", "NRRD0001\n" + header + "gzip\ndata file: samples.gz\n");
        EXPECT_EQ(warnings("gzip.nhdr"), expected);
    }
    for (const auto &[units, isTaken] :
         {std::pair("\"mm\" \"mm\" \"mm\"", true), std::pair("\"mm\" \"m\" \"mm\"", false)}) {
        write(folder / "units.nrrd",
              "NRRD0004\n" + header + "raw\nspace units: " + units + "\n\n" + three);
        if (isTaken)
            EXPECT_NO_THROW(readVolumeFile(folder / "units.nrrd"));
        else
            EXPECT_THROW(readVolumeFile(folder / "units.nrrd"), task::Error);
    }
    write(folder / "axes.nrrd",
          "NRRD0004\n" + header + "raw\nunits: \"mm\" \"\" \"mm\"\n\n" + three);
    EXPECT_NO_THROW(readVolumeFile(folder / "axes.nrrd"));
    for (const char *units : {"units: \"um\" \"um\" \"um\"", "space units: m m m"}) {
        write(folder / "axes.nrrd", "NRRD0004\n" + header + "raw\n" + units + "\n\n" + three);
        EXPECT_THROW(readVolumeFile(folder / "axes.nrrd"), task::Error) << units;
    }
    write(folder / "twice.nrrd", "NRRD0001\nsizes: 1 1 1\n" + header + "raw\n\n" + three);
    EXPECT_THROW(readVolumeFile(folder / "twice.nrrd"), task::Error);
}

TEST_F(Nrrd, ASpaceOtherThanThePatientsIsReported) {
    for (const auto &[space, isNamed] : {std::pair("", false),
                                         {"space: scanner-xyz\n", false},
                                         {"space: 3D-right-handed\n", false},
                                         {"space: RAS\n", true}}) {
        write(folder / "space.nrrd", std::string("NRRD0004\ntype: uchar\ndimension: 3\n") + space +
                                         "sizes: 1 1 1\nencoding: raw\n\nv");
        EXPECT_EQ(readVolumeFile(folder / "space.nrrd").notes().warnings.empty(), isNamed) << space;
    }
}

TEST_F(Nrrd, LargeUnsignedShortsBecomeFloat) {
    write(folder / "u.nrrd",
          "NRRD0001\ntype: ushort\ndimension: 3\nsizes: 2 1 1\nencoding: raw\nendian: little\n\n" +
              bytesOf<std::uint16_t>({1, 65535}));
    const Volume volume = readVolumeFile(folder / "u.nrrd");
    EXPECT_TRUE(volume.isFloat());
    EXPECT_EQ(volume.value({1, 0, 0}), 65535.0);
}

TEST_F(Nrrd, ConvertsRasAndLasToLps) {
    const std::string rest = "type: uint8\ndimension: 3\nsizes: 1 1 1\nencoding: raw\nspace "
                             "directions: (2,0,0) (0,3,0) (0,0,4)\n"
                             "space origin: (10,20,30)\nspace: ";
    write(folder / "ras.nrrd", "NRRD0004\n" + rest + "right-anterior-superior\n\nx");
    write(folder / "las.nrrd", "NRRD0004\n" + rest + "LAS\n\nx");
    const auto ras = readVolumeFile(folder / "ras.nrrd").lattice(),
               las = readVolumeFile(folder / "las.nrrd").lattice();
    EXPECT_EQ(ras.origin().mm, glm::dvec3(-10, -20, 30));
    EXPECT_EQ(ras.step(0), glm::dvec3(-2, 0, 0));
    EXPECT_EQ(las.origin().mm, glm::dvec3(10, -20, 30));
    EXPECT_EQ(las.step(1), glm::dvec3(0, -3, 0));
}

TEST_F(Nrrd, ReadsDetachedGzipWithSpacings) {
    gzFile gz = gzopen((folder / "d.raw.gz").string().c_str(), "wb");
    gzwrite(gz, "abcdef", 6);
    gzclose(gz);
    write(folder / "d.nhdr",
          "NRRD0001\n# comment\ntype: unsigned char\ndimension: 3\nsizes: 3 2 1\nspacings: 1 2 3\n"
          "encoding: gzip\ndata file: ./d.raw.gz\n");
    const Volume volume = readVolumeFile(folder / "d.nhdr");
    EXPECT_EQ(volume.value({2, 1, 0}), double('f'));
    EXPECT_EQ(volume.lattice().spacingMm(2), 3.0);
}

// The data is stored, not deflated, so only the checksum at the end of the file reveals the change.
TEST_F(Nrrd, AFlippedByteOfCompressedSamplesIsNoticed) {
    gzFile gz = gzopen((folder / "f.raw.gz").string().c_str(), "wb0"); // stored
    gzwrite(gz, "abcdef", 6);
    gzclose(gz);
    const std::string header =
        "NRRD0001\ntype: unsigned char\ndimension: 3\nsizes: 3 2 1\nencoding: gzip\n"
        "data file: f.raw.gz\n";
    write(folder / "f.nhdr", header);
    EXPECT_EQ(readVolumeFile(folder / "f.nhdr").value({0, 0, 0}), double('a'));
    std::string bytes = test::readText(folder / "f.raw.gz");
    bytes[bytes.find("abcdef") + 2] = 'C';
    write(folder / "f.raw.gz", bytes);
    EXPECT_THROW(readVolumeFile(folder / "f.nhdr"), task::Error);
    bytes.resize(bytes.size() - 4); // truncated
    write(folder / "f.raw.gz", bytes);
    EXPECT_THROW(readVolumeFile(folder / "f.nhdr"), task::Error);
}

TEST_F(Nrrd, RefusesWhatItCannotReadAndNamesTheFile) {
    const std::string good =
        "type: short\ndimension: 3\nsizes: 4 4 4\nencoding: raw\nendian: little\n";
    const std::pair<const char *, std::string> cases[] = {
        {"magic", "NOTNRRD\n"},
        {"truncated", "NRRD0004\n" + good + "\nshort"},
        {"dimension",
         "NRRD0004\ntype: short\ndimension: 4\nsizes: 4 4 4 4\nencoding: raw\nendian: little\n\n"},
        {"type", "NRRD0004\ntype: block\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n\n"},
        {"encoding",
         "NRRD0004\ntype: short\ndimension: 3\nsizes: 4 4 4\nencoding: bzip2\nendian: little\n\n"},
        {"huge", "NRRD0004\ntype: short\ndimension: 3\nsizes: 400000 400000 400000\nencoding: "
                 "raw\nendian: little\n\n"},
        // 2^64 samples: the product of the sizes wraps to nothing.
        {"wraps", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 262144 262144 268435456\n"
                  "encoding: raw\n\n"},
        {"negative",
         "NRRD0004\ntype: short\ndimension: 3\nsizes: -4 4 4\nencoding: raw\nendian: little\n\n"},
        {"flat", "NRRD0004\n" + good + "space directions: (1,0,0) (2,0,0) (0,0,1)\n\n" +
                     std::string(128, 'x')},
        {"far", "NRRD0004\n" + good + "spacings: 1 1 1\nspace origin: (1e300,0,0)\n\n" +
                    std::string(128, 'x')},
        {"tiny", "NRRD0004\n" + good + "spacings: 1 1e-30 1\n\n" + std::string(128, 'x')},
        {"large", "NRRD0004\n" + good + "spacings: 1 1 1e30\n\n" + std::string(128, 'x')},
        {"gzip", "NRRD0004\ntype: short\ndimension: 3\nsizes: 4 4 4\nencoding: gzip\nendian: "
                 "little\n\n\x1f\x8b garbage"},
    };
    for (const auto &[name, text] : cases) {
        write(folder / name, text);
        try {
            readVolumeFile(folder / name);
            ADD_FAILURE() << name << " was read";
        } catch (const task::Error &error) {
            EXPECT_EQ(error.code(), task::ErrorCode::unusable) << name;
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        }
    }
    EXPECT_THROW(readVolumeFile(folder / "absent.nrrd"), task::Error);
}

// A header must not make the program show another file, read for ever or wait.
TEST_F(Nrrd, DataFilesAreBesideOrBelowTheHeader) {
    std::filesystem::create_directories(folder / "study/below");
    write(folder / "secret.raw", "abcdef");
    write(folder / "study/below/own.raw", "abcdef");
    std::vector<std::string> outside{"../secret.raw", (folder / "secret.raw").string(),
                                     "below/../../secret.raw", "/dev/zero"};
    std::error_code noLinks; // GCC's library makes none on Windows
    std::filesystem::create_symlink(folder / "secret.raw", folder / "study/link.raw", noLinks);
    if (!noLinks)
        outside.emplace_back("link.raw");
    const auto reasonFor = [&](const std::string &name) -> std::string {
        const auto path = folder / "study/h.nhdr";
        write(path, "NRRD0001\ntype: unsigned char\ndimension: 3\nsizes: 3 2 1\nencoding: raw\n"
                    "data file: " +
                        name + "\n");
        try {
            readVolumeFile(path);
        } catch (const task::Error &error) {
            return error.reason().english();
        }
        return "read";
    };
    EXPECT_EQ(reasonFor("below/own.raw"), "read");
    EXPECT_EQ(reasonFor("./below/../below/own.raw"), "read");
    for (const std::string &name : outside)
        EXPECT_EQ(reasonFor(name), "refers to a file outside its folder") << name;
    EXPECT_EQ(reasonFor("below"), "is not a regular file");
}

TEST_F(Nrrd, AnEndlessHeaderIsRefused) {
    write(folder / "line.nrrd", "NRRD0004\n" + std::string(3 << 20, 'x'));
    write(folder / "lines.nrrd", [] {
        std::string text = "NRRD0004\n";
        while (text.size() < (3U << 20))
            text += "# and on\n";
        return text;
    }());
    for (const char *const name : {"line.nrrd", "lines.nrrd"})
        EXPECT_THROW(readVolumeFileHeader(folder / name), task::Error) << name;
    ASSERT_EQ(std::system(("mkfifo '" + (folder / "pipe.nrrd").string() + "'").c_str()), 0);
    EXPECT_THROW(readVolumeFileHeader(folder / "pipe.nrrd"), task::Error);
}

} // namespace
} // namespace pellucid
