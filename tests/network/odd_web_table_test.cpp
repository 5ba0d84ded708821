// SPDX-License-Identifier: GPL-3.0-or-later
// Each habit of a DICOMweb server that has been met or that the standard allows, and what comes of
// it: what can come comes, a part is called a part, a reason says what is wrong, nothing hangs.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include "core/task/progress.h"
#include "tests/network/http_server.h"
#include "tests/network/odd_table.h"
#include "tests/network/odd_web_server.h"
#include "tests/network/pacs.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/files.h"

namespace pellucid {

namespace {

using namespace test;

constexpr int objectCount = 8, studyCount = 19;

enum class Task { search, retrieve, store };

// An asterisk in the outcome is any text.
struct Row {
    Task task;
    const char *quirk;
    Quirks quirks;
    const char *outcome;
    std::function<void(archive::Server &)> entered{}; ///< by the user, about the server
};

using Change = std::function<void(const HttpRequest &, HttpAnswer &)>;

// Of every answer with a body.
Change ofBodies(std::function<void(HttpAnswer &)> change) {
    return [change = std::move(change)](const HttpRequest &, HttpAnswer &answer) {
        if (!answer.body.empty())
            change(answer);
    };
}

bool isList(const HttpRequest &request) {
    return request.method == "GET" &&
           request.header("accept").find("multipart") == std::string::npos;
}

// Of the lists, as text.
Change ofLists(std::function<void(std::string &)> change) {
    return [change = std::move(change)](const HttpRequest &request, HttpAnswer &answer) {
        if (isList(request) && answer.status == 200)
            change(answer.body);
    };
}

Change always(const HttpAnswer &answer) {
    return [answer](const HttpRequest &, HttpAnswer &changed) { changed = answer; };
}

// In place of what is retrieved.
Change retrieves(const HttpAnswer &answer) {
    return [answer](const HttpRequest &request, HttpAnswer &changed) {
        if (request.method == "GET" && !isList(request))
            changed = answer;
    };
}

// Breaks the connection in the first answer that is longer than this.
Change cutOnce(std::size_t bytes) {
    return [bytes, isCut = std::make_shared<bool>(false)](const HttpRequest &, HttpAnswer &answer) {
        if (!*isCut && answer.body.size() > bytes) {
            *isCut = true;
            answer.cutAt = bytes;
        }
    };
}

std::string replaced(const std::string &text, const char *pattern, const char *by) {
    return std::regex_replace(text, std::regex(pattern), by);
}

// In the format of gzip (RFC 1952), in blocks that are stored as they are (RFC 1951, 3.2.4).
std::string gzipped(const std::string &bytes) {
    constexpr std::size_t longest = 65535;
    std::string out("\x1f\x8b\x08\0\0\0\0\0\0\xff", 10);
    for (std::size_t at = 0; at < bytes.size(); at += longest) {
        const std::string block = bytes.substr(at, longest);
        const auto size = std::uint16_t(block.size());
        out += at + longest >= bytes.size() ? '\1' : '\0';
        out += DicomWriter::number(size) + DicomWriter::number(std::uint16_t(~size)) + block;
    }
    std::uint32_t sum = 0xffffffff;
    for (const char c : bytes) {
        sum ^= std::uint8_t(c);
        for (int bit = 0; bit < 8; ++bit)
            sum = (sum >> 1) ^ (sum & 1 ? 0xedb88320 : 0);
    }
    return out + DicomWriter::number(~sum) + DicomWriter::number(std::uint32_t(bytes.size()));
}

// The habits of HTTP, which concern everything that is asked.
const Change closes = [](const HttpRequest &, HttpAnswer &answer) {
    answer.isLast = true;
    answer.header += std::string(answer.header.empty() ? "" : "\r\n") + "Connection: close";
};
const Change isOld = [](const HttpRequest &, HttpAnswer &answer) {
    answer.version = "HTTP/1.0";
    answer.isLast = true;
};
const Change hasNoLength = [](const HttpRequest &, HttpAnswer &answer) {
    if (answer.status != 204) {
        answer.framing = Framing::byTheEnd;
        answer.header = "Connection: close";
    }
};
const Change isInChunks = ofBodies([](HttpAnswer &answer) { answer.framing = Framing::inChunks; });
const Change drips = ofBodies([](HttpAnswer &answer) { answer.pieceBytes = 200; });
const Change isGzipped = ofBodies([](HttpAnswer &answer) {
    answer.body = gzipped(answer.body);
    answer.header = "Content-Encoding: gzip";
});

// A page for people, of success.
const HttpAnswer loginPage{200, "text/html", "<html><body>please log in</body></html>", ""};

// What STOW may say of an object.
using StoreAnswer = std::function<HttpAnswer(const std::string &uid)>;

StoreAnswer says(int status, const char *type, const char *body) {
    return [=](const std::string &) { return HttpAnswer{status, type, body, ""}; };
}
StoreAnswer lists(int status, const char *tag, const char *reason) {
    return [=](const std::string &uid) {
        return HttpAnswer{status, "application/dicom+json",
                          OddWebServer::storeList(tag, uid, reason), ""};
    };
}
constexpr const char *isStored = "00081199", *hasFailed = "00081198";
constexpr const char *outOfResources = R"("00081197": {"vr": "US", "Value": [42752]})";
constexpr const char *coerced = R"("00081196": {"vr": "US", "Value": [45056]})";

// eva:secret
constexpr const char *basicLogin = "Basic ZXZhOnNlY3JldA==";
void hasToken(archive::Server &server) {
    server.peer.authentication = network::Authentication::bearer;
    server.peer.secret = "abc";
}

std::vector<Row> searching() {
    constexpr Task task = Task::search;
    return {
        {task, "none", {}, "19 studies"},
        {task, "close", {.change = closes}, "19 studies"},
        {task, "close, in pages", {.pageCap = 5, .change = closes}, "19 studies"},
        {task, "http10", {.pageCap = 5, .change = isOld}, "19 studies"},
        {task, "chunked", {.change = isInChunks}, "19 studies"},
        {task, "nolength", {.pageCap = 5, .change = hasNoLength}, "19 studies"},
        {task, "gzip", {.change = isGzipped}, "19 studies"},
        {task, "keepalive=2", {.pageCap = 5, .answersOnAConnection = 2}, "19 studies"},
        {task, "redirect=abs", {.redirect = Redirect::absolute}, "19 studies"},
        {task, "redirect=rel", {.redirect = Redirect::absolutePath}, "19 studies"},
        {task, "redirect=slash", {.redirect = Redirect::relative}, "19 studies"},
        {task,
         "redirect=other",
         {.redirect = Redirect::otherServer},
         "*redirects to another server*"},
        {task, "redirect=loop", {.redirect = Redirect::loop}, "*redirect*"},
        {task, "busy=2", {.pageCap = 5, .busyEvery = 2}, "19 studies"},
        {task, "busy=1", {.busyEvery = 1}, "the server is busy*"},
        {task, "status=500", {.change = always({500, "text/plain", "sorry", ""})}, "*500*"},
        {task, "status=404", {.change = always({404, "text/plain", "", ""})}, "*check the path*"},
        {task, "html", {.change = always(loginPage)}, "*not DICOM JSON*"},
        {task, "drip", {.change = drips}, "19 studies"},
        {task, "cut=900", {.change = cutOnce(900)}, "*closed the connection*"},
        {task, "nolimit", {.studies = 250, .knowsLimits = false}, "250 studies"},
        {task, "nooffset", {.knowsOffsets = false}, "19 studies, may be incomplete"},
        {task,
         "nooffset, more than a page",
         {.studies = 250, .knowsOffsets = false},
         "200 studies, may be incomplete"},
        {task,
         "nooffset, close",
         {.knowsOffsets = false, .answersOnAConnection = 1},
         "19 studies, may be incomplete"},
        {task, "cap=5", {.pageCap = 5}, "19 studies"},
        {task,
         "empty200",
         {.change = [](const HttpRequest &, HttpAnswer &answer) { answer.status = 200; }},
         "19 studies"},
        {task,
         "empty200, nothing to find",
         {.studies = 0,
          .change = [](const HttpRequest &, HttpAnswer &answer) { answer.status = 200; }},
         "0 studies"},
        {task,
         "nulls",
         {.change = ofLists([](std::string &list) {
              list = replaced(list, R"(\{"Alphabetic[^}]*\})", "null");
              list = replaced(list, R"(\}, \{"0020)",
                              R"(, "00081030": {"vr": "LO", "Value": null}, "00080030": null,)"
                              R"( "00080020": {"vr": "DA"}}, {"0020)");
          })},
         "19 studies"},
        {task,
         "bom",
         {.change = ofLists([](std::string &list) { list.insert(0, "\xef\xbb\xbf"); })},
         "19 studies"},
        {task,
         "xml",
         {.change = ofBodies([](HttpAnswer &answer) {
              answer.type = "multipart/related; type=\"application/dicom+xml\"; boundary=x";
              answer.body = "--x\r\nContent-Type: application/dicom+xml\r\n\r\n"
                            "<NativeDicomModel/>\r\n--x--";
          })},
         "*not DICOM JSON*"},
        {task,
         "object",
         {.change = ofLists([](std::string &list) { list = "{\"studies\": " + list + "}"; })},
         "*not DICOM JSON*"},
        {task,
         "uidpad",
         {.change = ofLists([](std::string &list) {
              list = replaced(list, R"("UI", "Value": \["[0-9.]+)", "$& ");
          })},
         "19 studies"},
        {task, "strictinclude", {.takesIncludefield = false}, "19 studies"},
        // When all pages have come, no warning is left.
        {task, "warning", {.pageCap = 5, .saysThereIsMore = true}, "19 studies"},
        {task,
         "warning, nooffset",
         {.pageCap = 5, .knowsOffsets = false, .saysThereIsMore = true},
         "5 studies, may be incomplete, *there is more"},
        {task, "total206", {.pageCap = 5, .saysPartial = true}, "19 studies"},
        {task,
         "total206, nooffset",
         {.pageCap = 5, .knowsOffsets = false, .saysPartial = true},
         "5 studies, may be incomplete"},
        {task,
         "latin1",
         {.change = ofLists([](std::string &list) { list = replaced(list, "\xc3\xbc", "\xfc"); })},
         "19 studies"},
        {task,
         "numbers",
         {.change = ofLists([](std::string &list) {
              list = replaced(list, R"(\}, \{"0020)",
                              R"(, "00201208": {"vr": "IS", "Value": ["8"]}}, {"0020)");
          })},
         "19 studies"},
        {task, "token", {.authorization = "Bearer abc"}, "19 studies", hasToken},
        {task, "token, another", {.authorization = "Bearer x"}, "*not accept*", hasToken},
        {task, "user", {.authorization = basicLogin}, "19 studies", hasPassword},
        {task, "user, no login", {.authorization = basicLogin}, "*not accept*"},
    };
}

