// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/descriptor.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/files/reasons.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::files {

Descriptor::~Descriptor() {
    if (m_fd >= 0)
        ::close(m_fd);
}

Descriptor openRegular(const std::filesystem::path &path) {
    Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
    struct stat about {};
    if (!file || ::fstat(file.get(), &about) != 0)
        throw task::Error(task::ErrorCode::unusable,
                          errno == ENOENT ? task::because::doesNotExist : task::systemReason(errno),
                          path);
    if (!S_ISREG(about.st_mode))
        throw task::Error(task::ErrorCode::unusable, task::because::isNotARegularFile, path);
    return file;
}

} // namespace pellucid::files
