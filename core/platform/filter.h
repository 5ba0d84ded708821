// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/platform/handle.h"
#include "core/platform/marked_folder.h"

namespace pellucid::platform {

/// A program of the user, such as an encoder, that processes its standard input. It is killed with
/// its owner.
class Filter {
public:
    /// Starts it in a folder, where `messages` is the file that it reports errors to. *Throws*
    /// std::system_error.
    Filter(const std::filesystem::path &program, const std::vector<std::string> &arguments,
           const MarkedFolder &folder, const std::string &messages);
    ~Filter();
    Filter(const Filter &) = delete;
    Filter &operator=(const Filter &) = delete;

    /// Writes what it takes within so many milliseconds. *Returns* how many bytes. *Throws*
    /// std::system_error if it reads no more.
    std::size_t write(std::span<const std::byte> bytes, int milliseconds);
    void closeInput() { m_input = Handle(); }
    /// Whether it has ended well; nothing while it runs.
    std::optional<bool> ended();

private:
    Handle m_input;
    Handle m_group; ///< ends the process with this program, where the system has such things
    Native m_process = -1;
};

/// The program of this name that the user's search path finds; empty if there is none.
std::filesystem::path findOnSearchPath(const std::string &name);

} // namespace pellucid::platform
