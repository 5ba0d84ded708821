// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <gtest/gtest.h>
#include <jxl/encode.h>

#include "tests/support/dicom_writer.h"

namespace pellucid::test {

/// A frame as lossless JPEG XL, the content of one fragment. *Shape*: `pixels` are 16-bit samples
/// of which `bits` are used.
inline std::string jpegXl(const std::string &pixels, int rows, int columns, int bits) {
    const std::unique_ptr<JxlEncoder, void (*)(JxlEncoder *)> encoder(JxlEncoderCreate(nullptr),
                                                                      JxlEncoderDestroy);
    JxlBasicInfo info;
    JxlEncoderInitBasicInfo(&info);
    info.xsize = std::uint32_t(columns);
    info.ysize = std::uint32_t(rows);
    info.bits_per_sample = std::uint32_t(bits);
    info.num_color_channels = 1;
    info.uses_original_profile = JXL_TRUE;
    EXPECT_EQ(JxlEncoderSetBasicInfo(encoder.get(), &info), JXL_ENC_SUCCESS);
    JxlColorEncoding color;
    JxlColorEncodingSetToLinearSRGB(&color, JXL_TRUE);
    EXPECT_EQ(JxlEncoderSetColorEncoding(encoder.get(), &color), JXL_ENC_SUCCESS);
    JxlEncoderFrameSettings *const settings = JxlEncoderFrameSettingsCreate(encoder.get(), nullptr);
    EXPECT_EQ(JxlEncoderSetFrameLossless(settings, JXL_TRUE), JXL_ENC_SUCCESS);
    // The encoder takes samples of fewer bits scaled to 16.
    std::vector<std::uint16_t> scaled(std::size_t(rows) * std::size_t(columns));
    std::memcpy(scaled.data(), pixels.data(), pixels.size());
    for (auto &sample : scaled)
        sample = std::uint16_t(std::lround(sample * (65535.0 / (std::exp2(bits) - 1.0))));
    const JxlPixelFormat format{1, JXL_TYPE_UINT16, JXL_LITTLE_ENDIAN, 0};
    EXPECT_EQ(JxlEncoderAddImageFrame(settings, &format, scaled.data(), 2 * scaled.size()),
              JXL_ENC_SUCCESS);
    JxlEncoderCloseInput(encoder.get());
    std::string out(1 << 20, '\0');
    auto *next = reinterpret_cast<std::uint8_t *>(out.data());
    std::size_t left = out.size();
    EXPECT_EQ(JxlEncoderProcessOutput(encoder.get(), &next, &left), JXL_ENC_SUCCESS);
    out.resize(out.size() - left);
    return out;
}

/// A frame in run lengths that are all literal: the high bytes, then the low bytes, each without
/// the last `missing` ones.
inline std::string runLengths(const std::string &pixels, std::size_t missing = 0) {
    const std::size_t plane = pixels.size() / 2;
    std::string body;
    std::vector<std::uint32_t> offsets;
    for (const std::size_t byte : {1U, 0U}) {
        offsets.push_back(std::uint32_t(64 + body.size()));
        for (std::size_t n = 0; n < plane - missing; n += 128) {
            const std::size_t run = std::min<std::size_t>(128, plane - missing - n);
            body += char(run - 1);
            for (std::size_t m = 0; m < run; ++m)
                body += pixels[2 * (n + m) + byte];
        }
        if (body.size() % 2 != 0)
            body += '\0';
    }
    std::string header = DicomWriter::number(std::uint32_t(2));
    for (int n = 0; n < 15; ++n)
        header += DicomWriter::number(n < 2 ? offsets[std::size_t(n)] : std::uint32_t(0));
    return header + body;
}

/// A minimal Siemens header of named values (CSA).
inline std::string csaHeader(int images, const glm::dvec3 &normal) {
    std::string bytes = "SV10" + std::string("\4\3\2\1", 4) +
                        DicomWriter::number(std::uint32_t(2)) +
                        DicomWriter::number(std::uint32_t(77));
    const auto add = [&](std::string name, const std::vector<std::string> &values) {
        name.resize(64, '\0');
        bytes += name + DicomWriter::number(std::uint32_t(values.size())) +
                 std::string("FD\0\0", 4) + DicomWriter::number(std::uint32_t(4)) +
                 DicomWriter::number(std::uint32_t(values.size())) +
                 DicomWriter::number(std::uint32_t(77));
        for (std::string value : values) {
            const auto size = std::uint32_t(value.size());
            for (int n = 0; n < 4; ++n)
                bytes += DicomWriter::number(n == 2 ? std::uint32_t(77) : size);
            value.resize((value.size() + 3) / 4 * 4, '\0');
            bytes += value;
        }
    };
    add("NumberOfImagesInMosaic", {std::to_string(images)});
    add("SliceNormalVector",
        {std::to_string(normal.x), std::to_string(normal.y), std::to_string(normal.z)});
    return bytes;
}

/// Eleven slices of 10 x 8 in a mosaic of 4 x 4 tiles, from the top down.
inline SeriesKnobs mosaicKnobs() {
    SeriesKnobs knobs;
    knobs.slices = 1;
    knobs.rows = 32;
    knobs.columns = 40;
    knobs.modality = "MR";
    knobs.value = [](int i, int j, int) {
        const int tile = j / 8 * 4 + i / 10;
        return tile < 11 ? 100 * tile + 10 * (j % 8) + i % 10 : 0;
    };
    knobs.change = [](DicomWriter &w, int) {
        w.put({0x0008, 0x0008}, "CS", std::string("ORIGINAL\\PRIMARY\\M\\ND\\MOSAIC"));
        w.putNumbers({0x0018, 0x0088}, {3.5});
        w.put({0x0029, 0x0010}, "LO", std::string("SIEMENS CSA HEADER"));
        w.put({0x0029, 0x1010}, "OB", csaHeader(11, {0.0, 0.0, -1.0}));
    };
    return knobs;
}

} // namespace pellucid::test
