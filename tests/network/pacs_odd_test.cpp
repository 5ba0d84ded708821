// SPDX-License-Identifier: GPL-3.0-or-later
// Web servers that limit their lists, close connections, are busy or know only a part of the
// standard: a part of a study is never taken for all of it, and what can come comes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "core/archive/retrieval.h"
#include "core/archive/search.h"
#include "core/archive/sending.h"
#include "core/task/error.h"
#include "tests/network/http_server.h"
#include "tests/network/pacs.h"
#include "tests/network/scripted_server.h"
#include "tests/network/servers.h"
#include "tests/support/dicom_writer.h"

namespace pellucid {

namespace {

namespace because = task::because;
using namespace test;

constexpr int objectCount = 64;
const std::string study = "1.2.5", seriesUid = "1.2.5.1";

std::string instance(int n) {
    return seriesUid + "." + std::to_string(n + 1);
}

// What a server does differently.
struct Quirks {
    int cap = 0;               ///< objects that it lists at most
    bool countsObjects = true; ///< Number of Series Related Instances
    bool knowsOffsets = true;
    bool sendsSeries = true, sendsInstances = true, listsInstances = true, listsSeries = true;
    bool knowsAsterisk = true, takesIncludefield = true;
    int answersOnAConnection = 0; ///< 0: any number
    int busyEvery = 0;
    bool saysThereIsMore = false; ///< in a warning
    bool hasInvalidUid = false;   ///< in the list, of the first object
    bool differsInMeta = false;   ///< the UID of the meta header
};

// A DICOMweb server with one series.
class OddWebServer {
public:
    explicit OddWebServer(Quirks quirks)
        : m_quirks(quirks), m_http([this](const HttpRequest &request) { return answer(request); }) {
    }
    archive::Server server() const {
        archive::Server server = serverAt(0, "");
        server.peer = archive::webPeer(m_http.url());
        server.name = "odd";
        server.connections = 2;
        return server;
    }
    std::set<std::string> stored; ///< by STOW

    static std::string object(int n, bool differsInMeta) {
        SeriesKnobs knobs;
        knobs.slices = objectCount;
        DicomWriter w = sliceOf(knobs, n);
        w.put({0x0020, 0x000d}, "UI", study);
        w.put({0x0020, 0x000e}, "UI", seriesUid);
        w.put({0x0008, 0x0018}, "UI", instance(n));
        std::string file = w.file(DicomWriter::Form());
        if (differsInMeta) { // of the same length
            std::string other = instance(n);
            other[0] = '2';
            file.replace(file.find(instance(n)), other.size(), other);
        }
        return file;
    }

private:
    static std::string element(const char *tag, const char *vr, const std::string &value) {
        return "\"" + std::string(tag) + "\": {\"vr\": \"" + vr + "\", \"Value\": [" + value + "]}";
    }
    static std::string uidElement(const char *tag, const std::string &uid) {
        return element(tag, "UI", "\"" + uid + "\"");
    }
    HttpAnswer answer(const HttpRequest &request) {
        HttpAnswer answer = answerTo(request);
        ++m_count;
        if (m_quirks.busyEvery > 0 && m_count % m_quirks.busyEvery == 0)
            answer = {503, "text/plain", "busy", ""}, answer.header = "Retry-After: 0";
        answer.isLast =
            m_quirks.answersOnAConnection > 0 && m_count % m_quirks.answersOnAConnection == 0;
        return answer;
    }
    HttpAnswer answerTo(const HttpRequest &request) {
        const std::string path = request.path(), all = "/studies/" + study,
                          series = all + "/series/" + seriesUid;
        if (request.method == "POST")
            return store(request.body);
        Fields terms = fieldsOf(request.target.substr(request.target.find('?') + 1));
        if (!m_quirks.takesIncludefield && terms.contains("includefield"))
            return {400, "text/plain", "unknown attribute", ""};
        if (request.header("accept").find("multipart") != std::string::npos)
            return retrieve(request, path == all ? series : path, series);
        std::vector<std::string> list;
        if (path == "/studies")
            list = {"{" + uidElement("0020000D", study) + "}"};
        else if (path == all + "/series" && m_quirks.listsSeries)
            list = {"{" + uidElement("0020000E", seriesUid) +
                    (m_quirks.countsObjects
                         ? ", " + element("00201209", "IS", std::to_string(objectCount))
                         : "") +
                    "}"};
        else if (path == series + "/instances" && m_quirks.listsInstances)
            for (int n = 0; n < objectCount; ++n)
                list.push_back("{" +
                               uidElement("00080018", n == 0 && m_quirks.hasInvalidUid
                                                          ? instance(n) + "_A"
                                                          : instance(n)) +
                               "}");
        else
            return {404, "text/plain", "", ""};
        const std::size_t offset = m_quirks.knowsOffsets ? std::stoul(terms["offset"]) : 0;
        if (m_quirks.cap > 0 && list.size() > std::size_t(m_quirks.cap))
            list.resize(std::size_t(m_quirks.cap));
        if (offset >= list.size())
            return {204, "application/dicom+json", "", ""};
        std::string text;
        for (std::size_t n = offset; n < list.size(); ++n)
            text += (text.empty() ? "[" : ", ") + list[n];
        HttpAnswer answer{200, "application/dicom+json", text + "]", ""};
        if (m_quirks.saysThereIsMore && path == series + "/instances")
            answer.header = "Warning: 299 odd: there is more";
        return answer;
    }
    HttpAnswer retrieve(const HttpRequest &request, const std::string &path,
                        const std::string &series) const {
        if (!m_quirks.knowsAsterisk && request.header("accept").find('*') != std::string::npos)
            return {406, "text/plain", "", ""};
        std::string body;
        for (int n = 0; n < objectCount; ++n)
            if ((path == series && m_quirks.sendsSeries) ||
                (path == series + "/instances/" + instance(n) && m_quirks.sendsInstances))
                body += "--part\r\nContent-Type: application/dicom\r\n\r\n" +
                        object(n, m_quirks.differsInMeta) + "\r\n";
        if (body.empty())
            return {404, "text/plain", "", ""};
        return {200, "multipart/related; type=\"application/dicom\"; boundary=part",
                body + "--part--\r\n", ""};
    }
    HttpAnswer store(const std::string &body) {
        for (int n = 0; n < objectCount; ++n)
            // As the data set says.
            if (const std::string end = instance(n) + (instance(n).size() % 2 ? '\0' : '\x08');
                body.find(end) != std::string::npos) {
                stored.insert(instance(n));
                return {
                    200, "application/dicom+json",
                    "{" +
                        element("00081199", "SQ", "{" + uidElement("00081155", instance(n)) + "}") +
                        "}",
                    ""};
            }
        return {409, "text/plain", "", ""};
    }