Quirks wrapped(const Wrapping &wrapping) {
    return {.wrapping = wrapping};
}

// As a whole series, without a word of how many objects it has.
Quirks unlisted(const Wrapping &wrapping) {
    return {.countsObjects = false, .listsInstances = false, .wrapping = wrapping};
}

std::vector<Row> retrievingOverHttp() {
    constexpr Task task = Task::retrieve;
    return {
        {task, "none", {}, "8 of 8"},
        {task, "close", {.change = closes}, "8 of 8"},
        {task, "http10", {.change = isOld}, "8 of 8"},
        {task, "chunked", {.change = isInChunks}, "8 of 8"},
        {task, "nolength", {.change = hasNoLength}, "8 of 8"},
        {task, "gzip", {.change = isGzipped}, "8 of 8"},
        {task, "keepalive=3", {.answersOnAConnection = 3}, "8 of 8"},
        {task, "redirect=abs", {.redirect = Redirect::absolute}, "8 of 8"},
        {task, "redirect=rel", {.redirect = Redirect::absolutePath}, "8 of 8"},
        {task, "redirect=slash", {.redirect = Redirect::relative}, "8 of 8"},
        {task,
         "redirect=other",
         {.redirect = Redirect::otherServer},
         "*redirects to another server*"},
        {task, "redirect=loop", {.redirect = Redirect::loop}, "*redirect*"},
        {task, "busy=4", {.busyEvery = 4}, "8 of 8"},
        {task, "status=500", {.change = always({500, "text/plain", "sorry", ""})}, "*500*"},
        {task,
         "status=500, of objects",
         {.change = retrieves({500, "text/plain", "sorry", ""})},
         "0 of 8 incomplete: *500*"},
        {task, "html", {.change = always(loginPage)}, "*not DICOM JSON*"},
        {task, "html, of objects", {.change = retrieves(loginPage)}, "0 of 8 incomplete: *DICOM*"},
        {task, "drip", {.change = drips}, "8 of 8"},
        {task, "cut=700", {.change = cutOnce(700)}, "8 of 8"},
        {task,
         "cut=3000, of a series",
         {.listsInstances = false, .change = cutOnce(3000)},
         "8 of 8"},
        {task, "nooffset", {.knowsOffsets = false}, "8 of 8"},
        {task, "nooffset, close", {.knowsOffsets = false, .answersOnAConnection = 1}, "8 of 8"},
        {task, "cap=5", {.pageCap = 5}, "8 of 8"},
        {task,
         "empty200",
         {.change =
              [](const HttpRequest &request, HttpAnswer &answer) {
                  answer.status = isList(request) ? 200 : answer.status;
              }},
         "8 of 8"},
        {task,
         "uidpad",
         {.change = ofLists([](std::string &list) {
              list = replaced(list, R"("UI", "Value": \["[0-9.]+)", "$& ");
          })},
         "8 of 8"},
        {task, "noinstances", {.listsInstances = false}, "8 of 8"},
        {task,
         "noinstances, status=501",
         {.change =
              [](const HttpRequest &r, HttpAnswer &answer) {
                  if (isList(r) && r.path().ends_with("/instances"))
                      answer = {501, "text/plain", "not implemented", ""};
              }},
         "8 of 8"},
        {task, "strictinclude", {.takesIncludefield = false}, "8 of 8"},
        {task,
         "latin1",
         {.change = ofLists([](std::string &list) { list = replaced(list, "\xc3\xbc", "\xfc"); })},
         "8 of 8"},
        {task,
         "numbers",
         {.change = ofLists([](std::string &list) {
              list = replaced(list, R"(("00201209": .*\[)([0-9]+))", "$1\"$2\"");
          })},
         "8 of 8"},
        {task, "total206", {.saysPartial = true}, "8 of 8"},
        // Nobody has said how many objects there are; the server says that these are not all.
        {task,
         "total206, of a series without a list",
         {.countsObjects = false, .listsInstances = false, .saysPartial = true},
         "8 of * incomplete: *"},
        {task, "token", {.authorization = "Bearer abc"}, "8 of 8", hasToken},
        {task, "user", {.authorization = basicLogin}, "8 of 8", hasPassword},
    };
}

