// SPDX-License-Identifier: GPL-3.0-or-later
#include <cassert>
#include <vector>

#include <png.h>

#include "core/files/atomic_file.h"
#include "core/files/image_files.h"
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

} // namespace pellucid::files
