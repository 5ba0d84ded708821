// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/http.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include <curl/curl.h>

#include "core/network/client/reasons.h"
#include "core/network/process/authorities.h"
#include "core/network/process/confine.h"
#include "core/network/process/connect.h"
#include "core/network/process/reasons.h"
#include "core/network/process/tls_profile.h"
#include "core/network/process/tls_reasons.h"
#include "core/platform/process.h"

namespace pellucid::network::process {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

} // namespace

// One easy handle with its only connection.
class HttpClient::Curl {
public:
    Curl(const Peer &peer, Control &control, int &confinement) : m_peer(peer), m_control(control) {
        platform::letBrokenPipesFail();
        ::curl_global_init(CURL_GLOBAL_DEFAULT);
        m_handle = ::curl_easy_init();
        // The first transfer makes what libcurl needs for itself, which no later one may make.
        ::curl_easy_setopt(m_handle, CURLOPT_URL, "file:///dev/null");
        ::curl_easy_perform(m_handle);
        ::curl_easy_reset(m_handle);
        if (peer.usesTls) {
            m_authorities = authorityCertificates(peer.authorities);
            if (!peer.certificate.empty()) {
                m_certificate = pemText(peer.certificate);
                m_key = pemText(peer.key);
            }
        }
        platform::Connected connected = connectTo(peer, control);
        m_socket = std::move(connected.socket);
        control.step(Step::tcp, peer.host + ":" + std::to_string(peer.port));
        m_origin = (peer.usesTls ? "https://" : "http://") + hostPart(peer.host) + ":" +
                   std::to_string(peer.port);
        m_resolved = ::curl_slist_append(nullptr, (peer.host + ":" + std::to_string(peer.port) +
                                                   ":" + hostPart(connected.address))
                                                      .c_str());
        confinement = confine();
    }
    ~Curl() {
        ::curl_easy_cleanup(m_handle);
        ::curl_slist_free_all(m_resolved);
    }
    Curl(const Curl &) = delete;
    Curl &operator=(const Curl &) = delete;

    Answer perform(const Request &request, const Take &take) {
        Answer answer = performOnce(request, take);
        for (int tries = 1; isBusy(answer.status) && tries < maxTries; ++tries) {
            await(answer, tries);
            answer = performOnce(request, take);
        }
        // Elsewhere on the same server only: a token must not go to another.
        Request moved = request;
        for (int n = 0; answer.status >= 300 && answer.status < 400 && !answer.location.empty();
             ++n) {
            if (n == maxTries)
                throw Error(ErrorCode::unusable, because::redirectsTooOften);
            moved.path = pathAt(answer.location, moved.path);
            answer = performOnce(moved, take);
        }
        return answer;
    }

private:
    struct Transfer {
        Curl *curl;
        Answer answer;
        const Request *request;
        const Take *take;
        std::size_t piece = 0, at = 0;
        std::exception_ptr failure;
    };

    // RFC 6585, 4; RFC 9110, 15.6.4
    static constexpr int maxTries = 5;
    static bool isBusy(long status) { return status == 429 || status == 503; }