std::vector<Row> retrieving() {
    constexpr Task task = Task::retrieve;
    const auto bulk = [](int, const std::string &) { return std::string(160, '\0'); };
    const auto page = [](int n, const std::string &object) {
        return n == 3 ? loginPage.body : object;
    };
    const std::string another = OddWebServer::object(3, false, "1.2.7"),
                      again = OddWebServer::object(0);
    return {
        {task, "boundary", wrapped({.boundary = "'()+_,-./:=?0aZ"}), "8 of 8"},
        {task, "boundary, quoted", wrapped({.boundary = "a b;c=d", .isQuoted = true}), "8 of 8"},
        {task, "boundary of 70", wrapped({.boundary = std::string(70, '-')}), "8 of 8"},
        {task, "quoted", wrapped({.isQuoted = true}), "8 of 8"},
        {task,
         "upper",
         {.wrapping = {.type = "Multipart/Related; Type=\"application/dicom\"; Boundary=part",
                       .head = "CONTENT-type: Application/DICOM"},
          .change = ofBodies([](HttpAnswer &answer) {
              answer.header = "CONTENT-TYPE: " + answer.type;
              answer.type.clear();
          })},
         "8 of 8"},
        {task, "lf", wrapped({.lineEnd = "\n"}), "8 of 8"},
        {task, "lf, of a series", unlisted({.lineEnd = "\n"}), "8 of 8"},
        {task, "preamble", wrapped({.preamble = "This is a multi-part message.\r\n"}), "8 of 8"},
        {task, "noheaders", wrapped({.head = ""}), "8 of 8"},
        {task, "noheaders, of a series", unlisted({.head = ""}), "8 of 8"},
        {task, "noend", wrapped({.end = ""}), "8 of 8"},
        // More may have been to come.
        {task, "noend, of a series without a list", unlisted({.end = ""}), "8 of * incomplete: *"},
        {task, "single", wrapped({.isLeftOutOfOne = true}), "8 of 8"},
        {task, "nostar", {.knowsAsterisk = false}, "8 of 8"},
        {task, "noinstance", {.sendsInstances = false}, "8 of 8"},
        {task, "lengthpart", wrapped({.hasWrongLengths = true}), "8 of 8"},
        {task, "bulk", wrapped({.head = "Content-Type: application/octet-stream", .body = bulk}),
         "0 of 8 incomplete: *DICOM*"},
        {task, "extra", wrapped({.extra = {again, another}}), "8 of 8"},
        {task, "extra, of a series", unlisted({.extra = {again, another}}), "8 of 8"},
        {task, "empty", wrapped({.hasEmptyParts = true}), "8 of 8"},
        {task, "empty, of a series", unlisted({.hasEmptyParts = true}), "8 of 8"},
        {task, "a page among the parts", wrapped({.body = page}), "7 of 8 incomplete: *DICOM*"},
        {task, "a page among the parts of a series without a list", unlisted({.body = page}),
         "7 of * incomplete: *"},
        {task, "type=application/dicom", wrapped({.type = "application/dicom"}), "8 of 8"},
        {task, "type=text/html", wrapped({.type = "text/html"}), "8 of 8"},
        {task, "type without a boundary", wrapped({.type = "multipart/related"}), "8 of 8"},
        {task, "type with another boundary in quotes",
         wrapped({.type = "multipart/related; type=\"a; boundary=b\"; boundary=part"}), "8 of 8"},
    };
}

