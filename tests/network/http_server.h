// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <string>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

#include "tests/network/servers.h"

/// An HTTP server whose answers a test makes.
namespace pellucid::test {

using Fields = std::map<std::string, std::string>;

struct HttpRequest {
    std::string method, target; ///< target: path and query
    Fields headers;             ///< names in small letters
    std::string body;

    std::string path() const { return target.substr(0, target.find('?')); }
    std::string header(const std::string &name) const {
        const auto at = headers.find(name);
        return at == headers.end() ? std::string() : at->second;
    }
};

struct HttpAnswer {
    int status = 200;
    std::string type = "application/json", body, location;
    std::shared_future<void> after{}; ///< the answer waits for it, and others do not
    std::string header{};             ///< one more: "Name: value"
    bool isLast = false;              ///< of its connection, without saying so
};

inline std::string urlDecoded(const std::string &text) {
    std::string decoded;
    for (std::size_t n = 0; n < text.size(); ++n)
        if (text[n] == '%') {
            decoded += char(std::stoi(text.substr(n + 1, 2), nullptr, 16));
            n += 2;
        } else {
            decoded += text[n];
        }
    return decoded;
}

// The fields of a query or a form.
inline Fields fieldsOf(const std::string &text) {
    Fields fields;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('&', at), text.size());
        const std::string pair = text.substr(at, end - at);
        const std::size_t equals = std::min(pair.find('='), pair.size());
        fields[urlDecoded(pair.substr(0, equals))] =
            equals < pair.size() ? urlDecoded(pair.substr(equals + 1)) : "";
        at = end + 1;
    }
    return fields;
}

inline void sendAll(int socket, const std::string &bytes) {
    for (std::size_t sent = 0; sent < bytes.size();) {
        const ssize_t now = ::send(socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
        if (now <= 0)
            return;
        sent += std::size_t(now);
    }
}

// The answer of the page at this address, which the server ends by closing the connection.
inline std::string visit(const std::string &url) {
    const std::size_t host = url.find("://") + 3, path = url.find('/', host);
    const int socket = connectTo(std::stoi(url.substr(url.find(':', host) + 1)));
    if (socket < 0)
        return "no connection";
    sendAll(socket, "GET " + url.substr(path) + " HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
    std::string answer;
    std::array<char, 4096> buffer{};
    for (ssize_t got = 0; (got = ::recv(socket, buffer.data(), buffer.size(), 0)) > 0;)
        answer.append(buffer.data(), std::size_t(got));
    ::close(socket);
    return answer;
}

// Answers requests on 127.0.0.1, each connection in a thread of its own.
class HttpServer {
public:
    using Handler = std::function<HttpAnswer(const HttpRequest &)>;
    explicit HttpServer(Handler handler)
        : m_handler(std::move(handler)), m_acceptor([this](int client) { serve(client); }) {}
    std::string url() const { return "http://127.0.0.1:" + std::to_string(m_acceptor.port()); }
    std::size_t requestCount() {
        const std::lock_guard lock(m_mutex);
        return m_count;
    }

private:
    void serve(int client) {
        std::string bytes;
        const auto more = [&] {
            std::array<char, 65536> buffer{};
            const ssize_t got = ::recv(client, buffer.data(), buffer.size(), 0);
            bytes.append(buffer.data(), got > 0 ? std::size_t(got) : 0);
            return got > 0;
        };
        for (;;) {
            std::size_t end = 0;
            while ((end = bytes.find("\r\n\r\n")) == std::string::npos)
                if (!more())
                    return;
            HttpRequest request = headOf(bytes.substr(0, end));
            bytes.erase(0, end + 4);
            const std::string length = request.header("content-length");
            const std::size_t count = length.empty() ? 0 : std::stoul(length);
            while (bytes.size() < count)
                if (!more())
                    return;
            request.body = bytes.substr(0, count);
            bytes.erase(0, count);
            HttpAnswer answer;
            {
                const std::lock_guard lock(m_mutex);
                ++m_count;
                answer = m_handler(request);
            }
            if (answer.after.valid())
                answer.after.wait();
            sendAll(client, "HTTP/1.1 " + std::to_string(answer.status) +
                                " Answer\r\nContent-Type: " + answer.type +
                                "\r\nContent-Length: " + std::to_string(answer.body.size()) +
                                (answer.location.empty() ? "" : "\r\nLocation: ") +
                                answer.location + (answer.header.empty() ? "" : "\r\n") +
                                answer.header + "\r\n\r\n" + answer.body);
            if (answer.isLast)
                return;
        }
    }
    static HttpRequest headOf(const std::string &head) {
        HttpRequest request;
        const std::size_t first = head.find(' '), second = head.find(' ', first + 1);
        request.method = head.substr(0, first);
        request.target = head.substr(first + 1, second - first - 1);
        for (std::size_t at = head.find("\r\n"); at != std::string::npos;
             at = head.find("\r\n", at + 2)) {
            const std::string line = head.substr(at + 2, head.find("\r\n", at + 2) - at - 2);
            const std::size_t colon = line.find(": ");
            if (colon == std::string::npos)
                continue;
            std::string name = line.substr(0, colon);
            std::transform(name.begin(), name.end(), name.begin(),
                           [](unsigned char c) { return char(std::tolower(c)); });
            request.headers[name] = line.substr(colon + 2);
        }
        return request;
    }

    Handler m_handler;
    std::mutex m_mutex; // one request at a time
    std::size_t m_count = 0;
    Acceptor m_acceptor; // last: its threads use the others
};

} // namespace pellucid::test
