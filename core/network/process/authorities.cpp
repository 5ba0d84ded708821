// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/authorities.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "core/network/process/reasons.h"
#include "core/platform/authorities.h"
#include "core/task/error.h"

namespace pellucid::network::process {

namespace because = task::because;

std::string pemText(const std::string &path) {
    std::ifstream in(path, std::ios::binary);
    if (!in)
        throw task::Error(task::ErrorCode::usage, because::isNoPemFile(std::strerror(errno)), path);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string authorityCertificates(const std::string &path) {
    if (!path.empty())
        return pemText(path);
    std::string system = platform::systemAuthorities();
    if (system.empty())
        throw task::Error(task::ErrorCode::usage, because::systemTrustsNobody);
    return system;
}

} // namespace pellucid::network::process