    Quirks m_quirks;
    int m_count = 0;
    HttpServer m_http;
};

// Ends a search after three studies in its own way.
class LimitedServer {
public:
    LimitedServer(int studies, std::uint16_t status)
        : m_server([=](ScriptedAssociation &association, const ScriptedRequest &request) {
              if (request.field != command::findRequest)
                  return;
              for (int n = 0; n < studies; ++n) {
                  DicomWriter row;
                  row.put({0x0020, 0x000d}, "UI", "1.2.3." + std::to_string(n));
                  association.answer(request, 0xff00, row);
              }
              association.answer(request, status);
          }) {}
    archive::Server server() const { return serverAt(m_server.port(), "LIMITED"); }

private:
    ScriptedServer m_server;
};

class PacsOdd : public PacsScripted {
protected:
    archive::RetrievalReport retrieved(const Quirks &quirks, const std::string &to) {
        const OddWebServer web(quirks);
        return get(web.server(), study, to);
    }
};

} // namespace

// All objects come, one way or another.
TEST_F(PacsOdd, WhatCanComeComes) {
    struct Case {
        const char *name;
        Quirks quirks;
    };
    const std::vector<Case> cases{
        {"none", {}},
        {"lists 20 of 64", {.cap = 20}},
        {"lists 20, and says that there is more",
         {.cap = 20, .countsObjects = false, .saysThereIsMore = true}},
        {"no offsets", {.knowsOffsets = false}},
        {"no list of objects", {.listsInstances = false}},
        {"no list of series", {.listsSeries = false}},
        {"an invalid UID in the list", {.hasInvalidUid = true}},
        {"whole series only", {.sendsInstances = false}},
        {"no asterisk", {.knowsAsterisk = false}},
        {"no includefield", {.takesIncludefield = false}},
        {"closes after each answer", {.answersOnAConnection = 1}},
        {"closes after seven answers", {.answersOnAConnection = 7}},
        {"often busy", {.busyEvery = 5}},
        {"another UID in the meta header", {.differsInMeta = true}},
    };
    for (const Case &one : cases) {
        SCOPED_TRACE(one.name);
        const auto report = retrieved(one.quirks, one.name);
        EXPECT_TRUE(report.isComplete()) << report.lacking.front().reason.english();
        EXPECT_EQ(report.state.received, std::size_t(objectCount));
        EXPECT_EQ(report.state.wanted, std::size_t(objectCount));
        EXPECT_EQ(filesIn(m_folder / one.name).size(), std::size_t(objectCount));
        // Again, everything is there.
        const auto again = retrieved(one.quirks, one.name);
        EXPECT_TRUE(again.isComplete());
        EXPECT_EQ(again.state.received, 0U);
        EXPECT_EQ(again.state.present, std::size_t(objectCount));
    }
}

// A part is called a part.
TEST_F(PacsOdd, APartOfAStudyIsIncomplete) {
    try { // nothing is listed, and nothing comes
        retrieved({.sendsSeries = false, .listsSeries = false}, "nothing");
        ADD_FAILURE();
    } catch (const task::Error &error) {
        EXPECT_EQ(error.code(), task::ErrorCode::unusable);
    }
    const auto short20 = retrieved({.cap = 20, .sendsSeries = false}, "short");
    EXPECT_EQ(short20.state.received, 20U);
    EXPECT_EQ(short20.state.wanted, std::size_t(objectCount));
    ASSERT_EQ(short20.lacking.size(), std::size_t(objectCount - 20));
    const auto unsaid = retrieved(
        {.cap = 20, .countsObjects = false, .sendsSeries = false, .saysThereIsMore = true}, "more");
    EXPECT_EQ(unsaid.state.received, 20U);
    EXPECT_FALSE(unsaid.isComplete());
    const auto invalid = retrieved({.sendsSeries = false, .hasInvalidUid = true}, "invalid");
    EXPECT_EQ(invalid.state.received, std::size_t(objectCount - 1));
    ASSERT_EQ(invalid.lacking.size(), 1U);
    EXPECT_TRUE(invalid.lacking.front().reason.is(because::hasNoValidUids));
}

// De-identified objects, which differ from their meta headers, go out and come back.
TEST_F(PacsOdd, ObjectsThatDifferFromTheirMetaHeadersAreSent) {
    OddWebServer web({});
    std::vector<fs::path> files;
    for (int n = 0; n < 8; ++n) {
        files.push_back(m_folder / (std::to_string(n) + ".dcm"));
        writeText(files.back(), OddWebServer::object(n, true));
    }
    const auto report = archive::send(web.server(), files);
    EXPECT_TRUE(report.notSent.empty()) << report.notSent.front().reason.english();
    EXPECT_EQ(web.stored.size(), 8U);
}

TEST_F(PacsOdd, WhatASearchLeavesOutIsCounted) {
    HttpServer http([](const HttpRequest &request) -> HttpAnswer {
        if (request.target.find("offset=0") == std::string::npos)
            return {204, "application/dicom+json", "", ""};
        HttpAnswer answer{200, "application/dicom+json",
                          R"([{"0020000D": {"vr": "UI", "Value": ["1.2.3"]}},
                              {"0020000D": {"vr": "UI", "Value": ["1.2.3_A"]}},
                              {"00100020": {"vr": "LO", "Value": ["no UID"]}}])",
                          ""};
        answer.header = "Warning: 299 odd: there is more";
        return answer;
    });
    archive::Server server = serverAt(0, "");
    server.peer = archive::webPeer(http.url());
    const auto result = archive::search({server}, {.modality = "ct, mr"});
    ASSERT_EQ(result.outcomes.size(), 1U);
    EXPECT_EQ(result.entries.size(), 1U);
    EXPECT_EQ(result.outcomes.front().withoutUid, 4U); // of two searches
    EXPECT_TRUE(result.outcomes.front().mayBeIncomplete);
}

