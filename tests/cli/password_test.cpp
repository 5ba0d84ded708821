// SPDX-License-Identifier: GPL-3.0-or-later
// The program asks for a password at a terminal.
#include "core/platform/handle.h"
#include "tests/cli/cli.h"

#include <array>
#include <chrono>
#include <csignal>
#include <poll.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <termios.h>
#include <thread>
#include <unistd.h>

namespace pellucid {

using namespace test;

namespace {

// A program at a terminal of its own, killed with the object.
class AtTerminal {
public:
    AtTerminal(const std::string &command, const fs::path &in) {
        int terminal = -1;
        m_pid = ::forkpty(&terminal, nullptr, nullptr, nullptr);
        if (m_pid == 0) {
            rlimit dumps{};
            ::getrlimit(RLIMIT_CORE, &dumps);
            dumps.rlim_cur = dumps.rlim_max;
            ::setrlimit(RLIMIT_CORE, &dumps);
            if (::chdir(in.c_str()) == 0)
                ::execl("/bin/sh", "sh", "-c", ("exec " + command).c_str(), nullptr);
            ::_exit(127);
        }
        m_terminal = platform::Handle(terminal);
    }
    ~AtTerminal() {
        if (m_pid > 0) {
            ::kill(m_pid, SIGKILL);
            ::waitpid(m_pid, nullptr, 0);
        }
    }
    AtTerminal(const AtTerminal &) = delete;
    AtTerminal &operator=(const AtTerminal &) = delete;

    pid_t pid() const { return m_pid; }
    /// Reads until the terminal shows it.
    bool shows(const std::string &text) {
        std::string shown;
        std::array<char, 256> part{};
        for (pollfd waiting{m_terminal.get(), POLLIN, 0}; ::poll(&waiting, 1, 20000) > 0;) {
            const ssize_t got = ::read(m_terminal.get(), part.data(), part.size());
            if (got <= 0)
                break;
            shown.append(part.data(), std::size_t(got));
            if (shown.find(text) != std::string::npos)
                return true;
        }
        ADD_FAILURE() << shown;
        return false;
    }
    void type(const std::string &keys) const {
        EXPECT_EQ(::write(m_terminal.get(), keys.data(), keys.size()), ssize_t(keys.size()));
    }
    bool showsWhatIsTyped() const {
        termios now{};
        EXPECT_EQ(::tcgetattr(m_terminal.get(), &now), 0);
        return (now.c_lflag & ECHO) != 0;
    }
    /// The status of its end, or -1 if it goes on for 20 s.
    int end() {
        for (int n = 0; n < 2000; ++n) {
            int status = 0;
            if (::waitpid(m_pid, &status, WNOHANG) == m_pid) {
                m_pid = -1;
                return status;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return -1;
    }

private:
    pid_t m_pid = -1;
    platform::Handle m_terminal;
};

class Password : public Cli {
protected:
    void SetUp() override {
        PELLUCID_NEEDS_THIS_SYSTEM("it asks at a terminal of its own");
        const auto added =
            cli("server add web --web https://127.0.0.1:9/ --authentication basic --user eva",
                environment());
        ASSERT_EQ(added.exitCode, 0) << added.error;
        // For another user, too.
        for (const auto &each : fs::recursive_directory_iterator(folder.path()))
            fs::permissions(each, fs::perms(0777));
        fs::permissions(folder.path(), fs::perms(0777));
    }
    std::string environment() const {
        return "XDG_DATA_HOME=" + quoted(folder / "data") +
               " XDG_CACHE_HOME=" + quoted(folder / "cache");
    }
    std::string asking() const { return "env " + environment() + " " + program() + " find web"; }
};

} // namespace

TEST_F(Password, IsNotShownAndTheTerminalIsAsBefore) {
    const auto begins = [&] { return std::make_unique<AtTerminal>(asking(), folder.path()); };
    const auto isHidden = [](AtTerminal &program) {
        for (int n = 0; n < 200 && program.showsWhatIsTyped(); ++n)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return !program.showsWhatIsTyped();
    };
    const auto expectCancelled = [](AtTerminal &program) {
        const int status = program.end();
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 130) << status;
        EXPECT_TRUE(program.showsWhatIsTyped());
    };
    const auto answered = begins();
    ASSERT_TRUE(answered->shows("Password of eva at web: "));
    EXPECT_TRUE(isHidden(*answered));
    answered->type("secret\n");
    const int status = answered->end();
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 6) << status; // nobody is there
    EXPECT_TRUE(answered->showsWhatIsTyped());
    // Ctrl+C ends the question.
    const auto cancelled = begins();
    ASSERT_TRUE(cancelled->shows("Password"));
    EXPECT_TRUE(isHidden(*cancelled));
    cancelled->type("sec\x03");
    expectCancelled(*cancelled);
    // A second signal does not wait for anything.
    const auto killed = begins();
    ASSERT_TRUE(killed->shows("Password"));
    EXPECT_TRUE(isHidden(*killed));
    ::kill(killed->pid(), SIGTERM);
    ::kill(killed->pid(), SIGINT);
    expectCancelled(*killed);
}

// Neither a core dump nor another program of the same user has the password.
TEST_F(Password, StaysInTheProgram) {
#ifdef PELLUCID_SANITIZED
    GTEST_SKIP() << "sanitizers debug the program";
#endif
    // Root may read everything.
    const std::string as = ::geteuid() == 0 ? "setpriv --reuid=65534 --clear-groups " : "";
    if (run(as + "test -x " + program()).exitCode != 0)
        GTEST_SKIP() << "the program is not reachable for another user";
    const auto isRead = [&](AtTerminal &program) {
        return run(as + "head -c 1 /proc/" + std::to_string(program.pid()) + "/environ").exitCode ==
               0;
    };
    const auto isDumped = [](AtTerminal &program) {
        ::kill(program.pid(), SIGSEGV);
        const int status = program.end();
        EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGSEGV) << status;
        return WCOREDUMP(status) != 0;
    };
    AtTerminal other(as + "sh -c 'echo begins; while sleep 0.1; do :; done'", folder.path());
    ASSERT_TRUE(other.shows("begins"));
    EXPECT_TRUE(isRead(other));
    if (!isDumped(other))
        GTEST_SKIP() << "this system dumps no core";
    AtTerminal program(as + asking(), folder.path());
    ASSERT_TRUE(program.shows("Password"));
    EXPECT_FALSE(isRead(program));
    EXPECT_FALSE(isDumped(program));
}

} // namespace pellucid
