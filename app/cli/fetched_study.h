// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "app/cli/commands.h"
#include "core/files/session_folder.h"

namespace pellucid::cli {

/// The options that name a study on a server.
struct RemoteOptions {
    std::string server, studyUid;

    bool isGiven() const { return !server.empty(); }
};

/// Adds --from and --study, which replace the command's PATH.
void addRemoteOptions(CLI::App &command, RemoteOptions &options, CLI::Option &path);

/// *Throws* Error{usage} if a command has neither a PATH nor a server.
void requirePathOrServer(bool hasPath, const RemoteOptions &options);

/// A study, or one series of it, that was retrieved from a server into a private folder. The folder
/// is removed with the object.
class FetchedStudy {
public:
    /// `series`: its number or UID; empty: all of them. *Throws* Error{usage} if there is no such
    /// server, or a UID is none; Error{unusable} if the server has no such study or series;
    /// Error{incomplete} if not all of it arrived; as archive::retrieve otherwise.
    FetchedStudy(const RemoteOptions &remote, const std::string &series, const Context &context);

    const std::filesystem::path &path() const { return m_folder.path(); }

private:
    files::SessionFolder m_folder;
};

} // namespace pellucid::cli
