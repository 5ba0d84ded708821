// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/platform/windows/error.h"

namespace pellucid::platform {

/// A job, whose processes are killed when the handle is closed, and so when this program ends.
/// *Throws* std::system_error.
Handle newJob();
/// Limits a job to one process and its memory, and denies it the clipboard, other desktops and the
/// settings of the system. *Throws* std::system_error.
void limitToOneProcess(HANDLE job, std::size_t memoryBytes);

/// How a program is started.
struct Start {
    std::filesystem::path program;
    std::vector<std::wstring> arguments;
    std::vector<HandleView> inherited; ///< the only ones
    HANDLE input = nullptr, errors = nullptr;
    std::filesystem::path folder;
    std::wstring environment; ///< pairs, each ended by 0; empty: this program's own
    HANDLE job = nullptr;
    HANDLE token = nullptr; ///< the primary token of a helper; null: this program's
    /// What its first thread may do until it gives it up; none: what the token allows.
    HANDLE firstToken = nullptr;
};

/// Starts a program without a window. *Throws* std::system_error.
Handle start(const Start &start);

/// The same handle for a program that inherits it.
Handle inheritable(HandleView handle);

/// The exit status of a process that its Watch has ended.
inline constexpr UINT endedByWatch = 0x50454C01;

} // namespace pellucid::platform
