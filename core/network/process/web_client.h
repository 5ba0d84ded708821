// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "core/network/client/message.h"
#include "core/network/process/control.h"
#include "core/network/process/http.h"

namespace pellucid::network::process {

/// A connection to a DICOMweb service (PS3.18). All requests *throw* Lost if
/// the connection fails, also when the server closes it between requests; Error{unusable} if the
/// server refuses; Disconnected; CancelledByProgram.
class WebClient {
public:
    /// *Throws* Lost, Error{usage} with the file that cannot be read.
    WebClient(const Connection &connection, Control &control);

    int confinement() const { return m_http.confinement(); }

    void echo(Control &control);
    QueryEnd find(const Query &query, Control &control);
    RetrievalEnd retrieve(const Retrieval &retrieval, Control &control);
    /// STOW-RS of an open file of this size. *Returns* how the server changed the object; nothing
    /// if it stored it unchanged.
    std::optional<task::Reason> store(platform::HandleView file, std::uint64_t bytes,
                                      Control &control);

private:
    class Objects;
    struct Fetched {
        HttpClient::Answer answer;
        bool isWhole;
    };
    /// Passes on the objects at a path.
    Fetched fetch(const std::string &path, Objects &objects);

    std::string m_path; ///< of the service
    HttpClient m_http;
    // What this server has been found not to know, or to know.
    bool m_asksPlainly = false;   ///< no attributes by name
    bool m_namesAnySyntax = true; ///< the asterisk
    bool m_sendsInstances = false;
};

} // namespace pellucid::network::process
