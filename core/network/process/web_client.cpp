// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/web_client.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/files/mapping.h"
#include "core/network/client/reasons.h"
#include "core/network/process/dicom_json.h"
#include "core/network/process/file_start.h"
#include "core/network/process/multipart.h"
#include "core/network/process/reasons.h"
#include "core/network/process/statuses.h"
#include "core/platform/process.h"
#include "core/system/utf8.h"

namespace pellucid::network::process {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

std::string tagText(std::uint32_t tag) {
    return fmt::format("{:08X}", tag);
}

// Plain in a value of a URL's query, unlike in libcurl: Orthanc 1.10 does not decode %5E.
constexpr const char *plainInQueries = "-_.~^*?:,";

// What a server says about an error for people to read, in one line: a text, or the title of a
// page.
std::string remarkOf(const HttpClient::Answer &answer) {
    constexpr std::size_t longest = 200;
    std::string text = answer.text;
    if (answer.contentType.starts_with("text/html")) {
        const auto begin = text.find("<title>"), end = text.find("</title>");
        text = begin < end && end != std::string::npos ? text.substr(begin + 7, end - begin - 7)
                                                       : std::string();
    } else if (!answer.contentType.starts_with("text/plain")) {
        return {};
    }
    std::replace_if(
        text.begin(), text.end(), [](char c) { return (unsigned char)(c) < 0x20; }, ' ');
    text.erase(text.find_last_not_of(' ') + 1);
    text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
    return system::isUtf8(text) ? shortened(text, longest) : std::string();
}

// The reason of an answer that is not what was asked for.
task::Reason httpReason(const HttpClient::Answer &answer) {
    const long status = answer.status;
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
        return because::serverTakesNoSuchSize;
    case 502:
    case 504:
        return because::proxyHasNoServer(status);
    default:
        break;
    }
    // nginx answers so, with a page in which this is the only sign.
    if (answer.text.find("SSL certificate was sent") != std::string::npos)
        return because::serverNeedsACertificate;
    if (status < 300) // of an answer that was to end with a delimiter
        return because::answerEndsTooEarly;
    const task::Reason reason = because::serverAnswersHttp(status);
    const std::string remark = remarkOf(answer);
    return remark.empty() ? reason : because::serverSays(reason, remark);
}

[[noreturn]] void fail(const HttpClient::Answer &answer) {
    throw Error(ErrorCode::unusable, httpReason(answer));
}

// An object that was sent is not in the server's list of what it stored.
[[noreturn]] void notConfirmed(const HttpClient::Answer &answer) {
    if (answer.status >= 300)
        fail(answer);
    throw Error(ErrorCode::unusable, because::serverDoesNotConfirm);
}

} // namespace

// The objects of an answer, which become files of the program.
class WebClient::Objects {
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
        open(false);
    }
    void end() {
        if (!m_storage && !m_isRefused && !m_start.empty())
            open(true);
        if (!m_storage)
            return;
        if (m_storage->finish() == status::success)
            ++m_end.completed;
        else
            ++m_end.failed;
        m_storage.reset();
    }
    RetrievalEnd &result() { return m_end; }

private:
    // When its UIDs are known. `isWhole`: no more bytes come.
    void open(bool isWhole) {
        std::optional<FileStart> start;
        try {
            start = readFileStart(m_start, isWhole);
        } catch (const Error &) {
            m_isRefused = true; // an answer that is no object
            ++m_end.failed;
            m_end.reason = task::Reason(because::serverSendsNoObject).encoded();
            return;
        }
        if (!start)
            return;
        m_storage.emplace(m_control, start->arrival);
        if (m_storage->isWanted()) {
            m_storage->write(m_start);
        } else {
            m_storage.reset();
            m_isRefused = true;
        }
    }

    Control &m_control;
    std::vector<std::byte> m_start;
    std::optional<Storage> m_storage;
    bool m_isRefused = false;
    RetrievalEnd m_end;
};

