// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/terminal.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <mutex>
#include <optional>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <fmt/format.h>

#include "app/cli/reasons.h"
#include "core/platform/handle.h"
#include "core/system/utf8.h"
#include "core/task/error.h"
#include "core/task/progress.h"

namespace pellucid::cli {

namespace {

// A terminal that does not show what is typed, and how it was before.
std::mutex hiding;
struct Hidden {
    int terminal = -1;
    termios before{};
};
std::optional<Hidden> hidden;

void hide(int terminal, const termios &before) {
    const std::lock_guard lock(hiding);
    hidden = {terminal, before};
    termios without = before;
    without.c_lflag &= ~tcflag_t(ECHO);
    ::tcsetattr(terminal, TCSADRAIN, &without);
}

// Requires the lock.
void show() {
    if (hidden)
        ::tcsetattr(hidden->terminal, TCSAFLUSH, &hidden->before);
    hidden.reset();
}

// The terminal has a line, or its end, before the program is to stop.
bool hasLine(int terminal, const std::stop_token &stop) {
    constexpr int stopPollMs = 50;
    for (pollfd waiting{terminal, POLLIN, 0}; !stop.stop_requested();)
        if (::poll(&waiting, 1, stopPollMs) > 0)
            return true;
    return false;
}

} // namespace

std::string escapedControls(const std::string &json) {
    std::string escaped;
    for (std::size_t at = 0; at < json.size();) {
        const system::CodePoint point = system::codePointAt(json, at);
        const std::size_t bytes = std::max<std::size_t>(1, point.bytes);
        const unsigned code = point.code;
        if (code > 0xFFFF && system::isHidden(code)) // in UTF-16: two halves
            escaped +=
                fmt::format("\\u{:04x}\\u{:04x}", 0xD7C0 + (code >> 10), 0xDC00 + (code & 0x3FFU));
        else if (code >= 0x7F && (system::isControl(code) || system::isHidden(code)))
            escaped += fmt::format("\\u{:04x}", code);
        else
            escaped.append(json, at, bytes);
        at += bytes;
    }
    return escaped;
}

std::string counted(std::size_t count, const std::string &noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string askHidden(const std::string &question, const std::stop_token &stop) {
    const platform::Handle terminal(::open("/dev/tty", O_RDWR | O_CLOEXEC | O_NOCTTY));
    termios shown{};
    if (!terminal || ::tcgetattr(terminal.get(), &shown) != 0)
        throw task::Error(task::ErrorCode::usage, task::because::passwordNeedsATerminal);
    // Hidden before the question: a quick answer is neither shown nor thrown away.
    hide(terminal.get(), shown);
    (void)!::write(terminal.get(), question.data(), question.size());
    const bool isAnswered = hasLine(terminal.get(), stop);
    std::string line;
    for (char c = 0; isAnswered && ::read(terminal.get(), &c, 1) == 1 && c != '\n';)
        line += c;
    {
        const std::lock_guard lock(hiding);
        show();
    }
    (void)!::write(terminal.get(), "\n", 1);
    if (!isAnswered)
        throw task::Cancelled();
    return line;
}

void endAtOnce(int code) {
    const std::lock_guard lock(hiding); // nothing is hidden from now on
    show();
    std::_Exit(code);
}

void warn(const std::string &what) {
    std::fprintf(stderr, "pellucid-cli: warning: %s\n", printable(what).c_str());
}

} // namespace pellucid::cli
