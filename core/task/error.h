// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <new>
#include <stdexcept>
#include <utility>

#include "core/task/reason.h"

namespace pellucid::task {

/// Classes of failures that a caller can act on.
enum class ErrorCode {
    internal,     ///< a bug in the program
    output,       ///< the result cannot be written
    usage,        ///< the request makes no sense
    unusable,     ///< a path is missing, empty, or has nothing usable
    outOfMemory,  ///< the request needs more memory than is available or allowed
    noSuchDevice, ///< the requested engine does not exist on this machine
    unreachable,  ///< a server cannot be reached, or cannot reach this program
    incomplete,   ///< part of what was requested is missing
};

/// An external failure: a file, a device, a limit. `what()` is one line of English with the path,
/// if there is one, and the reason.
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

/// Whether it reports a lack of memory, for an object or a thread; TBB only has a text for it.
bool isLackOfMemory(const std::exception &error);

/// Returns the result of `work`, a reference as a reference. *Throws* Error{outOfMemory, reason} if
/// `work` runs out of memory; otherwise what `work` throws.
template <class F> decltype(auto) orOutOfMemory(const Reason &reason, F &&work) {
    try {
        return std::forward<F>(work)();
    } catch (const std::bad_alloc &) {
        throw Error(ErrorCode::outOfMemory, reason);
    }
}

} // namespace pellucid::task