WebClient::WebClient(const Connection &connection, Control &control)
    : m_path(connection.peer.path), m_http(connection.peer, control) {}

void WebClient::echo(Control &control) {
    const auto answer =
        m_http.perform({m_path + "/studies?limit=1", "application/dicom+json", {}, {}}, {});
    if (answer.status >= 300)
        fail(answer);
    readDicomJson(answer.text);
    control.step(Step::service, "QIDO-RS");
}

QueryEnd WebClient::find(const Query &query, Control &control) {
    const auto key = [&](std::uint32_t tag) {
        const auto at = query.keys.find(tag);
        return at == query.keys.end() ? std::string() : at->second;
    };
    std::string path = m_path + "/studies";
    std::set<std::uint32_t> inPath;
    if (query.level != Level::study) {
        path += "/" + key(tag::studyUid) + "/series";
        inPath.insert(tag::studyUid);
    }
    if (query.level == Level::image) {
        path += "/" + key(tag::seriesUid) + "/instances";
        inPath.insert(tag::seriesUid);
    }
    std::string terms;
    for (const auto &[tag, value] : query.keys) {
        if (inPath.contains(tag))
            continue;
        if (value.empty() && m_asksPlainly)
            continue;
        if (value.empty()) {
            terms += "&includefield=" + tagText(tag);
            continue;
        }
        terms += "&" + tagText(tag) + "=" + percentEncoded(value, plainInQueries);
    }
    const std::uint32_t uidTag = uidOf(query.level);
    QueryEnd end;
    std::set<std::string> known;
    bool saysMore = false; // the server, of what follows a page
    for (std::uint32_t offset = query.skip;;) {
        auto answer = m_http.perform(
            {fmt::format("{}?limit={}&offset={}{}", path, matchesOfPage, offset, terms),
             "application/dicom+json",
             {},
             {}},
            {});
        // Some servers refuse attributes that they do not know, and list those that they have.
        if (answer.status == 400 && !m_asksPlainly && offset == query.skip &&
            terms.find("includefield") != terms.npos) {
            m_asksPlainly = true;
            return find(query, control);
        }
        if (answer.status == 204) {
            end.mayBeIncomplete = saysMore;
            return end;
        }
        if (answer.status >= 300)
            fail(answer);
        // Those of earlier pages have been answered by the next.
        end.warnings.clear();
        if (!answer.warning.empty())
            end.warnings.push_back(shortened(answer.warning, longestComment));
        bool hasNew = false;
        std::vector<Attributes> matches = readDicomJson(answer.text);
        for (Attributes &match : matches) {
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
            control.match(query, std::move(match));
        }
        if (!hasNew) {
            // A page again: the server knows no offsets, and what follows is not to be had.
            end.mayBeIncomplete = saysMore || (!matches.empty() && offset > query.skip);
            return end;
        }
        saysMore = !answer.warning.empty() || answer.status == 206;
        if (control.isCancelled())
            throw CancelledByProgram();
    }
}

RetrievalEnd WebClient::retrieve(const Retrieval &retrieval, Control &control) {
    Objects objects(control);
    const std::string series =
        m_path + "/studies/" + retrieval.studyUid +
        (retrieval.level == Level::study ? "" : "/series/" + retrieval.seriesUid);
    std::vector<std::string> paths;
    if (retrieval.level == Level::image)
        for (const std::string &uid : retrieval.instanceUids)
            paths.push_back(series + "/instances/" + uid);
    else
        paths.push_back(series);
    for (std::size_t n = 0; n < paths.size(); ++n) {
        const Fetched fetched = fetch(paths[n], objects);
        // Some servers send whole series only. What is not awaited of it, the program refuses.
        if (retrieval.level == Level::image && !m_sendsInstances &&
            (fetched.answer.status == 404 || fetched.answer.status == 405))
            if (const Fetched whole = fetch(series, objects); whole.isWhole)
                return objects.result();
        if (fetched.isWhole) {
            m_sendsInstances = true;
            continue;
        }
        const long status = fetched.answer.status;
        if (retrieval.level == Level::image && status != 401 && status != 403 &&
            isUid(retrieval.instanceUids[n])) {
            ++objects.result().failed;
            objects.result().reason = httpReason(fetched.answer).encoded();
            objects.result().failedInstances.push_back(retrieval.instanceUids[n]);
        } else {
            fail(fetched.answer);
        }
    }
    return objects.result();
}

