// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>

#include "core/platform/channel.h"
#include "core/platform/handle.h"

namespace pellucid::platform {

/// How a helper has ended, and the system's number for it, for the log.
struct Ending {
    enum class How {
        byItself,
        tookTooLong,      ///< ended by its Watch
        lostAFile,        ///< a file that it was reading became shorter or went away
        wasKilled,        ///< as the system does if memory runs out
        brokeConfinement, ///< where the system kills a process that makes a forbidden call
        crashed
    };
    How how = How::byItself;
    long number = 0;
};

/// A program that runs beside this one, connected by a channel, with no other open file but one
/// that it is given, no terminal and almost no environment. It is killed with its owner.
class Helper {
public:
    Helper() = default;
    /// *Throws* std::system_error if the program cannot be started.
    explicit Helper(const std::filesystem::path &program, HandleView file = {});
    ~Helper();
    Helper(Helper &&other) noexcept;
    Helper &operator=(Helper &&other) noexcept;

    const Channel &channel() const { return m_channel; }
    /// Waits briefly for the process to end, after its channel has closed. Empty while it runs.
    std::optional<Ending> ending();
    /// Closes the channel, so that the process ends by itself; kills it if it takes longer.
    void endWithin(std::chrono::milliseconds patience);

private:
    std::optional<Ending> endingWithin(std::chrono::milliseconds patience);

    Native m_process = -1;
    Handle m_group; ///< ends the process with this program, where the system has such things
    Channel m_channel;
};

/// A helper starts with these.
struct HelpersEnds {
    Channel channel;
    Handle file; ///< if the program gives one
};
enum class Given { channel, channelAndFile };
/// Takes them, and closes everything else that the program left open. Nothing if no program of ours
/// has started this process. Once.
std::optional<HelpersEnds> takeHelpersEnds(Given given);

} // namespace pellucid::platform
