// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/task/error.h"

namespace pellucid::task {

Error::Error(ErrorCode code, std::string reason, std::filesystem::path path)
    : std::runtime_error(path.empty() ? reason : path.string() + ": " + reason), m_code(code),
      m_reason(std::move(reason)), m_path(std::move(path)) {}

} // namespace pellucid::task
