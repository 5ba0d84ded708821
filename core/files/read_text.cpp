// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/read_text.h"

#include <span>
#include <system_error>

#include "core/files/open_regular.h"
#include "core/files/reasons.h"
#include "core/task/error.h"

namespace pellucid::files {

std::string readText(const std::filesystem::path &path, std::size_t maxBytes) {
    const RegularFile file = openRegular(path);
    // The file's size may change, so the bytes read are counted.
    constexpr std::size_t block = 1 << 16;
    std::string text;
    for (std::size_t got = 1; got > 0;) {
        const std::size_t before = text.size();
        text.resize(before + block);
        try {
            got = platform::readSome(file.handle,
                                     std::as_writable_bytes(std::span(text)).subspan(before));
        } catch (const std::system_error &error) {
            throw task::Error(task::ErrorCode::unusable, task::systemReason(error.code()), path);
        }
        text.resize(before + got);
        if (text.size() > maxBytes)
            throw task::Error(task::ErrorCode::unusable,
                              task::because::isTooLargeForItsKind(maxBytes >> 20), path);
    }
    return text;
}

} // namespace pellucid::files
