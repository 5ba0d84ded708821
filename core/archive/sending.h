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
    std::size_t uncompressed = 0;        ///< of those sent, see Server::mayUncompress
    std::vector<dicom::Skipped> notSent; ///< each with its reason
    /// Sent, but the server has changed or left out something of them.
    std::vector<dicom::Skipped> withChanges;
    /// Files of other kinds in folders and archives, such as texts.
    std::vector<dicom::Skipped> leftOut;
};

/// Sends DICOM files to a server, each confirmed by it: those that the paths name, and those in
/// folders, DICOMDIRs and archives that they name. Compressed files stay compressed, unless the
/// server does not accept their encoding and may get them uncompressed. *Throws*
/// Error{unusable} if a path does not exist or contains no DICOM file; Error{unreachable} if the
/// server cannot be reached at all, as network::Link otherwise; Cancelled.
SendingReport send(const Server &server, const std::vector<std::filesystem::path> &paths,
                   const std::function<void(const SendingState &)> &changed = {},
                   const task::Progress &progress = {});

} // namespace pellucid::archive
