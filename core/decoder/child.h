// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <sys/types.h>

#include "core/decoder/channel.h"
#include "core/task/progress.h"

namespace pellucid::decoder {

/// One decoding process and the arena that it answers in. One request at a time. What goes wrong in
/// the middle of one leaves it unusable: `isSound` says whether it may be asked again.
class Child {
public:
    /// *Throws* Error{internal} if the program cannot be started or is not a decoder.
    explicit Child(const std::filesystem::path &program, const task::Progress &progress = {});
    ~Child();
    Child(const Child &) = delete;
    Child &operator=(const Child &) = delete;

    struct Answer {
        Message message;
        std::span<const std::byte> body; ///< a copy: it stays as it is
        std::span<const std::byte> data; ///< in the arena
    };
    /// Begins a request. *Throws* Error{unusable} if the process has ended meanwhile.
    /// The request's `size` is that of the file.
    void ask(const Message &request, int file);
    /// The next part, of an archive or of samples.
    void askForNext();
    /// Waits for the answer, which is a `part` or `done`. *Throws* Error{unusable, outOfMemory}
    /// with the reason that the decoder gives, or that it crashed, hung, or asked for too much;
    /// Cancelled.
    Answer answer(const task::Progress &progress);

    bool isSound() const { return m_isSound; }
    int confinement() const { return m_confinement; }
    /// It has had an image so large that its memory is better given back.
    bool isLarge() const;

    std::uint64_t opening = 0; ///< whose files it has read

private:
    Child();
    void start(const std::filesystem::path &program, const task::Progress &progress);
    void allow(double seconds);
    bool waitForMessage(const task::Progress &progress) const;
    [[noreturn]] void failAsItEnded();
    bool grow(std::uint64_t bytes);
    Answer take(const Message &message);

    pid_t m_pid = -1;
    Descriptor m_socket, m_arena;
    Mapping m_mapped;
    std::uint64_t m_arenaBytes = 0, m_grantedBytes = 0;
    std::string m_body;
    std::chrono::steady_clock::time_point m_end; ///< when patience ends
    bool m_isSound = false;
    int m_confinement = 0;
};

/// What a request may take of the processor, after which a decoder gives itself up, and how long
/// the program waits for it: files may come slowly. *Units*: seconds.
double decodingSeconds(const Message &request);
double waitingSeconds(const Message &request);

} // namespace pellucid::decoder
