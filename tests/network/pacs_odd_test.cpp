// SPDX-License-Identifier: GPL-3.0-or-later
// Web servers that limit their lists, close connections, are busy or know only a part of the
// standard: a part of a study is never taken for all of it, and what can come comes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "core/archive/reasons.h"
#include "core/archive/retrieval.h"
#include "core/archive/search.h"
#include "core/archive/sending.h"
#include "core/dicom/missing_objects.h"
#include "core/task/error.h"
#include "tests/network/http_server.h"
#include "tests/network/odd_web_server.h"
#include "tests/network/pacs.h"
#include "tests/network/scripted_server.h"
#include "tests/network/servers.h"
#include "tests/support/dicom_writer.h"

namespace pellucid {

namespace {

namespace because = task::because;
using namespace test;

constexpr int objectCount = 64;

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
        return get(web.server(), OddWebServer::study, to);
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
        {"20 without offsets or numbers",
         {.cap = 20, .countsObjects = false, .knowsOffsets = false}},
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
        EXPECT_TRUE(report.isComplete()) << report.missing.front().reason.english();
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
    ASSERT_EQ(short20.missing.size(), std::size_t(objectCount - 20));
    // Whoever opens the folder is told.
    const auto missingIn = [&](const char *name) {
        return dicom::missingObjectsBeside(filesIn(m_folder / name).front()).value_or(0);
    };
    EXPECT_EQ(missingIn("short"), std::size_t(objectCount - 20));
    EXPECT_TRUE(retrieved({}, "short").isComplete());
    EXPECT_EQ(missingIn("short"), 0U);
    const auto unsaid = retrieved(
        {.cap = 20, .countsObjects = false, .sendsSeries = false, .saysThereIsMore = true}, "more");
    EXPECT_EQ(unsaid.state.received, 20U);
    EXPECT_FALSE(unsaid.isComplete());
    const auto invalid = retrieved({.sendsSeries = false, .hasInvalidUid = true}, "invalid");
    EXPECT_EQ(invalid.state.received, std::size_t(objectCount - 1));
    ASSERT_EQ(invalid.missing.size(), 1U);
    EXPECT_TRUE(invalid.missing.front().reason.is(because::hasNoValidUids));
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

// An archive corrects a name after the study was received: that is noticed, and replacing brings
// the corrected objects.
TEST_F(PacsScripted, ACorrectionIsNoticedAndReplaced) {
    std::string name = OddWebServer::name;
    Quirks quirks;
    quirks.objects = 3;
    quirks.change = namesPatient(name);
    const OddWebServer web(quirks);
    const archive::ObjectFolder folder(m_folder / "got", archive::ObjectFolder::Durability::cached);
    const auto retrieve = [&](archive::Existing existing) {
        return archive::retrieve(web.server(),
                                 {.studyUid = OddWebServer::study, .existing = existing}, folder);
    };
    const auto namesHere = [&] {
        std::set<std::string> names;
        for (int n = 0; n < 3; ++n)
            names.insert(
                folder.find(OddWebServer::study, OddWebServer::series, OddWebServer::instance(n))
                    .value()
                    .patient.name);
        return names;
    };
    EXPECT_EQ(retrieve(archive::Existing::stays).corrected, 0U);
    name = "M\xc3\xbcller^Ava"; // of the same length
    const auto noticed = retrieve(archive::Existing::stays);
    EXPECT_EQ(noticed.state.present, 3U);
    EXPECT_EQ(noticed.corrected, 3U);
    ASSERT_EQ(noticed.corrections.size(), 1U);
    EXPECT_EQ(archive::reasonOf(noticed.corrections[0]).english(),
              "the patient's name is 'M\u00FCller^Eva' on this computer, but 'M\u00FCller^Ava' on "
              "the server");
    EXPECT_EQ(namesHere(), std::set<std::string>{OddWebServer::name});
    const auto replaced = retrieve(archive::Existing::isReplaced);
    EXPECT_TRUE(replaced.isComplete());
    EXPECT_EQ(replaced.state.received, 3U);
    EXPECT_EQ(replaced.corrected, 0U);
    EXPECT_EQ(namesHere(), std::set<std::string>{name});
    EXPECT_EQ(retrieve(archive::Existing::isReplaced).state.received,
              0U); // nothing is left to replace
}

} // namespace pellucid
