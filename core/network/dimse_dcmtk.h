// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/network/association.h"

class DcmDataset;
struct T_DIMSE_Message;
struct T_DIMSE_C_StoreRQ;

namespace pellucid::network {

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

/// Waits for the next command. *Shape*: nothing if the program cancels. *Throws* Lost.
std::optional<Command> nextCommand(Association &association, Control &control);

/// Receives the data set after a command. *Throws* Lost.
std::unique_ptr<DcmDataset> receiveDataset(Association &association, unsigned char context);

/// Receives an object into a file of the program and answers its sender. *Throws* Lost,
/// Disconnected, CancelledByProgram.
void receiveObject(Association &association, unsigned char context,
                   const T_DIMSE_C_StoreRQ &request, Control &control);

int patienceOf(const Association &association);

/// A command set, whose elements are in implicit VR little endian (PS3.7, 6.3.1), before bytes that
/// DCMTK does not touch.
class CommandSet {
public:
    /// *Requires*: rising elements of group 0000.
    void put(std::uint16_t element, std::string value);
    void put(std::uint16_t element, std::uint16_t value);
    /// With the length of the group.
    std::string bytes() const;

private:
    std::string m_elements;
};

/// Sends a command set or a data set, in fragments as long as the other side takes (PS3.8, annex
/// E). *Throws* Lost, Disconnected.
enum class Fragments { ofCommand, ofDataSet };
void sendFragments(Association &association, unsigned char context, Fragments kind,
                   std::span<const std::byte> bytes, Control &control);

} // namespace pellucid::network
