// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/redirect.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <map>
#include <vector>

#include "core/network/process/confine.h"
#include "core/network/process/login_json.h"
#include "core/network/process/reasons.h"
#include "core/platform/socket.h"

namespace pellucid::network::process {

namespace {

namespace because = task::because;
using platform::Handle;
using Clock = std::chrono::steady_clock;
using Kind = Message::Kind;

constexpr std::size_t longestHead = 64 << 10, mostBrowsers = 16;

// Returns nothing if the encoding is invalid.
std::optional<std::string> urlDecoded(const std::string &text) {
    std::string decoded;
    for (std::size_t n = 0; n < text.size(); ++n) {
        if (text[n] != '%') {
            decoded += text[n] == '+' ? ' ' : text[n];
            continue;
        }
        unsigned byte = 0;
        const char *const digits = text.data() + n + 1;
        if (n + 2 >= text.size() || std::from_chars(digits, digits + 2, byte, 16).ptr != digits + 2)
            return std::nullopt;
        decoded += char(byte);
        n += 2;
    }
    return decoded;
}

// Returns nothing if a parameter is repeated (RFC 6749, 3.1).
std::optional<std::map<std::string, std::string>> parametersOf(const std::string &query) {
    std::map<std::string, std::string> parameters;
    for (std::size_t at = 0; at < query.size();) {
        const std::size_t end = std::min(query.find('&', at), query.size());
        const std::string pair = query.substr(at, end - at);
        at = end + 1;
        const std::size_t equals = std::min(pair.find('='), pair.size());
        const auto name = urlDecoded(pair.substr(0, equals)),
                   value = urlDecoded(pair.substr(std::min(equals + 1, pair.size())));
        if (!name || !value || !parameters.emplace(*name, *value).second)
            return std::nullopt;
    }
    return parameters;
}

std::string htmlOf(const std::string &text) {
    std::string html;
    for (const char c : text)
        html += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    return html;
}

void show(const Handle &browser, const char *status, const std::string &text) {
    const std::string page = "<!DOCTYPE html><html><head><meta charset=\"utf-8\">"
                             "<title>Pellucid</title></head><body><p>" +
                             htmlOf(text) + "</p></body></html>\n";
    // The address has the code: it goes to no other page, and not into a cache.
    const std::string answer = std::string("HTTP/1.1 ") + status +
                               "\r\nContent-Type: text/html; charset=utf-8\r\nContent-Length: " +
                               std::to_string(page.size()) +
                               "\r\nContent-Security-Policy: default-src 'none'\r\n"
                               "Referrer-Policy: no-referrer\r\nCache-Control: no-store\r\n"
                               "Connection: close\r\n\r\n" +
                               page;
    // A page fits into the buffer of a new connection.
    platform::sendLast(browser, answer);
}

struct Browser {
    platform::Connected from;
    std::string head;
};

// What a connection has sent; false at its end.
bool receive(Browser &browser) {
    std::array<char, 4096> buffer{};
    const auto got = platform::receiveSome(browser.from.socket, buffer);
    if (!got)
        return true;
    browser.head.append(buffer.data(), *got);
    return *got > 0 && browser.head.size() <= longestHead;
}

// Other users see the address of the login among the arguments of the browser: one could log in as
// himself and send his code here, and this user's images would go to his account (RFC 8252, 8.9).
// The program looks up whose connection it is: this process cannot.
bool isOfThisUser(const Browser &browser, Control &control) {
    control.send({Kind::browser, 0, std::uint64_t(browser.from.port), browser.from.address});
    const Kind answer = control.wait().message.kind;
    if (answer == Kind::cancel)
        throw CancelledByProgram();
    return answer == Kind::kept;
}

// Passes the result on; the browser shows the end of it.
void finish(const Browser &browser, const LoginResult &result, const Redirection &redirection,
            Control &control) {
    if (!result.error.empty()) {
        show(browser.from.socket, "200 OK", redirection.failureText);
        throw task::Error(task::ErrorCode::unusable, loginRefusal(result.error));
    }
    control.send({Kind::code, 0, 0, result.code});
    const Kind answer = control.wait().message.kind;
    const bool isKept = answer == Kind::kept;
    show(browser.from.socket, "200 OK", isKept ? redirection.successText : redirection.failureText);
    if (answer == Kind::cancel)
        throw CancelledByProgram();
}

} // namespace

std::optional<LoginResult> loginResultOf(const std::string &head, const std::string &state) {
    const std::string start = "GET /?";
    const std::size_t end = head.find(' ', start.size());
    if (!head.starts_with(start) || end == std::string::npos)
        return std::nullopt;
    auto parameters = parametersOf(head.substr(start.size(), end - start.size()));
    if (!parameters || state.empty() || (*parameters)["state"] != state)
        return std::nullopt;
    LoginResult result{(*parameters)["code"], (*parameters)["error"]};
    if (result.error.empty() && !isVisible(result.code, longestCode))
        return std::nullopt;
    return result;
}

void awaitRedirect(platform::HandleView socket, const Redirection &redirection, Control &control) {
    control.send({Kind::ready, confineToAccepting(), 0, {}});
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(redirection.seconds));
    // Browsers open connections in advance, and may never use them: all are read at once.
    std::vector<Browser> browsers;
    for (;;) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
        if (left <= 0)
            throw task::Error(task::ErrorCode::unusable,
                              because::loginTookTooLong(std::lround(redirection.seconds)));
        std::vector<platform::HandleView> sockets{socket};
        for (const Browser &browser : browsers)
            sockets.push_back(browser.from.socket);
        const std::vector<bool> ready = platform::awaitAny(control.channel(), sockets, int(left));
        if (ready[0] && control.isCancelled())
            throw CancelledByProgram();
        for (std::size_t n = browsers.size(); n-- > 0;) {
            if (!ready[n + 2])
                continue;
            const bool isOpen = receive(browsers[n]);
            if (isOpen && browsers[n].head.find("\r\n\r\n") == std::string::npos)
                continue;
            if (isOpen && isOfThisUser(browsers[n], control)) {
                if (const auto result = loginResultOf(browsers[n].head, redirection.state)) {
                    finish(browsers[n], *result, redirection, control);
                    control.done();
                    return;
                }
                show(browsers[n].from.socket, "400 Bad Request", redirection.failureText);
            }
            browsers.erase(browsers.begin() + std::ptrdiff_t(n));
        }
        if (!ready[1])
            continue;
        auto accepted = platform::acceptFrom(socket, platform::Accepting::neverWaits);
        if (!accepted)
            continue;
        if (browsers.size() >= mostBrowsers) // the oldest one makes way
            browsers.erase(browsers.begin());
        browsers.push_back({*std::move(accepted), {}});
    }
}

} // namespace pellucid::network::process
