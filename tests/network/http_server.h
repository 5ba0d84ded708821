// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <sstream>
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

/// How an answer shows where its body ends.
enum class Framing { byLength, inChunks, byTheEnd };

struct HttpAnswer {
    int status = 200;
    std::string type = "application/json", body, location;
    std::shared_future<void> after{}; ///< the answer waits for it, and others do not
    std::string header{};             ///< one more: "Name: value"
    bool isLast = false;              ///< of its connection, without saying so
    Framing framing = Framing::byLength;
    std::string version = "HTTP/1.1";
    /// Bytes of the body, after which the connection breaks.
    std::size_t cutAt = std::string::npos;
    std::size_t pieceBytes = 0; ///< the body comes slowly in such pieces; 0: at once
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
            if (!sendAnswer(client, answer))
                return;
            if (answer.isLast)
                return;
        }
    }
    // Returns false if no more can follow on this connection.
    static bool sendAnswer(int client, const HttpAnswer &answer) {
        const bool hasChunks = answer.framing == Framing::inChunks && !answer.body.empty();
        std::string head = answer.version + " " + std::to_string(answer.status) + " Answer\r\n";
        const auto add = [&](const std::string &line) { head += line + "\r\n"; };
        if (!answer.type.empty())
            add("Content-Type: " + answer.type);
        if (hasChunks)
            add("Transfer-Encoding: chunked");
        else if (answer.framing != Framing::byTheEnd)
            add("Content-Length: " + std::to_string(answer.body.size()));
        if (!answer.location.empty())
            add("Location: " + answer.location);
        if (!answer.header.empty())
            add(answer.header);
        sendAll(client, head + "\r\n" + (answer.pieceBytes > 0 ? "" : bodyOf(answer, hasChunks)));
        for (std::size_t at = 0; answer.pieceBytes > 0 && at < answer.body.size();
             at += answer.pieceBytes) {
            ::usleep(1000);
            sendAll(client, answer.body.substr(at, answer.pieceBytes));
        }
        return answer.framing != Framing::byTheEnd && answer.cutAt >= answer.body.size();
    }
    static std::string bodyOf(const HttpAnswer &answer, bool hasChunks) {
        constexpr std::size_t chunk = 777;
        const std::string body = answer.body.substr(0, answer.cutAt);
        if (!hasChunks)
            return body;
        std::ostringstream chunks;
        for (std::size_t at = 0; at < body.size(); at += chunk) {
            const std::string part = body.substr(at, chunk);
            chunks << std::hex << part.size() << "\r\n" << part << "\r\n";
        }
        return chunks.str() + "0\r\n\r\n";
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
