// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <poll.h>
#include <set>
#include <stop_token>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "core/archive/pkce.h"
#include "core/network/client/query.h"
#include "tests/network/http_server.h"
#include "tests/support/dicom_writer.h"

/// A login server (OAuth 2.0), and a DICOMweb server that accepts its tokens.
namespace pellucid::test {

// The tokens that both servers know. Thread-safe.
class Tokens {
public:
    std::string issue() {
        const std::lock_guard lock(m_mutex);
        m_valid = "access-token-" + std::to_string(++m_issued);
        return m_valid;
    }
    void expire() {
        const std::lock_guard lock(m_mutex);
        m_valid.clear();
    }
    bool accepts(const std::string &authorization) {
        const std::lock_guard lock(m_mutex);
        return !m_valid.empty() && authorization == "Bearer " + m_valid;
    }
    int issued() {
        const std::lock_guard lock(m_mutex);
        return m_issued;
    }

private:
    std::mutex m_mutex;
    std::string m_valid;
    int m_issued = 0;
};

// A login server (RFC 6749, 7636; OpenID Connect Discovery 1.0). The test is its user.
class LoginServer {
public:
    explicit LoginServer(Tokens &tokens)
        : m_tokens(tokens), m_http([this](const HttpRequest &request) { return answer(request); }) {
    }
    std::string url() const { return m_http.url(); }

    // What it knows of a login whose page the browser has opened. Set before the answers.
    void expect(const std::string &page) {
        const std::lock_guard lock(m_mutex);
        m_page = fieldsOf(page.substr(page.find('?') + 1));
    }
    void refuseToRenew() {
        const std::lock_guard lock(m_mutex);
        m_refresh.clear();
    }
    // Answers requests for tokens with this.
    void lie(const HttpAnswer &answer) {
        const std::lock_guard lock(m_mutex);
        m_lie = answer;
    }
    void setLifetime(int seconds) {
        const std::lock_guard lock(m_mutex);
        m_lifetime = seconds;
    }
    void setIssuer(const std::string &issuer) {
        const std::lock_guard lock(m_mutex);
        m_issuer = issuer;
    }
    std::vector<Fields> tokenRequests() {
        const std::lock_guard lock(m_mutex);
        return m_requests;
    }
    std::string refreshToken() {
        const std::lock_guard lock(m_mutex);
        return m_refresh;
    }

private:
    HttpAnswer answer(const HttpRequest &request) {
        const std::lock_guard lock(m_mutex);
        if (request.path() == "/.well-known/openid-configuration")
            return {200, "application/json",
                    R"({"issuer": ")" + (m_issuer.empty() ? url() : m_issuer) +
                        R"(", "authorization_endpoint": ")" + url() +
                        R"(/authorize?policy=a", "token_endpoint": ")" + url() + R"(/token/"})",
                    ""};
        if (request.path() != "/token/" || request.method != "POST" ||
            request.header("content-type") != "application/x-www-form-urlencoded")
            return {404, "text/plain", "", ""};
        const Fields form = fieldsOf(request.body);
        m_requests.push_back(form);
        if (m_lie)
            return *m_lie;
        const auto is = [&](const char *name, const std::string &value) {
            const auto at = form.find(name);
            return at != form.end() && !value.empty() && at->second == value;
        };
        const bool isLogin =
            is("grant_type", "authorization_code") && is("code", "the-code") &&
            is("redirect_uri", m_page["redirect_uri"]) && form.contains("code_verifier") &&
            archive::codeChallenge(form.at("code_verifier")) == m_page["code_challenge"];
        const bool isRenewal = is("grant_type", "refresh_token") && is("refresh_token", m_refresh);
        if (!is("client_id", "pellucid") || !(isLogin || isRenewal))
            return {400, "application/json", R"({"error": "invalid_grant"})", ""};
        m_refresh = "refresh-token-" + std::to_string(m_requests.size());
        return {200, "application/json",
                R"({"access_token": ")" + m_tokens.issue() +
                    R"(", "token_type": "Bearer", "expires_in": )" + std::to_string(m_lifetime) +
                    R"(, "refresh_token": ")" + m_refresh + "\"}",
                ""};
    }

    Tokens &m_tokens;
    std::mutex m_mutex;
    Fields m_page;
    std::string m_refresh, m_issuer;
    int m_lifetime = 300;
    std::optional<HttpAnswer> m_lie;
    std::vector<Fields> m_requests;
    HttpServer m_http;
};

inline const std::string webStudy = "1.2.826.0.1.3680043.8.498.77", webSeries = webStudy + ".1";
inline constexpr int objects = 40;

inline std::string instance(int n) {
    return webSeries + "." + std::to_string(100 + n); // all have the same length
}

