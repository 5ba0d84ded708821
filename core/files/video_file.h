// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <sys/types.h>

#include "core/files/session_folder.h"
#include "core/platform/handle.h"
#include "core/task/progress.h"

namespace pellucid::files {

/// A video (H.264 in MP4) that the program ffmpeg writes. The file appears only when complete.
/// After a kill, the next export to the folder removes the unfinished file. Use it on one thread,
/// which may be any.
class VideoFile {
public:
    /// Whether ffmpeg is installed.
    static bool isAvailable();

    /// *Throws* Error{output} if ffmpeg does not start.
    VideoFile(const std::filesystem::path &path, int width, int height, int framesPerSecond);
    ~VideoFile();
    VideoFile(const VideoFile &) = delete;
    VideoFile &operator=(const VideoFile &) = delete;

    /// Adds a frame. *Shape*: height x width x 4, RGBA, rows from the top; alpha is ignored.
    /// *Throws* Error{output} with the message of ffmpeg, Cancelled.
    void add(std::span<const std::uint8_t> rgba, const task::Progress &progress);
    /// Waits for ffmpeg and puts the file in its place. *Throws* as `add`.
    void finish(const task::Progress &progress);

private:
    [[noreturn]] void fail();
    /// Whether ffmpeg has ended well; nothing while it runs.
    std::optional<bool> ended();

    std::filesystem::path m_path;
    SessionFolder m_folder;
    std::filesystem::path m_unfinished, m_messages;
    platform::Handle m_input;
    pid_t m_encoder = -1;
};

} // namespace pellucid::files