WebClient::Fetched WebClient::fetch(const std::string &path, Objects &objects) {
    std::optional<MultipartReader> reader;
    HttpClient::Answer answer = m_http.perform(
        {path,
         std::string("multipart/related; type=\"application/dicom\"") +
             (m_namesAnySyntax ? "; transfer-syntax=*" : ""),
         {},
         {}},
        [&](const HttpClient::Answer &so_far, std::span<const std::byte> bytes) {
            if (!reader)
                reader.emplace(so_far.contentType,
                               MultipartReader::Sink{
                                   [&] { objects.begin(); },
                                   [&](std::span<const std::byte> part) { objects.take(part); },
                                   [&] { objects.end(); }});
            reader->add(bytes);
        });
    // Some servers do not know the asterisk.
    if ((answer.status == 406 || answer.status == 400) && m_namesAnySyntax) {
        m_namesAnySyntax = false;
        return fetch(path, objects);
    }
    if (answer.status == 206)
        objects.result().reason = task::Reason(because::serverCouldNotSendAll).encoded();
    return {answer, answer.status < 300 && reader && reader->finish()};
}

std::optional<task::Reason> WebClient::store(platform::HandleView file, std::uint64_t bytes,
                                             Control &) {
    const files::Mapping mapping(file, bytes, files::Mapping::Access::read);
    const std::string uid = startOf(mapping.bytes()).arrival.sopInstanceUid;
    // No data set contains it: 128 random bits.
    std::array<std::byte, 16> random{};
    platform::fillRandomly(random);
    std::string boundary = "pellucid-";
    for (const std::byte byte : random)
        boundary += fmt::format("{:02x}", unsigned(byte));
    const std::string head = "--" + boundary + "\r\nContent-Type: application/dicom\r\n\r\n",
                      tail = "\r\n--" + boundary + "--\r\n";
    const auto answer = m_http.perform(
        {m_path + "/studies",
         "application/dicom+json",
         "multipart/related; type=\"application/dicom\"; boundary=" + boundary,
         {std::as_bytes(std::span(head)), mapping.bytes(), std::as_bytes(std::span(tail))}},
        {});
    if (answer.status == 401 || answer.status == 403) // often with a page, which is no list
        fail(answer);
    const bool hasList = answer.text.find('{') != std::string::npos;
    if (!hasList)
        notConfirmed(answer);
    // A status of success alone means nothing: only the list of what is stored does.
    const StoreAnswer stored = [&] {
        try {
            return readStoreAnswer(answer.text);
        } catch (const Error &) { // a page, in which a brace says nothing
            if (answer.status < 300)
                throw;
            fail(answer);
        }
    }();
    const auto at = [&](const std::vector<StoreAnswer::Item> &items) {
        return std::find_if(items.begin(), items.end(),
                            [&](const StoreAnswer::Item &one) { return one.uid == uid; });
    };
    if (const auto failed = at(stored.failed); failed != stored.failed.end())
        throw Error(ErrorCode::unusable, statusReason(std::uint16_t(failed->reason), {}));
    const auto confirmed = at(stored.stored);
    if (confirmed == stored.stored.end())
        notConfirmed(answer);
    return confirmed->reason == 0 ? std::nullopt
                                  : std::optional(changeReason(std::uint16_t(confirmed->reason)));
}

} // namespace pellucid::network::process
