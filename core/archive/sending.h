// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "core/archive/server.h"
#include "core/dicom/catalogue.h"
#include "core/task/progress.h"

namespace pellucid::archive {

struct SendingState {
    std::size_t files = 0, sent = 0;
    std::uint64_t bytes = 0;
};

struct SendingReport {
    SendingState state;
    double seconds = 0.0;
    std::vector<dicom::Skipped> notSent; ///< each with its reason
};

/// Sends DICOM files to a server, each confirmed by it. Compressed files stay compressed. *Throws*
/// Error{unreachable} if the server cannot be reached at all, as exchange::Link otherwise;
/// Cancelled.
SendingReport send(const Server &server, const std::vector<std::filesystem::path> &files,
                   const std::function<void(const SendingState &)> &changed = {},
                   const task::Progress &progress = {});

} // namespace pellucid::archive
