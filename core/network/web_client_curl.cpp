// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/web_client.h"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <netdb.h>
#include <netinet/tcp.h>
#include <optional>
#include <poll.h>
#include <set>
#include <sstream>
#include <strings.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <curl/curl.h>
#include <fmt/format.h>

#include "core/decoder/channel.h"
#include "core/network/authorities.h"
#include "core/network/confine.h"
#include "core/network/dicom_json.h"
#include "core/network/file_start.h"
#include "core/network/multipart.h"
#include "core/network/statuses.h"

// libcurl 7.88 connects even a socket that it is told is connected. In this process that call is
// forbidden by then, so it is answered here: the linker puts this function in place of libc's.
extern "C" int connect(int socket, const sockaddr *address, socklen_t size) {
    sockaddr_storage peer{};
    socklen_t peerSize = sizeof peer;
    if (::getpeername(socket, reinterpret_cast<sockaddr *>(&peer), &peerSize) == 0)
        return 0;
    return int(::syscall(SYS_connect, socket, address, size));
}

namespace pellucid::network {

namespace {

namespace because = task::because;
using exchange::Level;
using exchange::Peer;
using exchange::Step;
using task::Error;
using task::ErrorCode;

constexpr std::size_t longestAnswer = 256 << 20; // of JSON
constexpr std::uint32_t pageSize = 200;

std::string fileText(const std::string &path) {
    std::ifstream in(path, std::ios::binary);
    if (!in)
        throw Error(ErrorCode::usage, because::isNoPemFile(std::strerror(errno)), path);
    return {std::istreambuf_iterator<char>(in), {}};
}

// Connects within the time; -1 with `errno`.
int connectWithin(const addrinfo &address, double seconds) {
    const int socket = ::socket(address.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (socket < 0)
        return -1;
    int error = 0;
    if (::connect(socket, address.ai_addr, address.ai_addrlen) != 0) {
        error = errno;
        pollfd waiting{socket, POLLOUT, 0};
        if (error == EINPROGRESS && ::poll(&waiting, 1, int(std::lround(seconds * 1000.0))) > 0) {
            socklen_t size = sizeof error;
            ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size);
        } else if (error == EINPROGRESS) {
            error = ETIMEDOUT;
        }
    }
    if (error == 0) {
        const int on = 1;
        ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        return socket;
    }
    ::close(socket);
    errno = error;
    return -1;
}

struct Connected {
    int socket = -1;
    std::string address;
};

Connected connectTo(const Peer &peer, Control &control) {
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    addrinfo *found = nullptr;
    const std::string port = std::to_string(peer.port);
    if (::getaddrinfo(peer.host.c_str(), port.c_str(), &wanted, &found) != 0)
        throw Lost{because::hostIsUnknown(peer.host)};
    Connected connected;
    int error = 0;
    for (const addrinfo *each = found; each != nullptr && connected.socket < 0;
         each = each->ai_next) {
        std::array<char, INET6_ADDRSTRLEN> text{};
        ::getnameinfo(each->ai_addr, each->ai_addrlen, text.data(), text.size(), nullptr, 0,
                      NI_NUMERICHOST);
        if (connected.address.empty())
            control.step(Step::name, text.data());
        connected.address = text.data();
        connected.socket = connectWithin(*each, peer.connectSeconds);
        error = errno;
    }
    ::freeaddrinfo(found);
    if (connected.socket >= 0)
        return connected;
    if (error == ECONNREFUSED)
        throw Lost{because::connectionIsRefused};
    if (error == ETIMEDOUT)
        throw Lost{because::hostDoesNotAnswer};
    throw Lost{because::cannotConnect(task::systemReason(error))};
}

std::string tagText(std::uint32_t tag) {
    return fmt::format("{:08X}", tag);
}

// A value of a URL's query. Unlike libcurl, leaves ^, * and ? as browsers do: Orthanc 1.10 does not
// decode %5E.
std::string escaped(const std::string &text) {
    std::string url;
    for (const char c : text) {
        const bool isPlain =
            std::isalnum((unsigned char)(c)) != 0 || std::strchr("-_.~^*?:,", c) != nullptr;
        url += isPlain ? std::string(1, c) : fmt::format("%{:02X}", (unsigned char)(c));
    }
    return url;
}

// The reason of an answer with a status beyond 299.
task::Reason httpReason(long status) {
    switch (status) {
    case 401:
        return because::serverDoesNotAcceptTheLogin;
    case 403:
        return because::serverDoesNotAllowIt;
    case 404:
        return because::serverHasNothingThere;
    case 408:
    case 429:
    case 503:
        return because::serverIsBusy;
    case 413:
        return because::serverIsOutOfResources;
    default:
        return because::serverAnswersHttp(status);
    }
}

// The objects of an answer, which become files of the program.
class Objects {
public:
    explicit Objects(Control &control) : m_control(control) {}