    // The time that the server names, or else a second, then two, four ... A date is not read.
    void await(const Answer &answer, int tries) {
        constexpr double longestSeconds = 60.0;
        double seconds = 0.0;
        const std::string &named = answer.retryAfter;
        if (std::from_chars(named.data(), named.data() + named.size(), seconds).ec != std::errc())
            seconds = std::exp2(tries - 1);
        const auto end = std::chrono::steady_clock::now() +
                         std::chrono::duration<double>(std::clamp(seconds, 0.1, longestSeconds));
        while (std::chrono::steady_clock::now() < end) {
            if (m_control.isCancelled())
                throw CancelledByProgram();
            m_control.heartbeat();
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    }

    // The path that a location names, which may be relative to that of the request (RFC 3986, 5).
    std::string pathAt(const std::string &location, const std::string &requested) const {
        const std::unique_ptr<CURLU, decltype(&::curl_url_cleanup)> url(::curl_url(),
                                                                        &::curl_url_cleanup);
        const auto part = [&](CURLUPart which, unsigned flags = 0) {
            char *text = nullptr;
            std::string found;
            if (::curl_url_get(url.get(), which, &text, flags) == CURLUE_OK)
                found = text;
            ::curl_free(text);
            return found;
        };
        const auto origin = [&] {
            return part(CURLUPART_SCHEME) + "://" + part(CURLUPART_HOST) + ":" +
                   part(CURLUPART_PORT, CURLU_DEFAULT_PORT);
        };
        ::curl_url_set(url.get(), CURLUPART_URL, (m_origin + requested).c_str(), 0);
        const std::string here = origin(), host = part(CURLUPART_HOST);
        if (::curl_url_set(url.get(), CURLUPART_URL, location.c_str(), 0) != CURLUE_OK)
            throw Error(ErrorCode::unusable, because::serverPointsElsewhere);
        if (::curl_strequal(origin().c_str(), here.c_str()) != 0) {
            const std::string query = part(CURLUPART_QUERY);
            return part(CURLUPART_PATH) + (query.empty() ? "" : "?" + query);
        }
        if (!m_peer.usesTls && part(CURLUPART_SCHEME) == "https" &&
            ::curl_strequal(part(CURLUPART_HOST).c_str(), host.c_str()) != 0) {
            const std::string port = part(CURLUPART_PORT);
            throw Error(ErrorCode::unusable,
                        because::serverWantsHttps("https://" + host +
                                                  (port.empty() ? "" : ":" + port) + m_peer.path));
        }
        throw Error(ErrorCode::unusable, because::serverPointsElsewhere);
    }

    Answer performOnce(const Request &request, const Take &take) {
        Transfer transfer{this, {}, &request, &take, 0, 0, {}};
        CURL *const h = m_handle;
        ::curl_easy_reset(h); // keeps the connection
        const std::string url = m_origin + request.path;
        ::curl_easy_setopt(h, CURLOPT_URL, url.c_str());
        ::curl_easy_setopt(h, CURLOPT_NOSIGNAL, 1L);
        ::curl_easy_setopt(h, CURLOPT_PROXY, "");
        ::curl_easy_setopt(h, CURLOPT_RESOLVE, m_resolved);
        ::curl_easy_setopt(h, CURLOPT_HTTP_VERSION, CURL_HTTP_VERSION_1_1);
        // Asked for as it is; what is compressed all the same is unpacked.
        ::curl_easy_setopt(h, CURLOPT_ACCEPT_ENCODING, "identity");
        ::curl_easy_setopt(h, CURLOPT_PROTOCOLS_STR, "http,https");
        ::curl_easy_setopt(h, CURLOPT_DNS_CACHE_TIMEOUT, -1L);
        ::curl_easy_setopt(h, CURLOPT_OPENSOCKETFUNCTION, &Curl::openSocket);
        ::curl_easy_setopt(h, CURLOPT_OPENSOCKETDATA, this);
        ::curl_easy_setopt(h, CURLOPT_SOCKOPTFUNCTION, &Curl::isConnected);
        ::curl_easy_setopt(h, CURLOPT_CONNECTTIMEOUT, std::lround(m_peer.associationSeconds));
        // No limit on a whole transfer, only on silence.
        ::curl_easy_setopt(h, CURLOPT_LOW_SPEED_LIMIT, 1L);
        ::curl_easy_setopt(h, CURLOPT_LOW_SPEED_TIME, std::lround(m_peer.silenceSeconds));
        ::curl_easy_setopt(h, CURLOPT_WRITEFUNCTION, &Curl::write);
        ::curl_easy_setopt(h, CURLOPT_WRITEDATA, &transfer);
        ::curl_easy_setopt(h, CURLOPT_HEADERFUNCTION, &Curl::header);
        ::curl_easy_setopt(h, CURLOPT_HEADERDATA, &transfer);
        ::curl_easy_setopt(h, CURLOPT_NOPROGRESS, 0L);
        ::curl_easy_setopt(h, CURLOPT_XFERINFOFUNCTION, &Curl::progress);
        ::curl_easy_setopt(h, CURLOPT_XFERINFODATA, &transfer);
        std::array<char, CURL_ERROR_SIZE> said{};
        ::curl_easy_setopt(h, CURLOPT_ERRORBUFFER, said.data());
        setSecurity();
        curl_slist *headers = ::curl_slist_append(nullptr, ("Accept: " + request.accept).c_str());
        headers = ::curl_slist_append(headers, "Expect:");
        if (!request.body.empty()) {
            headers =
                ::curl_slist_append(headers, ("Content-Type: " + request.contentType).c_str());
            std::size_t bytes = 0;
            for (const auto &piece : request.body)
                bytes += piece.size();
            ::curl_easy_setopt(h, CURLOPT_POST, 1L);
            ::curl_easy_setopt(h, CURLOPT_POSTFIELDSIZE_LARGE, curl_off_t(bytes));
            ::curl_easy_setopt(h, CURLOPT_READFUNCTION, &Curl::read);
            ::curl_easy_setopt(h, CURLOPT_READDATA, &transfer);
        }
        ::curl_easy_setopt(h, CURLOPT_HTTPHEADER, headers);
        const CURLcode code = ::curl_easy_perform(h);
        ::curl_slist_free_all(headers);
        if (transfer.failure)
            std::rethrow_exception(transfer.failure);
        ::curl_easy_getinfo(h, CURLINFO_RESPONSE_CODE, &transfer.answer.status);
        if (code != CURLE_OK)
            fail(code, said.data());
        return std::move(transfer.answer);
    }

    void setSecurity() {
        CURL *const h = m_handle;
        if (m_peer.authentication == Authentication::basic) {
            ::curl_easy_setopt(h, CURLOPT_HTTPAUTH, CURLAUTH_BASIC);
            ::curl_easy_setopt(h, CURLOPT_USERNAME, m_peer.user.c_str());
            ::curl_easy_setopt(h, CURLOPT_PASSWORD, m_peer.secret.c_str());
        } else if (m_peer.authentication == Authentication::bearer) {
            ::curl_easy_setopt(h, CURLOPT_HTTPAUTH, CURLAUTH_BEARER);
            ::curl_easy_setopt(h, CURLOPT_XOAUTH2_BEARER, m_peer.secret.c_str());
        }
        if (!m_peer.usesTls)
            return;
        const auto blob = [&](CURLoption option, std::string &text) {
            curl_blob data{text.data(), text.size(), CURL_BLOB_NOCOPY};
            ::curl_easy_setopt(h, option, &data);
        };
        ::curl_easy_setopt(h, CURLOPT_SSL_CTX_FUNCTION, &Curl::secure);
        ::curl_easy_setopt(h, CURLOPT_SSL_VERIFYPEER, 1L);
        ::curl_easy_setopt(h, CURLOPT_SSL_VERIFYHOST, 2L);
        ::curl_easy_setopt(h, CURLOPT_CAPATH, nullptr);
        ::curl_easy_setopt(h, CURLOPT_CAINFO, nullptr);
        blob(CURLOPT_CAINFO_BLOB, m_authorities);
        if (m_certificate.empty())
            return;
        blob(CURLOPT_SSLCERT_BLOB, m_certificate);
        blob(CURLOPT_SSLKEY_BLOB, m_key);
        ::curl_easy_setopt(h, CURLOPT_KEYPASSWD, m_peer.keyPassword.c_str());
    }

    [[noreturn]] void fail(CURLcode code, const std::string &said) const {
        switch (code) {
        case CURLE_OPERATION_TIMEDOUT:
            throw Lost{because::serverIsSilent(std::lround(m_peer.silenceSeconds))};
        case CURLE_PEER_FAILED_VERIFICATION:
            throw Lost{certificateReason(said)};
        case CURLE_SSL_CONNECT_ERROR:
        case CURLE_SSL_CERTPROBLEM:
        case CURLE_SSL_CACERT_BADFILE:
            throw Lost{tlsReason(said)};
        case CURLE_COULDNT_CONNECT: // the only connection has been used up
        case CURLE_GOT_NOTHING:
        case CURLE_PARTIAL_FILE:
        case CURLE_RECV_ERROR:
        case CURLE_SEND_ERROR:
            // TLS 1.3 reports it only after the handshake.
            if (const task::Reason reason = tlsReason(said);
                reason.is(because::serverNeedsACertificate))
                throw Lost{reason};
            throw Lost{because::serverHungUp};
        default:
            throw Lost{because::connectionFails(said.empty() ? ::curl_easy_strerror(code) : said)};
        }
    }

    static CURLcode secure(CURL *, void *context, void *) {
        applyTlsProfile(static_cast<ssl_ctx_st *>(context));
        return CURLE_OK;
    }
    static curl_socket_t openSocket(void *self, curlsocktype, curl_sockaddr *) {
        // Afterwards it is libcurl's, which closes it.
        return curl_socket_t(static_cast<Curl *>(self)->m_socket.release());
    }
    static int isConnected(void *, curl_socket_t, curlsocktype) {
        return CURL_SOCKOPT_ALREADY_CONNECTED;
    }
    static std::size_t header(char *data, std::size_t size, std::size_t count, void *to) {
        auto &transfer = *static_cast<Transfer *>(to);
        const std::string line(data, size * count);
        if (line.starts_with("HTTP/")) { // of the last answer, not of an interim one
            transfer.answer = {};
            const auto space = line.find(' ');
            if (space != std::string::npos)
                transfer.answer.status = std::atol(line.c_str() + space);
            return size * count;
        }
        const auto colon = line.find(':');
        if (colon == std::string::npos)
            return size * count;
        std::string name = line.substr(0, colon), value = line.substr(colon + 1);
        std::transform(name.begin(), name.end(), name.begin(),
                       [](unsigned char c) { return char(std::tolower(c)); });
        const auto first = value.find_first_not_of(" \t"), last = value.find_last_not_of(" \t\r\n");
        value = first == std::string::npos ? "" : value.substr(first, last - first + 1);
        if (name == "content-type")
            transfer.answer.contentType = value;
        else if (name == "retry-after")
            transfer.answer.retryAfter = value;
        else if (name == "warning")
            transfer.answer.warning = value;
        else if (name == "location")
            transfer.answer.location = value;
        return size * count;
    }
    static std::size_t write(char *data, std::size_t size, std::size_t count, void *to) {
        auto &transfer = *static_cast<Transfer *>(to);
        const auto bytes = std::as_bytes(std::span(data, size * count));
        try {
            if (*transfer.take && transfer.answer.status >= 200 && transfer.answer.status < 300)
                (*transfer.take)(transfer.answer, bytes);
            else if (transfer.answer.text.size() + bytes.size() <= transfer.request->longestText)
                transfer.answer.text.append(data, size * count);
            else
                throw Error(ErrorCode::unusable, because::serverAnswerIsTooLong);
            return size * count;
        } catch (...) {
            transfer.failure = std::current_exception();
            return 0;
        }
    }
    static std::size_t read(char *data, std::size_t size, std::size_t count, void *from) {
        auto &transfer = *static_cast<Transfer *>(from);
        std::size_t given = 0;
        const auto &body = transfer.request->body;
        while (given < size * count && transfer.piece < body.size()) {
            const auto rest = body[transfer.piece].subspan(transfer.at);
            const std::size_t now = std::min(rest.size(), size * count - given);
            std::memcpy(data + given, rest.data(), now);
            given += now;
            transfer.at += now;
            if (transfer.at == body[transfer.piece].size()) {
                ++transfer.piece;
                transfer.at = 0;
            }
        }
        return given;
    }
    static int progress(void *from, curl_off_t, curl_off_t, curl_off_t, curl_off_t) {
        auto &transfer = *static_cast<Transfer *>(from);
        try {
            if (!transfer.failure && transfer.curl->m_control.isCancelled())
                throw CancelledByProgram();
            transfer.curl->m_control.heartbeat();
        } catch (...) {
            transfer.failure = std::current_exception();
        }
        return transfer.failure ? 1 : 0;
    }

    const Peer m_peer;
    Control &m_control;
    CURL *m_handle = nullptr;
    curl_slist *m_resolved = nullptr;
    platform::Handle m_socket;
    std::string m_origin, m_authorities, m_certificate, m_key;
};

HttpClient::HttpClient(const Peer &peer, Control &control)
    : m_curl(std::make_unique<Curl>(peer, control, m_confinement)) {}

HttpClient::~HttpClient() = default;

HttpClient::Answer HttpClient::perform(const Request &request, const Take &take) {
    return m_curl->perform(request, take);
}

} // namespace pellucid::network::process