inline DicomWriter object(const std::string &uid) {
    DicomWriter writer;
    writer.put({0x0008, 0x0016}, "UI", "1.2.840.10008.5.1.4.1.1.7");
    writer.put({0x0008, 0x0018}, "UI", uid);
    writer.put({0x0008, 0x0060}, "CS", "OT");
    writer.put({0x0010, 0x0010}, "PN", "Test^Login");
    writer.put({0x0020, 0x000d}, "UI", webStudy);
    writer.put({0x0020, 0x000e}, "UI", webSeries);
    return writer;
}

// A DICOMweb server with one study, for whoever has a valid token.
class WebServer {
public:
    explicit WebServer(Tokens &tokens)
        : m_tokens(tokens), m_http([this](const HttpRequest &request) { return answer(request); }) {
    }
    std::string url() const { return m_http.url(); }
    // The token expires each time that so many objects have come or gone.
    void expireEvery(int count) {
        const std::lock_guard lock(m_mutex);
        m_every = count;
    }
    // Answers requests for objects, one at a time; nothing: the default answer.
    using Script = std::function<std::optional<HttpAnswer>(const HttpRequest &)>;
    void setScript(Script script) {
        const std::lock_guard lock(m_mutex);
        m_script = std::move(script);
    }
    // Sends everyone elsewhere.
    void moveTo(const std::string &url) {
        const std::lock_guard lock(m_mutex);
        m_elsewhere = url;
    }
    std::multiset<std::string> sent() {
        const std::lock_guard lock(m_mutex);
        return m_sent;
    }
    std::set<std::string> stored() {
        const std::lock_guard lock(m_mutex);
        return m_stored;
    }
    int refusals() {
        const std::lock_guard lock(m_mutex);
        return m_refusals;
    }

private:
    static std::string element(const char *tag, const char *vr, const std::string &value) {
        return "\"" + std::string(tag) + "\": {\"vr\": \"" + vr + "\", \"Value\": [" + value + "]}";
    }
    static std::string uidElement(const char *tag, const std::string &uid) {
        return element(tag, "UI", "\"" + uid + "\"");
    }
    HttpAnswer answer(const HttpRequest &request) {
        const std::lock_guard lock(m_mutex);
        if (!m_elsewhere.empty())
            return {302, "text/plain", "", m_elsewhere + request.target};
        if (m_script && request.path().find("/instances/") != std::string::npos)
            if (const auto scripted = m_script(request))
                return *scripted;
        if (!m_tokens.accepts(request.header("authorization"))) {
            ++m_refusals;
            return {401, "text/plain", "", ""};
        }
        const std::string path = request.path(),
                          one = "/studies/" + webStudy + "/series/" + webSeries;
        if (path == "/studies" && request.method == "POST")
            return store(request.body);
        if (path.starts_with(one + "/instances/"))
            return retrieve(path.substr(path.rfind('/') + 1));
        if (fieldsOf(request.target.substr(request.target.find('?') + 1))["offset"] != "0")
            return {204, "application/dicom+json", "", ""};
        const std::string type = "application/dicom+json";
        if (path == "/studies")
            return {200, type, "[{" + uidElement("0020000D", webStudy) + "}]", ""};
        if (path == "/studies/" + webStudy + "/series")
            return {200, type, "[{" + uidElement("0020000E", webSeries) + "}]", ""};
        if (path != one + "/instances")
            return {404, "text/plain", "", ""};
        std::string list;
        for (int n = 0; n < objects; ++n)
            list += (n == 0 ? "{" : ", {") + uidElement("00080018", instance(n)) + ", " +
                    uidElement("00080016", "1.2.840.10008.5.1.4.1.1.7") + ", " +
                    element("00200013", "IS", std::to_string(n + 1)) + "}";
        return {200, type, "[" + list + "]", ""};
    }
    HttpAnswer retrieve(const std::string &uid) {
        m_sent.insert(uid);
        count();
        return {200, "multipart/related; type=\"application/dicom\"; boundary=part",
                "--part\r\nContent-Type: application/dicom\r\n\r\n" +
                    object(uid).file(DicomWriter::Form()) + "\r\n--part--\r\n",
                ""};
    }
    HttpAnswer store(const std::string &body) {
        for (int n = 0; n < objects; ++n)
            if (body.find(instance(n)) != std::string::npos) {
                m_stored.insert(instance(n));
                count();
                return {
                    200, "application/dicom+json",
                    "{" +
                        element("00081199", "SQ", "{" + uidElement("00081155", instance(n)) + "}") +
                        "}",
                    ""};
            }
        return {409, "text/plain", "", ""};
    }
    void count() {
        if (m_every > 0 && ++m_served % m_every == 0)
            m_tokens.expire();
    }

    Tokens &m_tokens;
    std::mutex m_mutex;
    std::string m_elsewhere;
    Script m_script;
    int m_every = 0, m_served = 0, m_refusals = 0;
    std::multiset<std::string> m_sent;
    std::set<std::string> m_stored;
    HttpServer m_http;
};

} // namespace pellucid::test
