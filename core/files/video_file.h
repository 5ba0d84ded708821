// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "core/files/session_folder.h"
#include "core/platform/filter.h"
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

    /// Adds a frame. *Shape*: height x width x 4, RGBA, rows from the top; alpha is ignored.
    /// *Throws* Error{output} with the message of ffmpeg, Cancelled.
    void add(std::span<const std::uint8_t> rgba, const task::Progress &progress);
    /// Waits for ffmpeg and puts the file in its place. *Throws* as `add`.
    void finish(const task::Progress &progress);

private:
    [[noreturn]] void fail();

    std::filesystem::path m_path;
    SessionFolder m_folder;
    std::filesystem::path m_unfinished, m_messages;
    std::optional<platform::Filter> m_encoder;
};

} // namespace pellucid::files
