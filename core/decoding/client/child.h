// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "core/decoding/client/channel.h"
#include "core/files/mapping.h"
#include "core/platform/helper.h"
#include "core/platform/shared_memory.h"
#include "core/task/progress.h"

namespace pellucid::decoding {

/// A decoding process and the arena for its answers. One request at a time. A failure within a
/// request leaves it unusable: `isUsable` tells whether it may be asked again.
class Child {
public:
    /// *Throws* Error{internal} if the program cannot be started or is not a decoder.
    explicit Child(const std::filesystem::path &program, const task::Progress &progress = {});
    ~Child();
    Child(const Child &) = delete;
    Child &operator=(const Child &) = delete;

    struct Answer {
        Message message;
        std::span<const std::byte> body; ///< a copy, which the process cannot change
        std::span<const std::byte> data; ///< in the arena
    };
    /// Starts a request. *Throws* Error{unusable} if the process has ended meanwhile. The request's
    /// `size` is that of the file.
    void ask(const Message &request, HandleView file);
    /// Asks for the next part of an archive or of samples.
    void requestNext();
    /// Waits for the answer, which is a `part` or `done`. *Throws* Error{unusable, outOfMemory}
    /// with the reason that the decoder reports, or that it crashed, hung, or asked for too much
    /// memory; Cancelled.
    Answer answer(const task::Progress &progress);

    bool isUsable() const { return m_isUsable; }
    int confinement() const { return m_confinement; }
    /// Its last image was so large that its memory should be released.
    bool isLarge() const;

    std::uint64_t opening = 0; ///< number of the opening whose files it has read

private:
    Child();
    void start(const std::filesystem::path &program, const task::Progress &progress);
    void allow(double seconds);
    bool waitForMessage(const task::Progress &progress) const;
    [[noreturn]] void failByExitStatus();
    /// Whether it is granted, with the arena's handle if that is another one now.
    std::optional<HandleView> grow(std::uint64_t bytes);
    Answer take(const Message &message);

    platform::Helper m_process;
    platform::SharedMemory m_arena;
    files::Mapping m_mapped;
    std::uint64_t m_grantedBytes = 0;
    std::string m_body;
    std::chrono::steady_clock::time_point m_end; ///< deadline
    bool m_isUsable = false;
    int m_confinement = 0;
};

/// The processor time after which a decoder gives up on a request, and the time for which the
/// program waits, which is longer because files may arrive slowly. *Units*: seconds.
double decodingSeconds(const Message &request);
double waitingSeconds(const Message &request);

} // namespace pellucid::decoding
