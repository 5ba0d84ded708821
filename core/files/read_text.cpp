// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/read_text.h"

#include <cerrno>
#include <unistd.h>

#include "core/files/descriptor.h"
#include "core/files/reasons.h"
#include "core/task/error.h"

namespace pellucid::files {

std::string readText(const std::filesystem::path &path, std::size_t maxBytes) {
    const Descriptor file = openRegular(path);
    // The file's size may change, so the bytes read are counted.
    constexpr std::size_t block = 1 << 16;
    std::string text;
    for (;;) {
        const std::size_t before = text.size();
        text.resize(before + block);
        const ssize_t got = ::read(file.get(), text.data() + before, block);
        if (got < 0 && errno != EINTR)
            throw task::Error(task::ErrorCode::unusable, task::systemReason(errno), path);
        text.resize(before + std::size_t(got < 0 ? 0 : got));
        if (got == 0)
            return text;
        if (text.size() > maxBytes)
            throw task::Error(task::ErrorCode::unusable,
                              task::because::isTooLargeForItsKind(maxBytes >> 20), path);
    }
}

} // namespace pellucid::files
