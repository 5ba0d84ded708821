// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace pellucid::task {

/// What went wrong, in the classes that a caller can act on. The values are the exit codes of the
/// command line.
enum class ErrorCode {
    internal = 1,     ///< a fault of the program
    output = 1,       ///< the result cannot be written
    usage = 2,        ///< the request makes no sense
    unusable = 3,     ///< a path is missing, empty, or holds nothing usable
    outOfMemory = 4,  ///< the request needs more memory than there is or than was allowed
    noSuchDevice = 5, ///< the requested engine does not exist here
};

/// A failure of the outside world: a file, a device, a limit. `what()` is one line that names the
/// path, if there is one, and the reason.
class Error : public std::runtime_error {
public:
    Error(ErrorCode code, std::string reason, std::filesystem::path path = {});

    ErrorCode code() const noexcept { return m_code; }
    /// The reason without the path.
    const std::string &reason() const noexcept { return m_reason; }
    const std::filesystem::path &path() const noexcept { return m_path; }

private:
    ErrorCode m_code;
    std::string m_reason;
    std::filesystem::path m_path;
};

/// Whether it says that there is no memory, for an object or a thread; TBB says it in words.
bool isLackOfMemory(const std::exception &error);

} // namespace pellucid::task
