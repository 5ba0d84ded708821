// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "core/archive/server.h"
#include "tests/network/http_server.h"
#include "tests/network/pacs.h"
#include "tests/support/dicom_writer.h"

namespace pellucid::test {

/// How retrieved objects are wrapped.
struct Wrapping {
    std::string boundary = "part";
    bool isQuoted = false;
    std::string type{}; ///< of the answer; empty: as it is
    std::string lineEnd = "\r\n", head = "Content-Type: application/dicom", preamble{}, end = "--";
    bool isLeftOutOfOne = false; ///< a single object comes as it is
    bool hasEmptyParts = false;  ///< one after each object
    bool hasWrongLengths = false;
    std::vector<std::string> extra{}; ///< parts that nobody has asked for
    /// What comes in place of an object.
    std::function<std::string(int n, const std::string &object)> body{};
};

/// Where a server redirects each request to.
enum class Redirect { none, absolute, absolutePath, relative, otherServer, loop };

/// What a server does differently.
struct Quirks {
    int objects = 64;          ///< of its series
    int studies = 1;           ///< that it lists; the series is in the first
    int cap = 0;               ///< entries that it lists at most
    int pageCap = 0;           ///< entries of a page at most
    bool countsObjects = true; ///< Number of Series Related Instances
    bool knowsLimits = true, knowsOffsets = true;
    bool sendsSeries = true, sendsInstances = true, listsInstances = true, listsSeries = true;
    bool knowsAsterisk = true, takesIncludefield = true;
    int answersOnAConnection = 0; ///< 0: any number
    int busyEvery = 0;
    bool saysThereIsMore = false; ///< in a warning, where a page is not the last
    bool saysPartial = false;     ///< by status 206, there and of all that is retrieved
    bool hasInvalidUid = false;   ///< in the list, of the first object
    bool differsInMeta = false;   ///< the UID of the meta header
    Redirect redirect = Redirect::none;
    std::string authorization{}; ///< the only one that it accepts; empty: any
    Wrapping wrapping{};
    /// The answer about an object that it has been sent.
    std::function<HttpAnswer(const std::string &uid)> storeAnswer{};
    /// Changes each answer at the end.
    std::function<void(const HttpRequest &, HttpAnswer &)> change{};
};

/// A DICOMweb server with one series.
class OddWebServer {
public:
    static inline const std::string study = "1.2.5", series = "1.2.5.1", name = "M\xc3\xbcller^Eva";
    static std::string instance(int n) { return series + "." + std::to_string(n + 1); }

    explicit OddWebServer(Quirks quirks)
        : m_quirks(std::move(quirks)),
          m_http([this](const HttpRequest &request) { return answer(request); }) {}
    archive::Server server() const {
        archive::Server server = serverAt(0, "");
        server.peer = archive::webPeer(m_http.url() + service);
        server.name = "odd";
        server.connections = 2;
        return server;
    }
    std::set<std::string> stored; ///< by STOW

    static std::string object(int n, bool differsInMeta = false,
                              const std::string &ofStudy = study) {
        DicomWriter w = sliceOf({}, n);
        w.put({0x0008, 0x0005}, "CS", "ISO_IR 192");
        w.put({0x0010, 0x0010}, "PN", name);
        w.put({0x0020, 0x000d}, "UI", ofStudy);
        w.put({0x0020, 0x000e}, "UI", series);
        w.put({0x0008, 0x0018}, "UI", instance(n));
        std::string file = w.file(DicomWriter::Form());
        if (differsInMeta) { // of the same length
            std::string other = instance(n);
            other[0] = '2';
            file.replace(file.find(instance(n)), other.size(), other);
        }
        return file;
    }
    static std::string element(const std::string &tag, const std::string &vr,
                               const std::string &value) {
        return "\"" + tag + "\": {\"vr\": \"" + vr + "\", \"Value\": [" + value + "]}";
    }
    static std::string uidElement(const std::string &tag, const std::string &uid) {
        return element(tag, "UI", "\"" + uid + "\"");
    }
    /// The list of one object that was stored (00081199) or not (00081198), with a reason perhaps.
    static std::string storeList(const std::string &tag, const std::string &uid,
                                 const std::string &reason = "") {
        return "{" +
               element(tag, "SQ",
                       "{" + uidElement("00081155", uid) + (reason.empty() ? "" : ", ") + reason +
                           "}") +
               "}";
    }

private:
    static inline const std::string service = "/dicom-web", moved = "/moved";

