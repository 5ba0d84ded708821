// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <png.h>

#include "core/files/image_files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {

namespace {

constexpr int height = 37, width = 53;

// The header follows the signature, its length and its name: width, height, bits, colors.
std::vector<int> bitsAndColors(const std::filesystem::path &path) {
    std::ifstream file(path, std::ios::binary);
    file.seekg(24);
    return {file.get(), file.get()};
}

std::vector<std::uint8_t> readRgba(const std::filesystem::path &path) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_file(&image, path.string().c_str()), 0);
    image.format = PNG_FORMAT_RGBA;
    std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
    EXPECT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0);
    EXPECT_EQ(int(image.width), width);
    EXPECT_EQ(int(image.height), height);
    return pixels;
}

std::vector<std::uint8_t> gradient() {
    std::vector<std::uint8_t> rgba;
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const auto level = std::uint8_t(row * row + 3 * column);
            rgba.insert(rgba.end(), {level, level, level, 255});
        }
    return rgba;
}

TEST(Png, AGreyPictureIsWrittenAsGrey) {
    const test::TemporaryFolder folder;
    const auto rgba = gradient();
    files::writePng(folder / "grey.png", rgba, height, width);
    EXPECT_EQ(bitsAndColors(folder / "grey.png"), (std::vector<int>{8, PNG_COLOR_TYPE_GRAY}));
    EXPECT_EQ(readRgba(folder / "grey.png"), rgba);
}

// Viewers that manage colors need to know.
TEST(Png, EightBitsAreMarkedAsSrgb) {
    const test::TemporaryFolder folder;
    files::writePng(folder / "grey.png", gradient(), height, width);
    std::ifstream file(folder / "grey.png", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    EXPECT_NE(bytes.find("sRGB"), std::string::npos);
}

TEST(Png, OneColoredPixelMakesItRgb) {
    const test::TemporaryFolder folder;
    for (const std::size_t channel : {0U, 1U, 2U}) {
        auto rgba = gradient();
        rgba[4 * (height * width - 1) + channel] ^= 1;
        files::writePng(folder / "color.png", rgba, height, width);
        EXPECT_EQ(bitsAndColors(folder / "color.png"), (std::vector<int>{8, PNG_COLOR_TYPE_RGB}));
        EXPECT_EQ(readRgba(folder / "color.png"), rgba) << channel;
    }
}

TEST(Png, SixteenBitsKeepEveryValue) {
    const test::TemporaryFolder folder;
    std::vector<std::uint16_t> grey;
    for (int n = 0; n < height * width; ++n)
        grey.push_back(std::uint16_t(n * 33));
    files::writePng16(folder / "grey.png", grey, height, width);
    EXPECT_EQ(bitsAndColors(folder / "grey.png"), (std::vector<int>{16, PNG_COLOR_TYPE_GRAY}));
    const auto rgba = readRgba(folder / "grey.png");
    EXPECT_EQ(rgba.front(), 0);
    EXPECT_GT(rgba[4 * (height * width - 1)], 200);
}

} // namespace
} // namespace pellucid
