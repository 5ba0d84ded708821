// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <new>
#include <stdexcept>
#include <utility>

#include "core/task/reason.h"

namespace pellucid::task {

/// What went wrong, in the classes that a caller can act on.
enum class ErrorCode {
    internal,     ///< a fault of the program
    output,       ///< the result cannot be written
    usage,        ///< the request makes no sense
    unusable,     ///< a path is missing, empty, or holds nothing usable
    outOfMemory,  ///< the request needs more memory than there is or than was allowed
    noSuchDevice, ///< the requested engine does not exist here
};

/// A failure of the outside world: a file, a device, a limit. `what()` is one line of English that
/// names the path, if there is one, and the reason.
class Error : public std::runtime_error {
public:
    Error(ErrorCode code, Reason reason, std::filesystem::path path = {});

    ErrorCode code() const noexcept { return m_code; }
    const Reason &reason() const noexcept { return m_reason; }
    const std::filesystem::path &path() const noexcept { return m_path; }

private:
    ErrorCode m_code;
    Reason m_reason;
    std::filesystem::path m_path;
};

/// Whether it says that there is no memory, for an object or a thread; TBB says it in words.
bool isLackOfMemory(const std::exception &error);

/// What `work` gives. *Throws* Error{outOfMemory, reason} where it finds no memory.
template <class F> auto orOutOfMemory(const Reason &reason, F &&work) {
    try {
        return std::forward<F>(work)();
    } catch (const std::bad_alloc &) {
        throw Error(ErrorCode::outOfMemory, reason);
    }
}

} // namespace pellucid::task
