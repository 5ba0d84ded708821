// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string>

#include "core/network/client/message.h"
#include "core/task/error.h"

namespace pellucid::network::process {

/// The program has closed its end, or sent something else than it should.
struct Disconnected {};

/// Thrown in place of an answer when the program cancels a request.
struct CancelledByProgram {};

/// The start of a text in UTF-8, at most so many bytes.
std::string shortened(const std::string &text, std::size_t bytes);
inline constexpr std::size_t longestComment = 1024; ///< of a server's comment

/// This process's end of the messages. Sending and waiting *throw* Disconnected.
class Control {
public:
    explicit Control(const platform::Channel &channel) : m_channel(channel) {}

    const platform::Channel &channel() const { return m_channel; }
    void send(const Message &message);
    Packet wait();
    /// Whether the program has asked to cancel. Any other message would be lost; the program sends
    /// none while a request runs.
    bool isCancelled();

    /// Tells the program that work goes on, once a second. `bytes`: of the current object so far.
    void heartbeat(std::uint64_t bytes = 0);
    void step(Step step, const std::string &found);
    /// Passes on an answer of a server: the keys that the query asked for, and where the study is.
    /// Long values are cut, so that every answer fits into a message.
    void match(const Query &query, Attributes attributes);
    void done(const std::string &body = {});
    void failed(Failure failure, const task::Reason &reason);

private:
    const platform::Channel &m_channel;
    std::chrono::steady_clock::time_point m_lastBeat = std::chrono::steady_clock::now();
};

/// An object on its way into a file that the program opens.
class Storage {
public:
    /// Asks the program for the file. *Throws* Disconnected, CancelledByProgram.
    Storage(Control &control, const Arrival &arrival);

    /// Whether the program wants it; if not, `status` is the answer to the sender.
    bool isWanted() const { return bool(m_file); }
    std::uint16_t status() const { return m_status; }

    /// Continues after a failure without writing, so that the object's bytes are still taken from
    /// the network.
    void write(std::span<const std::byte> bytes);
    /// Tells the program that the object is complete. *Shape*: the status for the sender.
    /// *Throws* as the constructor.
    std::uint16_t finish();

private:
    Packet answer();

    Control &m_control;
    platform::Handle m_file;
    std::uint16_t m_status = 0;
    std::uint64_t m_bytes = 0, m_reported = 0;
    bool m_hasFailed = false;
};

} // namespace pellucid::network::process