std::vector<Row> storing() {
    constexpr Task task = Task::store;
    return {
        {task, "none", {}, "8 sent"},
        {task, "close", {.change = closes}, "8 sent"},
        {task, "http10", {.change = isOld}, "8 sent"},
        {task, "chunked", {.change = isInChunks}, "8 sent"},
        {task, "nolength", {.change = hasNoLength}, "8 sent"},
        {task, "gzip", {.change = isGzipped}, "8 sent"},
        {task, "keepalive=3", {.answersOnAConnection = 3}, "8 sent"},
        {task, "redirect=abs", {.redirect = Redirect::absolute}, "8 sent"},
        {task, "redirect=slash", {.redirect = Redirect::relative}, "8 sent"},
        {task, "redirect=other", {.redirect = Redirect::otherServer}, "0 sent: *another server*"},
        {task, "redirect=loop", {.redirect = Redirect::loop}, "0 sent: *redirect*"},
        {task, "busy=4", {.busyEvery = 4}, "8 sent"},
        {task, "html", {.change = always(loginPage)}, "0 sent: *does not confirm*"},
        {task, "drip", {.change = drips}, "8 sent"},
        {task, "cut=20", {.change = cutOnce(20)}, "8 sent"},
        {task, "only=GET", {.change = always({405, "text/plain", "", ""})}, "0 sent: *405*"},
        {task, "stow=ok", {.storeAnswer = lists(200, isStored, "")}, "8 sent"},
        {task,
         "stow=empty",
         {.storeAnswer = says(200, "application/dicom+json", "")},
         "0 sent: *does not confirm*"},
        {task,
         "stow=202",
         {.storeAnswer = lists(202, hasFailed, outOfResources)},
         "0 sent: *out of resources*A700*"},
        {task,
         "stow=409",
         {.storeAnswer = lists(409, hasFailed, outOfResources)},
         "0 sent: *out of resources*A700*"},
        // Its UIDs are not there.
        {task,
         "stow=xml",
         {.storeAnswer = says(200, "application/dicom+xml",
                              "<NativeDicomModel><DicomAttribute tag=\"00081199\"/>"
                              "</NativeDicomModel>")},
         "0 sent: *does not confirm*"},
        {task, "stow=warn", {.storeAnswer = lists(202, isStored, coerced)}, "8 sent, 8 changed: *"},
        {task,
         "stow=nolist",
         {.storeAnswer = says(200, "application/dicom+json", "{}")},
         "0 sent: *does not confirm*"},
        {task,
         "stow=413",
         {.storeAnswer = says(413, "text/html", "<html>too large {x}</html>")},
         "0 sent: *this size*"},
        {task,
         "stow=500",
         {.storeAnswer = says(500, "text/html", "<html><style>body{color:red}</style>oops</html>")},
         "0 sent: *500*"},
        {task, "token", {.authorization = "Bearer abc"}, "8 sent", hasToken},
        {task, "token, another", {.authorization = "Bearer x"}, "0 sent: *not accept*", hasToken},
        {task, "user", {.authorization = basicLogin}, "8 sent", hasPassword},
    };
}

