// SPDX-License-Identifier: GPL-3.0-or-later
#include <cassert>
#include <csetjmp>
#include <string>
#include <vector>

#include <png.h>

#include "core/files/atomic_file.h"
#include "core/files/image_files.h"
#include "core/files/reasons.h"
#include "core/task/error.h"

namespace pellucid::files {

void writePng(const std::filesystem::path &path, std::span<const std::uint8_t> rgba, int height,
              int width) {
    assert(rgba.size() == std::size_t(height) * width * 4);
    std::vector<std::uint8_t> rgb(std::size_t(height) * width * 3);
    for (std::size_t n = 0; n < rgb.size() / 3; ++n)
        for (int c = 0; c < 3; ++c)
            rgb[3 * n + c] = rgba[4 * n + c];
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = png_uint_32(width);
    image.height = png_uint_32(height);
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<std::byte> encoded(bytes);
    if (png_image_write_to_memory(&image, encoded.data(), &bytes, 0, rgb.data(), 0, nullptr) == 0)
        throw task::Error(task::ErrorCode::output, task::because::cannotBeEncoded(image.message),
                          path);
    AtomicFile file(path);
    file.write(std::span(encoded).first(bytes));
    file.commit();
}

void writePng16(const std::filesystem::path &path, std::span<const std::uint16_t> grey, int height,
                int width) {
    assert(grey.size() == std::size_t(height) * width);
    // Not by png_image: it takes values of 16 bits for light, and marks the file so.
    struct Writer {
        png_structp png = nullptr;
        png_infop info = nullptr;
        ~Writer() { png_destroy_write_struct(&png, &info); }
    };
    std::string failure, encoded;
    const auto refuse = [](png_structp png, png_const_charp message) {
        *static_cast<std::string *>(png_get_error_ptr(png)) = message;
        png_longjmp(png, 1);
    };
    std::vector<std::uint8_t> bytes; // the most significant first
    bytes.reserve(2 * grey.size());
    for (const std::uint16_t value : grey) {
        bytes.push_back(std::uint8_t(value >> 8));
        bytes.push_back(std::uint8_t(value & 0xff));
    }
    Writer writer;
    writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure, refuse, nullptr);
    writer.info = png_create_info_struct(writer.png);
    if (setjmp(png_jmpbuf(writer.png)) != 0)
        throw task::Error(task::ErrorCode::output, task::because::cannotBeEncoded(failure), path);
    png_set_write_fn(
        writer.png, &encoded,
        [](png_structp png, png_bytep data, png_size_t size) {
            static_cast<std::string *>(png_get_io_ptr(png))
                ->append(reinterpret_cast<const char *>(data), size);
        },
        [](png_structp) {});
    png_set_IHDR(writer.png, writer.info, png_uint_32(width), png_uint_32(height), 16,
                 PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_write_info(writer.png, writer.info);
    for (int row = 0; row < height; ++row)
        png_write_row(writer.png, bytes.data() + std::size_t(row) * std::size_t(width) * 2);
    png_write_end(writer.png, writer.info);
    AtomicFile file(path);
    file.write(encoded);
    file.commit();
}

} // namespace pellucid::files
