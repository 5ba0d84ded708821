// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/network/client/message.h"
#include "core/network/process/control.h"
#include "core/network/process/transport.h"

struct T_ASC_Association;
struct T_ASC_Network;
struct T_ASC_Parameters;

namespace pellucid::network::process {

/// Why there is no association, or no longer. Its reason is for the user.
struct Lost {
    task::Reason reason;
};

/// A DICOM association, of one thread and one process (PS3.8).
class Association {
public:
    /// Connects to the server, confines this process before it reads the first byte, and negotiates
    /// for the purpose: one presentation context for each kind of object and transfer syntax,
    /// because servers choose from a list, and convert. Reports its steps. *Throws* Lost;
    /// Error{usage} with the file that cannot be read.
    Association(const Connection &connection, Control &control);
    /// Answers a client through a connected socket; confines this process as well. Offers storage
    /// and verification. *Throws* the same.
    Association(const Acceptance &acceptance, platform::HandleView socket, Control &control);
    ~Association();
    Association(const Association &) = delete;
    Association &operator=(const Association &) = delete;

    T_ASC_Association *get() const { return m_association; }
    int confinement() const { return m_confinement; }
    double silenceSeconds() const { return m_silenceSeconds; }
    const std::string &characterSet() const { return m_characterSet; }
    const std::string &callingAe() const { return m_callingAe; }

    /// The number of the context for a kind of object. *Throws* Error{unusable} if the server does
    /// not offer it.
    unsigned char contextFor(const std::string &sopClassUid) const;
    std::optional<unsigned char> contextFor(const Encoding &encoding) const;
    std::string syntaxOf(unsigned char context) const;
    /// Whether the server refuses a kind of object in every encoding, and does not blame the
    /// encodings (PS3.8, table 9-18).
    bool isClassRefused(const std::string &sopClassUid) const;

    /// Waits for the next command. *Shape*: false if the program cancels meanwhile; the command may
    /// then still come. *Throws* Lost if nothing comes.
    enum class Event { data, cancel };
    Event wait(Control &control) const;
    [[noreturn]] void fail(const char *text) const;
    void abort();
    /// Ends it in order.
    void release();

private:
    void negotiate(const Connection &connection);
    [[noreturn]] void failRequest(const std::string &text, bool usesTls) const;
    /// Accepts objects of all kinds, and reports what is refused.
    void acceptContexts(Control &control);

    std::string m_characterSet, m_callingAe;
    double m_silenceSeconds;
    int m_confinement = 0;
    std::unique_ptr<Transport> m_transport;
    T_ASC_Network *m_network = nullptr;
    T_ASC_Parameters *m_parameters = nullptr;
    T_ASC_Association *m_association = nullptr;
};

} // namespace pellucid::network::process