// A cancel that nobody asked for, a warning that the standard does not know, and a lack of
// resources: what came before it is a part.
TEST_F(PacsOdd, ALimitOfTheServerIsTold) {
    for (const std::uint16_t status : {0xfe00, 0xb001, 0xa700}) {
        const LimitedServer limited(3, status);
        const auto result = archive::search({limited.server()}, {});
        ASSERT_EQ(result.outcomes.size(), 1U);
        EXPECT_FALSE(result.outcomes.front().failure);
        EXPECT_TRUE(result.outcomes.front().mayBeIncomplete) << std::hex << status;
        EXPECT_EQ(result.entries.size(), 3U);
    }
    const LimitedServer whole(3, 0), nothing(0, 0xa700);
    EXPECT_FALSE(archive::search({whole.server()}, {}).outcomes.front().mayBeIncomplete);
    EXPECT_TRUE(archive::search({nothing.server()}, {}).outcomes.front().failure);
}

// Orthanc lists as many objects as it is configured to, and knows how many it has.
TEST_F(Pacs, ALimitedOrthancSendsAllOfASeries) {
    if (!isInstalled("Orthanc") || !fs::exists("/usr/share/orthanc/plugins/libOrthancDicomWeb.so"))
        GTEST_SKIP() << "Orthanc's DICOMweb plugin is not installed";
    const Orthanc orthanc(Orthanc::dicomWeb() +
                          R"(, "LimitFindInstances": 20, "LimitFindResults": 20)");
    const archive::Server dicom = serverAt(orthanc.port(), "ORTHANC");
    const archive::Server web{
        "web",
        archive::webPeer("http://127.0.0.1:" + std::to_string(orthanc.webPort()) + "/dicom-web")};
    const fs::path sent = series("A", 64);
    put(dicom, sent);
    for (const archive::Server &server : {dicom, web}) {
        const auto report = get(server, studyIn(sent), server.name);
        EXPECT_TRUE(report.isComplete());
        EXPECT_EQ(report.state.received, 64U);
        EXPECT_EQ(report.state.wanted, 64U);
    }
}

} // namespace pellucid
