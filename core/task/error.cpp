// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/task/error.h"

namespace pellucid::task {

Error::Error(ErrorCode code, std::string reason, std::filesystem::path path)
    : std::runtime_error(path.empty() ? reason : path.string() + ": " + reason), m_code(code),
      m_reason(std::move(reason)), m_path(std::move(path)) {}

bool isLackOfMemory(const std::system_error &error) {
    return error.code() == std::errc::resource_unavailable_try_again ||
           error.code() == std::errc::not_enough_memory;
}

} // namespace pellucid::task
