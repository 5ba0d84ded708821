// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "core/network/process/association.h"

class DcmDataset;
struct T_DIMSE_Message;
struct T_DIMSE_C_StoreRQ;

namespace pellucid::network::process {

// What clients' and servers' requests share.

/// A command that has come, with the number of its presentation context and, in an answer, the
/// server's comment.
struct Command {
    Command();
    ~Command();
    Command(Command &&) noexcept;
    std::unique_ptr<T_DIMSE_Message> message;
    unsigned char context = 0;
    std::string comment;
};

/// Waits for the next command. *Returns* nothing if the program cancels. *Throws* Lost.
std::optional<Command> nextCommand(Association &association, Control &control);

/// Receives the data set after a command. *Throws* Lost.
std::unique_ptr<DcmDataset> receiveDataset(Association &association, unsigned char context);

/// Receives an object into a file of the program and answers its sender. *Throws* Lost,
/// Disconnected, CancelledByProgram.
void receiveObject(Association &association, unsigned char context,
                   const T_DIMSE_C_StoreRQ &request, Control &control);

int patienceOf(const Association &association);

} // namespace pellucid::network::process