    void begin() {
        m_start.clear();
        m_storage.reset();
        m_isRefused = false;
    }
    void take(std::span<const std::byte> bytes) {
        if (m_isRefused)
            return;
        if (m_storage) {
            m_storage->write(bytes);
            return;
        }
        m_start.insert(m_start.end(), bytes.begin(), bytes.end());
        std::optional<exchange::Arrival> arrival;
        try {
            arrival = arrivalOf(m_start);
        } catch (const Error &) {
            m_isRefused = true; // an answer that is no object
            ++m_end.failed;
            return;
        }
        if (!arrival)
            return;
        m_storage.emplace(m_control, *arrival);
        m_uid = arrival->sopInstanceUid;
        if (m_storage->isWanted()) {
            m_storage->write(m_start);
        } else {
            m_storage.reset();
            m_isRefused = true;
        }
    }
    void end() {
        if (!m_storage)
            return;
        if (m_storage->finish() == success)
            ++m_end.completed;
        else
            ++m_end.failed;
        m_storage.reset();
    }
    exchange::RetrievalEnd &result() { return m_end; }

private:
    Control &m_control;
    std::vector<std::byte> m_start;
    std::optional<Storage> m_storage;
    std::string m_uid;
    bool m_isRefused = false;
    exchange::RetrievalEnd m_end;
};

} // namespace

// One easy handle with its only connection.
class WebClient::Curl {
public:
    Curl(const Peer &peer, Control &control, int &confinement) : m_control(control) {
        ::signal(SIGPIPE, SIG_IGN);
        ::curl_global_init(CURL_GLOBAL_DEFAULT);
        m_handle = ::curl_easy_init();
        // The first transfer makes what libcurl needs for itself, which no later one may make.
        ::curl_easy_setopt(m_handle, CURLOPT_URL, "file:///dev/null");
        ::curl_easy_perform(m_handle);
        ::curl_easy_reset(m_handle);
        if (peer.usesTls) {
            m_authorities =
                fileText(peer.authorities.empty() ? systemAuthoritiesFile() : peer.authorities);
            if (!peer.certificate.empty()) {
                m_certificate = fileText(peer.certificate);
                m_key = fileText(peer.key);
            }
        }
        const Connected connected = connectTo(peer, control);
        m_socket = connected.socket;
        control.step(Step::tcp, peer.host + ":" + std::to_string(peer.port));
        m_origin =
            (peer.usesTls ? "https://" : "http://") + peer.host + ":" + std::to_string(peer.port);
        const bool isV6 = connected.address.find(':') != std::string::npos;
        m_resolved = ::curl_slist_append(
            nullptr, (peer.host + ":" + std::to_string(peer.port) + ":" +
                      (isV6 ? "[" + connected.address + "]" : connected.address))
                         .c_str());
        confinement = confine();
    }
    ~Curl() {
        ::curl_easy_cleanup(m_handle);
        ::curl_slist_free_all(m_resolved);
        if (m_socket >= 0)
            ::close(m_socket);
    }
    Curl(const Curl &) = delete;
    Curl &operator=(const Curl &) = delete;

    struct Request {
        std::string path;
        std::string accept;
        std::string contentType;
        /// The body of a POST, piece by piece.
        std::vector<std::span<const std::byte>> body;
    };
    struct Answer {
        long status = 0;
        std::string contentType, warning, location;
        std::string text; ///< unless it is taken as it comes
    };
    /// `take`: gets the bytes of a successful answer.
    Answer perform(const Peer &peer, const Request &request,
                   const std::function<void(const Answer &, std::span<const std::byte>)> &take) {
        Answer answer = performOnce(peer, request, take);
        // Elsewhere on the same server only: a token must not go to another.
        if (answer.status >= 300 && answer.status < 400 && !answer.location.empty()) {
            Request moved = request;
            moved.path = pathAt(answer.location);
            answer = performOnce(peer, moved, take);
        }
        return answer;
    }

private:
    struct Transfer {
        Curl *curl;
        Answer answer;
        const Request *request;
        const std::function<void(const Answer &, std::span<const std::byte>)> *take;
        std::size_t piece = 0, at = 0;
        std::exception_ptr failure;
    };

