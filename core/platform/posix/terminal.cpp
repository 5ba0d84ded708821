// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/terminal.h"

#include <cstdlib>
#include <fcntl.h>
#include <mutex>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include "core/platform/handle.h"

namespace pellucid::platform {

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

HiddenAnswer askHidden(const std::string &question, const std::stop_token &stop) {
    const Handle terminal(::open("/dev/tty", O_RDWR | O_CLOEXEC | O_NOCTTY));
    termios shown{};
    if (!terminal || ::tcgetattr(terminal.get(), &shown) != 0)
        return {};
    // Hidden before the question: a quick answer is neither shown nor thrown away.
    hide(terminal.get(), shown);
    (void)!::write(terminal.get(), question.data(), question.size());
    HiddenAnswer answer{true, {}};
    if (hasLine(terminal.get(), stop)) {
        answer.line = "";
        for (char c = 0; ::read(terminal.get(), &c, 1) == 1 && c != '\n';)
            *answer.line += c;
    }
    {
        const std::lock_guard lock(hiding);
        show();
    }
    (void)!::write(terminal.get(), "\n", 1);
    return answer;
}

void joinTerminal() {}

void endAtOnce(int code) {
    const std::lock_guard lock(hiding); // nothing is hidden from now on
    show();
    std::_Exit(code);
}

} // namespace pellucid::platform