class PacsOddTable : public PacsScripted {
protected:
    void SetUp() override {
        for (int n = 0; n < objectCount; ++n) {
            m_files.push_back(m_folder / (std::to_string(n) + ".dcm"));
            writeText(m_files.back(), OddWebServer::object(n));
        }
    }

    std::string outcomeOf(const Row &row, const std::string &folder) const {
        Quirks quirks = row.quirks;
        quirks.objects = objectCount;
        if (row.task == Task::search && quirks.studies == 1)
            quirks.studies = studyCount;
        const OddWebServer web(quirks);
        archive::Server server = web.server();
        server.limit = 0;
        if (row.entered)
            row.entered(server);
        // A row takes about a second.
        return outcomeWithin(std::chrono::seconds(15), [&](const task::Progress &progress) {
            return row.task == Task::search ? searched(server, progress)
                   : row.task == Task::retrieve
                       ? retrieved(server, OddWebServer::study, m_folder / folder, progress)
                       : sent(server, m_files, progress);
        });
    }

    std::vector<fs::path> m_files;
};

} // namespace

TEST_F(PacsOddTable, EachQuirkHasItsOutcome) {
    std::vector<Row> rows;
    for (const auto &group : {searching(), retrievingOverHttp(), retrieving(), storing()})
        rows.insert(rows.end(), group.begin(), group.end());
    const auto outcomes = expectOutcomes(rows, [this](const Row &row, std::size_t number) {
        return outcomeOf(row, "got" + std::to_string(number));
    });
    for (const std::string &outcome : outcomes) // a success is no reason
        EXPECT_EQ(outcome.find("HTTP status 2"), std::string::npos) << outcome;
}

} // namespace pellucid
