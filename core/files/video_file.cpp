// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/video_file.h"

#include <chrono>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>

#include "core/files/atomic_file.h"
#include "core/files/reasons.h"
#include "core/task/error.h"

namespace pellucid::files {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;

constexpr int waitMs = 100; // the longest wait after a cancel
constexpr const char *videoName = "video.mp4", *messagesName = "messages";

fs::path findEncoder() {
    return platform::findOnSearchPath("ffmpeg");
}

} // namespace

bool VideoFile::isAvailable() {
    return !findEncoder().empty();
}

VideoFile::VideoFile(const fs::path &path, int width, int height, int framesPerSecond)
    : m_path(path), m_folder(SessionFolder::beside(path)),
      m_unfinished(m_folder.path() / videoName), m_messages(m_folder.path() / messagesName) {
    const fs::path program = findEncoder();
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    try {
        if (!program.empty())
            m_encoder.emplace(
                program,
                std::vector<std::string>{
                    "-nostdin", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgba",
                    "-s", size, "-r", std::to_string(framesPerSecond), "-i", "-",
                    // The codec needs even sizes, players need this pixel format.
                    "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-crf", "16",
                    "-pix_fmt", "yuv420p", "-metadata", "comment=Not for diagnostic use",
                    // The same ffmpeg writes the same bytes: they depend on the number of threads.
                    "-fflags", "+bitexact", "-flags:v", "+bitexact", "-threads", "4", "-movflags",
                    "+faststart", videoName},
                m_folder.marked(), messagesName);
    } catch (const std::system_error &) { // reported below
    }
    if (!m_encoder)
        throw task::Error(task::ErrorCode::output, because::ffmpegDoesNotStart, path);
}

void VideoFile::fail() {
    for (int tries = 0; !m_encoder->ended() && tries < 10; ++tries)
        std::this_thread::sleep_for(std::chrono::milliseconds(waitMs));
    std::ifstream file(m_messages);
    std::string message;
    for (std::string word; file >> word;)
        message += (message.empty() ? "" : " ") + word;
    throw task::Error(task::ErrorCode::output,
                      message.empty() ? task::Reason(because::ffmpegEndedEarly)
                                      : because::ffmpegReports(message),
                      m_path);
}

void VideoFile::add(std::span<const std::uint8_t> rgba, const task::Progress &progress) {
    for (auto rest = std::as_bytes(rgba); !rest.empty();) {
        progress.check();
        try {
            rest = rest.subspan(m_encoder->write(rest, waitMs));
        } catch (const std::system_error &) {
            fail();
        }
    }
}

void VideoFile::finish(const task::Progress &progress) {
    m_encoder->closeInput();
    std::optional<bool> isGood;
    while (!(isGood = m_encoder->ended())) {
        progress.check();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    if (!*isGood)
        fail();
    files::rename(m_unfinished, m_path);
}

} // namespace pellucid::files