    std::string pathAt(const std::string &location) const {
        if (location.starts_with("/"))
            return location;
        // Servers leave out the port of their protocol; the case of hosts does not matter.
        std::string withoutPort = m_origin;
        for (const char *const port : {":443", ":80"})
            if (withoutPort.ends_with(port) && withoutPort.starts_with("https") == (port[1] == '4'))
                withoutPort.resize(withoutPort.size() - std::strlen(port));
        for (const std::string &origin : {m_origin, withoutPort})
            if (location.size() > origin.size() && location[origin.size()] == '/' &&
                ::strncasecmp(location.c_str(), origin.c_str(), origin.size()) == 0)
                return location.substr(origin.size());
        throw Error(ErrorCode::unusable, because::serverPointsElsewhere);
    }

    Answer
    performOnce(const Peer &peer, const Request &request,
                const std::function<void(const Answer &, std::span<const std::byte>)> &take) {
        Transfer transfer{this, {}, &request, &take, 0, 0, {}};
        CURL *const h = m_handle;
        ::curl_easy_reset(h); // keeps the connection
        const std::string url = m_origin + request.path;
        ::curl_easy_setopt(h, CURLOPT_URL, url.c_str());
        ::curl_easy_setopt(h, CURLOPT_NOSIGNAL, 1L);
        ::curl_easy_setopt(h, CURLOPT_PROXY, "");
        ::curl_easy_setopt(h, CURLOPT_RESOLVE, m_resolved);
        ::curl_easy_setopt(h, CURLOPT_HTTP_VERSION, CURL_HTTP_VERSION_1_1);
        ::curl_easy_setopt(h, CURLOPT_PROTOCOLS_STR, "http,https");
        ::curl_easy_setopt(h, CURLOPT_DNS_CACHE_TIMEOUT, -1L);
        ::curl_easy_setopt(h, CURLOPT_OPENSOCKETFUNCTION, &Curl::openSocket);
        ::curl_easy_setopt(h, CURLOPT_OPENSOCKETDATA, this);
        ::curl_easy_setopt(h, CURLOPT_SOCKOPTFUNCTION, &Curl::isConnected);
        ::curl_easy_setopt(h, CURLOPT_CONNECTTIMEOUT, std::lround(peer.associationSeconds));
        // No limit on a whole transfer, only on silence.
        ::curl_easy_setopt(h, CURLOPT_LOW_SPEED_LIMIT, 1L);
        ::curl_easy_setopt(h, CURLOPT_LOW_SPEED_TIME, std::lround(peer.silenceSeconds));
        ::curl_easy_setopt(h, CURLOPT_WRITEFUNCTION, &Curl::write);
        ::curl_easy_setopt(h, CURLOPT_WRITEDATA, &transfer);
        ::curl_easy_setopt(h, CURLOPT_HEADERFUNCTION, &Curl::header);
        ::curl_easy_setopt(h, CURLOPT_HEADERDATA, &transfer);
        ::curl_easy_setopt(h, CURLOPT_NOPROGRESS, 0L);
        ::curl_easy_setopt(h, CURLOPT_XFERINFOFUNCTION, &Curl::progress);
        ::curl_easy_setopt(h, CURLOPT_XFERINFODATA, &transfer);
        std::array<char, CURL_ERROR_SIZE> said{};
        ::curl_easy_setopt(h, CURLOPT_ERRORBUFFER, said.data());
        setSecurity(peer);
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
            fail(code, said.data(), peer);
        return std::move(transfer.answer);
    }

    void setSecurity(const Peer &peer) {
        CURL *const h = m_handle;
        if (peer.authentication == exchange::Authentication::basic) {
            ::curl_easy_setopt(h, CURLOPT_HTTPAUTH, CURLAUTH_BASIC);
            ::curl_easy_setopt(h, CURLOPT_USERNAME, peer.user.c_str());
            ::curl_easy_setopt(h, CURLOPT_PASSWORD, peer.secret.c_str());
        } else if (peer.authentication == exchange::Authentication::bearer) {
            ::curl_easy_setopt(h, CURLOPT_HTTPAUTH, CURLAUTH_BEARER);
            ::curl_easy_setopt(h, CURLOPT_XOAUTH2_BEARER, peer.secret.c_str());
        }
        if (!peer.usesTls)
            return;
        const auto blob = [&](CURLoption option, std::string &text) {
            curl_blob data{text.data(), text.size(), CURL_BLOB_NOCOPY};
            ::curl_easy_setopt(h, option, &data);
        };
        ::curl_easy_setopt(h, CURLOPT_SSLVERSION, long(CURL_SSLVERSION_TLSv1_2));
        ::curl_easy_setopt(h, CURLOPT_SSL_VERIFYPEER, 1L);
        ::curl_easy_setopt(h, CURLOPT_SSL_VERIFYHOST, 2L);
        ::curl_easy_setopt(h, CURLOPT_CAPATH, nullptr);
        ::curl_easy_setopt(h, CURLOPT_CAINFO, nullptr);
        blob(CURLOPT_CAINFO_BLOB, m_authorities);
        if (m_certificate.empty())
            return;
        blob(CURLOPT_SSLCERT_BLOB, m_certificate);
        blob(CURLOPT_SSLKEY_BLOB, m_key);
        ::curl_easy_setopt(h, CURLOPT_KEYPASSWD, peer.keyPassword.c_str());
    }

