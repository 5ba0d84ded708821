// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/video_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
#include <spawn.h>
#include <sstream>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "core/files/atomic_file.h"
#include "core/files/reasons.h"
#include "core/files/spawn.h"
#include "core/task/error.h"

namespace pellucid::files {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;

constexpr int waitMs = 100; // the longest wait after a cancel
constexpr const char *videoName = "video.mp4", *messagesName = "messages";

// Where PATH names it; empty if nowhere.
fs::path findEncoder() {
    const char *const path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
        const fs::path program = fs::absolute(fs::path(folder) / "ffmpeg");
        if (::access(program.c_str(), X_OK) == 0)
            return program;
    }
    return {};
}

// Starts ffmpeg in a folder, with a socket as standard input, which reports an end without a
// signal. -1 if it cannot be started.
pid_t start(const fs::path &program, std::vector<std::string> arguments, int input, int folder) {
    std::vector<char *> pointers;
    for (std::string &argument : arguments)
        pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    const SpawnAttributes attributes;
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, input, 0);
    ::posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_addfchdir_np(&actions, folder);
    ::posix_spawn_file_actions_addopen(&actions, 2, messagesName, O_WRONLY | O_CREAT, 0600);
    pid_t started = -1;
    const int failed = ::posix_spawn(&started, program.c_str(), &actions, attributes.get(),
                                     pointers.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    return failed == 0 ? started : -1;
}

} // namespace

bool VideoFile::isAvailable() {
    return !findEncoder().empty();
}

VideoFile::VideoFile(const fs::path &path, int width, int height, int framesPerSecond)
    : m_path(path), m_folder(SessionFolder::beside(path)),
      m_unfinished(m_folder.path() / videoName), m_messages(m_folder.path() / messagesName) {
    const fs::path program = findEncoder();
    std::array<int, 2> ends{-1, -1};
    if (program.empty() || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw task::Error(task::ErrorCode::output, because::ffmpegDoesNotStart, path);
    m_input = platform::Handle(ends[0]);
    const platform::Handle childInput(ends[1]);
    ::fcntl(m_input.get(), F_SETFL, O_NONBLOCK);
    m_encoder =
        start(program,
              {program.string(), "-nostdin", "-loglevel", "error", "-y", "-f", "rawvideo",
               "-pix_fmt", "rgba", "-s", std::to_string(width) + "x" + std::to_string(height), "-r",
               std::to_string(framesPerSecond), "-i", "-",
               // The codec needs even sizes, players need this pixel format.
               "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-crf", "16", "-pix_fmt",
               "yuv420p", "-metadata", "comment=Not for diagnostic use",
               // The same ffmpeg writes the same bytes: they depend on the number of threads.
               "-fflags", "+bitexact", "-flags:v", "+bitexact", "-threads", "4", "-movflags",
               "+faststart", videoName},
              childInput.get(), m_folder.descriptor());
    if (m_encoder < 0)
        throw task::Error(task::ErrorCode::output, because::ffmpegDoesNotStart, path);
}

VideoFile::~VideoFile() {
    if (m_encoder <= 0)
        return;
    ::kill(m_encoder, SIGKILL);
    while (::waitpid(m_encoder, nullptr, 0) < 0 && errno == EINTR) {
    }
}

std::optional<bool> VideoFile::ended() {
    int status = 0;
    if (m_encoder > 0 && ::waitpid(m_encoder, &status, WNOHANG) != m_encoder)
        return std::nullopt;
    m_encoder = -1;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void VideoFile::fail() {
    for (int tries = 0; !ended() && tries < 10; ++tries)
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
    while (!rgba.empty()) {
        progress.check();
        const ssize_t sent = ::send(m_input.get(), rgba.data(), rgba.size(), MSG_NOSIGNAL);
        if (sent > 0) {
            rgba = rgba.subspan(std::size_t(sent));
        } else if (sent < 0 && errno != EAGAIN && errno != EINTR) {
            fail();
        } else {
            pollfd writable{m_input.get(), POLLOUT, 0};
            ::poll(&writable, 1, waitMs);
        }
    }
}

void VideoFile::finish(const task::Progress &progress) {
    m_input = platform::Handle();
    std::optional<bool> isGood;
    while (!(isGood = ended())) {
        progress.check();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    if (!*isGood)
        fail();
    files::rename(m_unfinished, m_path);
}

} // namespace pellucid::files