    HttpAnswer answer(HttpRequest request) {
        ++m_count;
        HttpAnswer answer;
        if (m_quirks.redirect != Redirect::none && !request.target.starts_with(moved)) {
            answer = {302, "text/html", "moved", placeOf(request)};
        } else if (!m_quirks.authorization.empty() &&
                   request.header("authorization") != m_quirks.authorization) {
            answer = {401, "text/plain", "no", ""};
            answer.header = "WWW-Authenticate: Basic realm=\"x\"";
        } else if (m_quirks.busyEvery > 0 && m_count % m_quirks.busyEvery == 0) {
            answer = {503, "text/plain", "busy", ""};
            answer.header = "Retry-After: 0";
        } else {
            for (const std::string &start : {moved, service})
                if (request.target.starts_with(start))
                    request.target.erase(0, start.size());
            answer = answerTo(request);
        }
        answer.isLast =
            m_quirks.answersOnAConnection > 0 && m_count % m_quirks.answersOnAConnection == 0;
        if (m_quirks.change)
            m_quirks.change(request, answer);
        return answer;
    }
    std::string placeOf(const HttpRequest &request) const {
        const std::string path = request.path(), there = moved + request.target;
        std::string up; // from the folder of the path to the root
        for (std::ptrdiff_t n = std::count(path.begin(), path.end(), '/'); n > 1; --n)
            up += "../";
        switch (m_quirks.redirect) {
        case Redirect::absolute:
            return m_http.url() + there;
        case Redirect::absolutePath:
            return there;
        case Redirect::relative:
            return up + there.substr(1);
        case Redirect::otherServer:
            return "http://127.0.0.1:1" + there;
        case Redirect::loop:
        case Redirect::none:
            break;
        }
        return request.target;
    }
    HttpAnswer answerTo(const HttpRequest &request) {
        const std::string path = request.path(), all = "/studies/" + study,
                          ofSeries = all + "/series/" + series;
        if (request.method == "POST")
            return store(request.body);
        Fields terms = fieldsOf(request.target.substr(request.target.find('?') + 1));
        if (!m_quirks.takesIncludefield && terms.contains("includefield"))
            return {400, "text/plain", "unknown attribute", ""};
        if (request.header("accept").find("multipart") != std::string::npos)
            return retrieve(request, path == all ? ofSeries : path, ofSeries);
        std::vector<std::string> list;
        if (path == "/studies")
            list = studies(terms.contains("0020000D") ? 1 : m_quirks.studies);
        else if (path == all + "/series" && m_quirks.listsSeries)
            list = {"{" + uidElement("0020000E", series) +
                    (m_quirks.countsObjects
                         ? ", " + element("00201209", "IS", std::to_string(m_quirks.objects))
                         : "") +
                    "}"};
        else if (path == ofSeries + "/instances" && m_quirks.listsInstances)
            for (int n = 0; n < m_quirks.objects; ++n)
                list.push_back("{" +
                               uidElement("00080018", n == 0 && m_quirks.hasInvalidUid
                                                          ? instance(n) + "_A"
                                                          : instance(n)) +
                               "}");
        else
            return {404, "text/plain", "", ""};
        return page(list, terms);
    }
    static std::vector<std::string> studies(int count) {
        std::vector<std::string> list;
        for (int n = 0; n < count; ++n)
            list.push_back("{" +
                           uidElement("0020000D", n == 0 ? study : "1.2.6." + std::to_string(n)) +
                           ", " + element("00100010", "PN", "{\"Alphabetic\": \"" + name + "\"}") +
                           ", " + element("00100020", "LO", "\"knobs\"") + "}");
        return list;
    }
    HttpAnswer page(std::vector<std::string> list, Fields &terms) const {
        const std::size_t whole = list.size();
        const auto limitTo = [&](std::size_t count) { list.resize(std::min(list.size(), count)); };
        if (m_quirks.cap > 0)
            limitTo(std::size_t(m_quirks.cap));
        const auto number = [&](const char *term, std::size_t otherwise) {
            return terms.contains(term) ? std::stoul(terms[term]) : otherwise;
        };
        const std::size_t offset = m_quirks.knowsOffsets ? number("offset", 0) : 0;
        if (offset >= list.size())
            return {204, "application/dicom+json", "", ""};
        if (m_quirks.knowsLimits)
            limitTo(offset + number("limit", whole));
        if (m_quirks.pageCap > 0)
            limitTo(offset + std::size_t(m_quirks.pageCap));
        std::string text;
        for (std::size_t n = offset; n < list.size(); ++n)
            text += (text.empty() ? "[" : ", ") + list[n];
        HttpAnswer answer{200, "application/dicom+json", text + "]", ""};
        if (m_quirks.saysThereIsMore && list.size() < whole)
            answer.header = "Warning: 299 odd: there is more";
        if (m_quirks.saysPartial && list.size() < whole)
            answer.status = 206;
        return answer;
    }
    HttpAnswer retrieve(const HttpRequest &request, const std::string &path,
                        const std::string &ofSeries) const {
        if (!m_quirks.knowsAsterisk && request.header("accept").find('*') != std::string::npos)
            return {406, "text/plain", "", ""};
        std::vector<std::string> objects;
        for (int n = 0; n < m_quirks.objects; ++n)
            if ((path == ofSeries && m_quirks.sendsSeries) ||
                (path == ofSeries + "/instances/" + instance(n) && m_quirks.sendsInstances)) {
                objects.push_back(object(n, m_quirks.differsInMeta));
                if (m_quirks.wrapping.body)
                    objects.back() = m_quirks.wrapping.body(n, objects.back());
            }
        if (objects.empty())
            return {404, "text/plain", "", ""};
        HttpAnswer answer = wrapped(objects);
        if (m_quirks.saysPartial)
            answer.status = 206;
        return answer;
    }
    HttpAnswer wrapped(std::vector<std::string> objects) const {
        const Wrapping &w = m_quirks.wrapping;
        if (w.isLeftOutOfOne && objects.size() == 1)
            return {200, "application/dicom", objects.front(), ""};
        objects.insert(objects.end(), w.extra.begin(), w.extra.end());
        const std::string delimiter = "--" + w.boundary,
                          head = w.head + (w.head.empty() ? "" : w.lineEnd);
        std::string body = w.preamble;
        for (const std::string &object : objects) {
            body += delimiter + w.lineEnd + head;
            if (w.hasWrongLengths)
                body += "Content-Length: " + std::to_string(object.size() - 10) + w.lineEnd;
            body += w.lineEnd + object + w.lineEnd;
            if (w.hasEmptyParts) // the end of its headers belongs to the next delimiter
                body += delimiter + w.lineEnd + head + w.lineEnd;
        }
        const std::string type = "multipart/related; type=\"application/dicom\"; boundary=" +
                                 (w.isQuoted ? "\"" + w.boundary + "\"" : w.boundary);
        return {200, w.type.empty() ? type : w.type, body + delimiter + w.end + w.lineEnd, ""};
    }
    HttpAnswer store(const std::string &body) {
        for (int n = 0; n < m_quirks.objects; ++n)
            // As the data set says.
            if (const std::string end = instance(n) + (instance(n).size() % 2 ? '\0' : '\x08');
                body.find(end) != std::string::npos) {
                stored.insert(instance(n));
                if (m_quirks.storeAnswer)
                    return m_quirks.storeAnswer(instance(n));
                return {200, "application/dicom+json", storeList("00081199", instance(n)), ""};
            }
        return {409, "text/plain", "", ""};
    }

    const Quirks m_quirks;
    int m_count = 0;
    HttpServer m_http; // last: its threads use the others
};

/// A change of each answer: another name of the patient, of the same length, which the archive can
/// correct between two requests. `name` outlives the server.
inline std::function<void(const HttpRequest &, HttpAnswer &)>
namesPatient(const std::string &name) {
    return [&name](const HttpRequest &, HttpAnswer &answer) {
        const std::string former = OddWebServer::name;
        for (std::size_t at = 0; (at = answer.body.find(former, at)) != std::string::npos;
             at += name.size())
            answer.body.replace(at, former.size(), name);
    };
}

} // namespace pellucid::test