    [[noreturn]] static void fail(CURLcode code, const std::string &said, const Peer &peer) {
        switch (code) {
        case CURLE_OPERATION_TIMEDOUT:
            throw Lost{because::serverIsSilent(std::lround(peer.silenceSeconds))};
        case CURLE_PEER_FAILED_VERIFICATION:
            throw Lost{because::certificateIsRefused(said)};
        case CURLE_SSL_CONNECT_ERROR:
        case CURLE_SSL_CERTPROBLEM:
        case CURLE_SSL_CACERT_BADFILE:
            throw Lost{because::tlsFails(said)};
        case CURLE_COULDNT_CONNECT: // the only connection has been used up
        case CURLE_GOT_NOTHING:
        case CURLE_PARTIAL_FILE:
        case CURLE_RECV_ERROR:
        case CURLE_SEND_ERROR:
            throw Lost{because::serverHungUp};
        default:
            throw Lost{because::connectionFails(said.empty() ? ::curl_easy_strerror(code) : said)};
        }
    }

    static curl_socket_t openSocket(void *self, curlsocktype, curl_sockaddr *) {
        // Afterwards it is libcurl's, which closes it.
        return std::exchange(static_cast<Curl *>(self)->m_socket, CURL_SOCKET_BAD);
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
            else if (transfer.answer.text.size() + bytes.size() <= longestAnswer)
                transfer.answer.text.append(data, size * count);
            else
                throw Error(ErrorCode::unusable, because::serverSendsNoDicomJson);
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

    Control &m_control;
    CURL *m_handle = nullptr;
    curl_slist *m_resolved = nullptr;
    int m_socket = -1;
    std::string m_origin, m_authorities, m_certificate, m_key;
};

WebClient::WebClient(const exchange::Connection &connection, Control &control)
    : m_peer(connection.peer) {
    m_curl = std::make_unique<Curl>(m_peer, control, m_confinement);
}

WebClient::~WebClient() = default;

void WebClient::echo(Control &control) {
    const auto answer = m_curl->perform(
        m_peer, {m_peer.path + "/studies?limit=1", "application/dicom+json", {}, {}}, {});
    if (answer.status >= 300)
        throw Error(ErrorCode::unusable, httpReason(answer.status));
    readDicomJson(answer.text);
    control.step(Step::service, "QIDO-RS");
}

exchange::QueryEnd WebClient::find(const exchange::Query &query, Control &control) {
    const auto key = [&](std::uint32_t tag) {
        const auto at = query.keys.find(tag);
        return at == query.keys.end() ? std::string() : at->second;
    };
    std::string path = m_peer.path + "/studies";
    std::set<std::uint32_t> inPath;
    if (query.level != Level::study) {
        path += "/" + key(exchange::tag::studyUid) + "/series";
        inPath.insert(exchange::tag::studyUid);
    }
    if (query.level == Level::image) {
        path += "/" + key(exchange::tag::seriesUid) + "/instances";
        inPath.insert(exchange::tag::seriesUid);
    }
    std::string terms;
    for (const auto &[tag, value] : query.keys) {
        if (inPath.contains(tag))
            continue;
        if (value.empty()) {
            terms += "&includefield=" + tagText(tag);
            continue;
        }
        terms += "&" + tagText(tag) + "=" + escaped(value);
    }
    const std::uint32_t uidTag = query.level == Level::study    ? exchange::tag::studyUid
                                 : query.level == Level::series ? exchange::tag::seriesUid
                                                                : exchange::tag::sopInstanceUid;
    exchange::QueryEnd end;
    std::set<std::string> known;
    for (std::uint32_t offset = 0;;) {
        const auto answer =
            m_curl->perform(m_peer,
                            {fmt::format("{}?limit={}&offset={}{}", path, pageSize, offset, terms),
                             "application/dicom+json",
                             {},
                             {}},
                            {});
        if (answer.status == 204)
            return end;
        if (answer.status >= 300)
            throw Error(ErrorCode::unusable, httpReason(answer.status));
        if (!answer.warning.empty() && end.warnings.empty())
            end.warnings.push_back(answer.warning);
        bool hasNew = false;
        for (exchange::Attributes &match : readDicomJson(answer.text)) {
            ++offset;
            // Servers without offsets send the same page again and again.
            if (!known.insert(match[uidTag]).second)
                continue;
            hasNew = true;
            if (query.limit != 0 && known.size() > query.limit) {
                end.reachedLimit = true;
                return end;
            }
            for (const auto &[tag, value] : query.keys)
                if (inPath.contains(tag))
                    match[tag] = value;
            control.send({Message::Kind::match, 0, 0, exchange::pack(match)});
        }
        if (!hasNew)
            return end;
        if (control.isCancelled())
            throw CancelledByProgram();
    }
}

exchange::RetrievalEnd WebClient::get(const exchange::Retrieval &retrieval, Control &control) {
    Objects objects(control);
    const std::string series =
        m_peer.path + "/studies/" + retrieval.studyUid +
        (retrieval.level == Level::study ? "" : "/series/" + retrieval.seriesUid);
    std::vector<std::string> paths;
    if (retrieval.level == Level::image)
        for (const std::string &uid : retrieval.instanceUids)
            paths.push_back(series + "/instances/" + uid);
    else
        paths.push_back(series);
    for (std::size_t n = 0; n < paths.size(); ++n) {
        std::optional<MultipartReader> reader;
        const auto answer = m_curl->perform(
            m_peer,
            {paths[n], "multipart/related; type=\"application/dicom\"; transfer-syntax=*", {}, {}},
            [&](const Curl::Answer &so_far, std::span<const std::byte> bytes) {
                if (!reader)
                    reader.emplace(so_far.contentType,
                                   MultipartReader::Sink{
                                       [&] { objects.begin(); },
                                       [&](std::span<const std::byte> part) { objects.take(part); },
                                       [&] { objects.end(); }});
                reader->add(bytes);
            });
        const bool isFailed = answer.status >= 300 || !reader || !reader->finish();
        if (answer.status == 401 || answer.status == 403)
            throw Error(ErrorCode::unusable, httpReason(answer.status));
        if (isFailed && retrieval.level == Level::image &&
            exchange::isUid(retrieval.instanceUids[n])) {
            ++objects.result().failed;
            objects.result().failedInstances.push_back(retrieval.instanceUids[n]);
        } else if (isFailed) {
            throw Error(ErrorCode::unusable, httpReason(answer.status));
        }
    }
    return objects.result();
}

void WebClient::store(int file, std::uint64_t bytes, Control &) {
    const decoder::Mapping mapping(file, bytes, decoder::Mapping::Access::read);
    const auto arrival =
        arrivalOf(mapping.bytes().first(std::min<std::size_t>(mapping.bytes().size(), 128 << 10)));
    if (!arrival)
        throw Error(ErrorCode::unusable, because::isNotDicom);
    // No data set contains it: 128 random bits.
    std::array<unsigned char, 16> random{};
    (void)!::getentropy(random.data(), random.size());
    std::string boundary = "pellucid-";
    for (const unsigned char byte : random)
        boundary += fmt::format("{:02x}", byte);
    const std::string head = "--" + boundary + "\r\nContent-Type: application/dicom\r\n\r\n",
                      tail = "\r\n--" + boundary + "--\r\n";
    const auto answer = m_curl->perform(
        m_peer,
        {m_peer.path + "/studies",
         "application/dicom+json",
         "multipart/related; type=\"application/dicom\"; boundary=" + boundary,
         {std::as_bytes(std::span(head)), mapping.bytes(), std::as_bytes(std::span(tail))}},
        {});
    const bool hasList = answer.text.find('{') != std::string::npos;
    if (!hasList)
        throw Error(ErrorCode::unusable, answer.status >= 300 ? httpReason(answer.status)
                                                              : because::serverDoesNotConfirm);
    // A status of success alone means nothing: only the list of what is stored does.
    const StoreAnswer stored = readStoreAnswer(answer.text);
    for (const StoreAnswer::Failed &failed : stored.failed)
        if (failed.uid == arrival->sopInstanceUid)
            throw Error(ErrorCode::unusable, statusReason(std::uint16_t(failed.reason), {}));
    if (std::find(stored.stored.begin(), stored.stored.end(), arrival->sopInstanceUid) ==
        stored.stored.end())
        throw Error(ErrorCode::unusable, answer.status >= 300 ? httpReason(answer.status)
                                                              : because::serverDoesNotConfirm);
}

} // namespace pellucid::network
