// SPDX-License-Identifier: GPL-3.0-or-later
// Servers that lie: what is false is refused with a reason, what is true is kept, and nothing else
// appears in the folder.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>

#include "core/archive/instance_list.h"
#include "core/archive/reasons.h"
#include "core/archive/retrieval.h"
#include "core/archive/search.h"
#include "core/archive/server.h"
#include "core/files/reasons.h"
#include "core/network/client/reasons.h"
#include "core/network/process/reasons.h"
#include "core/task/error.h"
#include "tests/network/http_server.h"
#include "tests/network/lying_server.h"
#include "tests/network/pacs.h"
#include "tests/network/processes.h"
#include "tests/support/files.h"

namespace pellucid {

using namespace test;
namespace because = task::because;
using archive::ObjectFolder;
using archive::RetrievalReport;

namespace {

constexpr int instances = 4;

class Lies : public PacsScripted {
protected:
    static archive::Server at(const LyingServer &lying) {
        archive::Server server = serverAt(lying.port(), "LIES");
        server.connections = 1;
        return server;
    }
    // Only these objects are in the folder, each whole and in its place.
    void expectOnly(const std::string &to, const std::vector<int> &numbers) const {
        std::set<fs::path> expected;
        for (const int n : numbers) {
            const std::string uid = LyingServer::instance(n);
            const fs::path file =
                m_folder / to / LyingServer::study / LyingServer::series / (uid + ".dcm");
            expected.insert(file);
            EXPECT_EQ(dataSetOf(file), LyingServer::object(uid).dataset({})) << file;
        }
        const auto files = filesIn(m_folder / to);
        EXPECT_EQ(std::set<fs::path>(files.begin(), files.end()), expected);
    }
};

// The helper did not break: its own faults have reasons of their own.
bool blamesTheHelper(const task::Reason &reason) {
    return reason.is(because::helperCrashed) || reason.is(because::implausibleReply) ||
           reason.is(because::helperBrokeItsConfinement) || reason.is(because::helperDoesNotAnswer);
}

} // namespace

TEST_F(Lies, AFalseObjectIsRefusedAndTheOthersAreKept) {
    const std::map<std::string, task::Reason> reasons{
        {"cut short", because::isTruncated},
        {"cut in an element's head", because::isTruncated},
        {"longer than it is", because::isTruncated},
        {"two gigabytes long", because::isTruncated},
        {"of undefined length", because::isTruncated},
        {"another instance", because::isNotWhatWasAnnounced},
        {"another class", because::isNotWhatWasAnnounced},
        {"another study", because::isNotWhatWasAnnounced},
        {"another series", because::isNotWhatWasAnnounced},
        {"a path as its study", because::hasNoValidUids},
        {"a path as its series", because::hasNoValidUids},
        {"a path as its name", because::isNotWhatWasAnnounced},
        {"no study", because::hasNoValidUids},
        {"no instance", because::isNotWhatWasAnnounced}};
    for (const Lie &lie : liesAboutObjects()) {
        SCOPED_TRACE(lie.what);
        std::atomic<int> status = -1;
        const LyingServer lying(instances, [&](ScriptedAssociation &association,
                                               const ScriptedRequest &request,
                                               const std::vector<std::string> &uids) {
            for (const std::string &uid : uids)
                if (uid == LyingServer::instance(1))
                    status = association.store(uid::capture, uid, lie.dataset(uid));
                else
                    EXPECT_EQ(LyingServer::sendTruly(association, uid), 0);
            association.endGet(request, 0, int(uids.size())); // all are claimed to be sent
        });
        const RetrievalReport report = get(at(lying), LyingServer::study, lie.what);
        EXPECT_EQ(status, 0xa900); // the server learns that it was not kept
        ASSERT_EQ(report.missing.size(), 1U);
        EXPECT_EQ(report.missing[0].sopInstanceUid, LyingServer::instance(1));
        EXPECT_FALSE(report.missing[0].reason.english().empty());
        if (const auto reason = reasons.find(lie.what); reason != reasons.end()) {
            EXPECT_EQ(report.missing[0].reason.english(), reason->second.english());
        }
        EXPECT_FALSE(blamesTheHelper(report.missing[0].reason));
        expectOnly(lie.what, {0, 2, 3});
        EXPECT_FALSE(fs::exists("/tmp/pellucid-lie"));
    }
}

TEST_F(Lies, ObjectsThatNobodyAskedForAreNotKept) {
    std::map<std::string, int> statuses;
    const LyingServer lying(instances, [&](ScriptedAssociation &association,
                                           const ScriptedRequest &request,
                                           const std::vector<std::string> &uids) {
        // Of the same series, whole and in order, but not of the list.
        const std::string foreign = LyingServer::instance(77);
        statuses["foreign"] = LyingServer::sendTruly(association, foreign);
        for (const char *const path : {"../../../tmp/pellucid-lie", "/tmp/pellucid-lie", ".."})
            statuses["path"] = association.store(
                uid::capture, path, LyingServer::object(LyingServer::instance(0)).dataset({}));
        for (const std::string &uid : uids)
            statuses["wanted"] = LyingServer::sendTruly(association, uid);
        // Once more, with other pixels.
        DicomWriter other = LyingServer::object(LyingServer::instance(0));
        other.put(DicomWriter::pixelData, "OW", std::string(4000, '\x11'));
        statuses["again"] =
            association.store(uid::capture, LyingServer::instance(0), other.dataset({}));
        association.endGet(request, 0, int(uids.size()));
    });
    const RetrievalReport report = get(at(lying), LyingServer::study);
    EXPECT_TRUE(report.isComplete());
    EXPECT_EQ(report.state.received, std::size_t(instances));
    EXPECT_EQ(report.unwanted, 2U); // the invalid ones do not reach the program
    EXPECT_EQ(statuses["foreign"], 0x0124);
    EXPECT_EQ(statuses["path"], 0x0117);
    EXPECT_EQ(statuses["wanted"], 0);
    EXPECT_EQ(statuses["again"], 0x0124);
    expectOnly("got", {0, 1, 2, 3});
    EXPECT_FALSE(fs::exists("/tmp/pellucid-lie"));
}

// A server that goes on and on with other objects is left.
TEST_F(Lies, AServerThatSendsWithoutEndIsLeft) {
    std::atomic<long> sent = 0;
    const LyingServer lying(instances,
                            [&](ScriptedAssociation &association, const ScriptedRequest &,
                                const std::vector<std::string> &) {
                                for (int n = 1000;; ++n, ++sent)
                                    LyingServer::sendTruly(association, LyingServer::instance(n));
                            });
    const RetrievalReport report = get(at(lying), LyingServer::study);
    ASSERT_EQ(report.missing.size(), std::size_t(instances));
    for (const auto &object : report.missing)
        EXPECT_TRUE(object.reason.is(because::serverSendsTooMuch)) << object.reason.english();
    EXPECT_LT(sent, 3000);
    expectOnly("got", {});
}

TEST_F(Lies, ClaimsAreComparedWithWhatCame) {
    const LyingServer lying(instances, [&](ScriptedAssociation &association,
                                           const ScriptedRequest &request,
                                           const std::vector<std::string> &uids) {
        LyingServer::sendTruly(association, uids.front());
        association.endGet(request, 0, 1000); // far more than that, as it says
    });
    const RetrievalReport report = get(at(lying), LyingServer::study);
    EXPECT_EQ(report.state.received, 1U);
    ASSERT_EQ(report.missing.size(), std::size_t(instances) - 1);
    for (const auto &object : report.missing)
        EXPECT_TRUE(object.reason.is(because::serverLeftItOut)) << object.reason.english();
    expectOnly("got", {0});
}

// Each breach ends the connection with a reason, and never the helper. All at the same time: after
// each, the program waits before it connects again.
TEST_F(Lies, BrokenMessagesEndTheConnectionOnly) {
    const std::vector<Violation> all = violations();
    std::vector<std::optional<RetrievalReport>> reports(all.size());
    std::vector<std::string> failures(all.size());
    {
        std::vector<std::jthread> threads;
        for (std::size_t n = 0; n < all.size(); ++n)
            threads.emplace_back([&, n] {
                const LyingServer lying(instances, [&](ScriptedAssociation &association,
                                                       const ScriptedRequest &request,
                                                       const std::vector<std::string> &uids) {
                    // One object before the breach, which stays.
                    if (uids.size() == std::size_t(instances))
                        LyingServer::sendTruly(association, LyingServer::instance(0));
                    association.send(all[n].bytes(association, uids.back()));
                    // If it is taken for an object all the same.
                    if (association.next())
                        association.endGet(request, 0, 1);
                });
                try {
                    reports[n] = get(at(lying), LyingServer::study, all[n].what);
                } catch (const task::Error &error) {
                    failures[n] = error.reason().english();
                }
            });
    }
    for (std::size_t n = 0; n < all.size(); ++n) {
        SCOPED_TRACE(all[n].what);
        EXPECT_EQ(failures[n], "");
        if (!reports[n])
            continue;
        EXPECT_EQ(reports[n]->state.received, 1U);
        EXPECT_EQ(reports[n]->missing.size(), std::size_t(instances) - 1);
        for (const auto &object : reports[n]->missing) {
            EXPECT_FALSE(blamesTheHelper(object.reason)) << object.reason.english();
            EXPECT_FALSE(object.reason.is(because::serverLeftItOut)) << object.reason.english();
            // An abort is an end that the other side wanted.
            EXPECT_EQ(object.reason.is(because::serverHungUp), all[n].what == "an abort")
                << object.reason.english();
        }
        expectOnly(all[n].what, {0});
    }
}

// An object without an end has no name yet, and a cancel ends it.
TEST_F(Lies, AnEndlessObjectIsCancelled) {
    const LyingServer lying(instances, [&](ScriptedAssociation &association,
                                           const ScriptedRequest &,
                                           const std::vector<std::string> &uids) {
        LyingServer::sendTruly(association, uids.front());
        const auto context = association.contextOf(uid::capture);
        const std::string piece = ScriptedAssociation::pdu(
            4, ScriptedAssociation::value(context, 0, std::string(16000, '\x5a')));
        association.send(association.storeCommand(uid::capture, uids.at(1)));
        std::string head = LyingServer::object(uids.at(1)).dataset({});
        head.resize(head.size() - 4000 - 4);
        head += DicomWriter::number(std::uint32_t(0xfffffff0));
        association.send(ScriptedAssociation::pdu(4, ScriptedAssociation::value(context, 0, head)));
        // 16 MB/s: enough to be seen, and not to fill the disk.
        for (;;) {
            association.send(piece);
            ::usleep(1000);
        }
    });
    std::stop_source stop;
    std::uint64_t bytes = 0;
    archive::RetrievalObserver observer;
    observer.changed = [&](const archive::RetrievalState &state) {
        bytes = state.bytes;
        if (state.received == 1 && bytes > (std::uint64_t(8) << 20))
            stop.request_stop();
    };
    const ObjectFolder folder(m_folder / "got", ObjectFolder::Durability::cached);
    EXPECT_THROW(archive::retrieve(at(lying), {LyingServer::study, {}}, folder, observer,
                                   task::Progress(stop.get_token())),
                 task::Cancelled);
    EXPECT_GT(bytes, std::uint64_t(8) << 20);
    EXPECT_TRUE(ownHelpers().empty());
    const auto files = filesIn(m_folder / "got");
    ASSERT_EQ(files.size(), 1U);
    EXPECT_EQ(dataSetOf(files[0]).size(),
              LyingServer::object(LyingServer::instance(0)).dataset({}).size());
}

// Another patient's images under the identifiers that were asked for: they are told apart, now and
// when they are here already.
TEST_F(Lies, ImagesOfAnotherPatientAreReported) {
    const LyingServer lying(instances,
                            [&](ScriptedAssociation &association, const ScriptedRequest &request,
                                const std::vector<std::string> &uids) {
                                for (const std::string &uid : uids)
                                    if (uid == LyingServer::instance(1)) {
                                        DicomWriter other = LyingServer::object(uid);
                                        other.put({0x0010, 0x0010}, "PN", "OTHER^PATIENT");
                                        other.put({0x0010, 0x0020}, "LO", "ID-999");
                                        association.store(uid::capture, uid, other.dataset({}));
                                    } else {
                                        LyingServer::sendTruly(association, uid);
                                    }
                                association.endGet(request, 0, int(uids.size()));
                            });
    for (const std::size_t present : {0, instances}) {
        std::set<std::string> shown;
        archive::RetrievalObserver observer;
        observer.matches = [&](const archive::StoredObject &object) {
            shown.insert(object.sopInstanceUid);
        };
        const ObjectFolder folder(m_folder / "got", ObjectFolder::Durability::cached);
        const auto report =
            archive::retrieve(at(lying), {LyingServer::study, {}}, folder, observer);
        EXPECT_TRUE(report.isComplete());
        EXPECT_EQ(report.state.present, present);
        EXPECT_EQ(report.ofAnotherPatient, 1U);
        EXPECT_EQ(report.listed.id, "LIES-1");
        EXPECT_EQ(report.named.id, "ID-999");
        EXPECT_EQ(shown, (std::set<std::string>{LyingServer::instance(0), LyingServer::instance(2),
                                                LyingServer::instance(3)}));
    }
    // Who was shown is whom the user asked for, whatever the server says now.
    const ObjectFolder folder(m_folder / "asked", ObjectFolder::Durability::cached);
    const auto report = archive::retrieve(
        at(lying), {LyingServer::study, {}, {"OTHER^PATIENT", "ID-999", ""}}, folder);
    EXPECT_EQ(report.ofAnotherPatient, std::size_t(instances) - 1);
}

// A study has a limit, and what a server lists beyond is not kept in memory.
TEST_F(Lies, AnEndlessListOfObjectsIsRefused) {
    std::atomic<long> rows = 0;
    const ScriptedServer lying(
        [&](ScriptedAssociation &association, const ScriptedRequest &request) {
            const std::string level = request.text(0x00080052);
            for (int n = 0; n < (level == "IMAGE" ? 400000 : 1); ++n) {
                if (n % 64 == 0 && association.isWaiting()) {
                    association.next();
                    association.answer(request, 0xfe00);
                    return;
                }
                DicomWriter row;
                row.put({0x0008, 0x0018}, "UI", LyingServer::instance(n));
                row.put({0x0008, 0x0052}, "CS", level);
                row.put({0x0020, 0x000d}, "UI", LyingServer::study);
                row.put({0x0020, 0x000e}, "UI", LyingServer::series);
                association.answer(request, 0xff00, row);
                ++rows;
            }
            association.answer(request, 0);
        });
    const ObjectFolder folder(m_folder / "got", ObjectFolder::Durability::cached);
    try {
        archive::retrieve(serverAt(lying.port(), "LIES"), {LyingServer::study, {}}, folder);
        ADD_FAILURE() << "something was retrieved";
    } catch (const task::Error &error) {
        EXPECT_TRUE(error.reason().is(because::studyHasTooManyObjects)) << error.reason().english();
    }
    EXPECT_LT(rows, 300000);
}

// One answer that is far too long costs neither the helper nor the other answers.
TEST_F(Lies, LongAnswersAreCut) {
    const ScriptedServer lying(
        [](ScriptedAssociation &association, const ScriptedRequest &request) {
            for (int n = 0; n < 3; ++n) {
                DicomWriter row;
                row.put({0x0008, 0x0052}, "CS", "STUDY");
                if (n == 1)
                    for (int other = 0; other < 8; ++other)
                        row.put({0x0008, std::uint16_t(0x1030 + other)}, "LO",
                                std::string(20000, char('a' + other)));
                row.put({0x0010, 0x0010}, "PN", n == 1 ? std::string(50000, 'n') : "Lies^Jane");
                row.put({0x0020, 0x000d}, "UI", LyingServer::study + "." + std::to_string(n));
                association.answer(request, 0xff00, row);
            }
            DicomWriter comment;
            comment.put({0x0000, 0x0902}, "LO", std::string(120000, 'c'));
            association.answer(request, 0, {}, comment);
        });
    const auto result = archive::search({serverAt(lying.port(), "LIES")}, {});
    EXPECT_FALSE(result.outcomes.at(0).failure.has_value())
        << result.outcomes[0].failure->english();
    EXPECT_EQ(result.entries.size(), 3U);

    // And of DICOMweb, with attributes that nobody asked for.
    HttpServer web([](const HttpRequest &request) {
        std::string rows;
        const bool isFirst = request.target.find("offset=0") != std::string::npos;
        for (int n = 0; isFirst && n < 3; ++n) {
            std::string row = R"("0020000D":{"vr":"UI","Value":[")" + LyingServer::study + "." +
                              std::to_string(n) + R"("]})";
            for (int other = 0; n == 1 && other < 200; ++other)
                row += R"(,"0009)" + fmt::format("{:04X}", 0x1000 + other) +
                       R"(":{"vr":"LO","Value":[")" + std::string(1000, 'x') + R"("]})";
            rows += (rows.empty() ? "{" : ",{") + row + "}";
        }
        return HttpAnswer{200, "application/dicom+json", "[" + rows + "]"};
    });
    archive::Server server;
    server.name = "web";
    server.peer = archive::webPeer(web.url());
    const auto found = archive::search({server}, {});
    EXPECT_FALSE(found.outcomes.at(0).failure.has_value()) << found.outcomes[0].failure->english();
    ASSERT_EQ(found.entries.size(), 3U);
    for (const archive::FoundEntry &entry : found.entries)
        for (const auto &[tag, value] : entry.attributes)
            EXPECT_NE(tag >> 16, 0x0009U);
}

// Lists that lie: paths and noise as identifiers are not rows, and no study is made of them.
TEST_F(Lies, IdentifiersOfAListAreChecked) {
    const ScriptedServer lying(
        [](ScriptedAssociation &association, const ScriptedRequest &request) {
            for (const char *const uid : {"../../../tmp/pellucid-lie", "", "1..2", "1.2.3\nx",
                                          "1.2.826.0.1.3680043.8.498.55"}) {
                DicomWriter row;
                row.put({0x0008, 0x0052}, "CS", request.text(0x00080052));
                row.put({0x0008, 0x0018}, "UI", uid);
                row.put({0x0010, 0x0010}, "PN", "Lies\x1b]0;^Jane\nline");
                row.put({0x0020, 0x000d}, "UI", uid);
                row.put({0x0020, 0x000e}, "UI", "..");
                association.answer(request, 0xff00, row);
            }
            association.answer(request, 0);
        });
    const archive::Server server = serverAt(lying.port(), "LIES");
    const auto result = archive::search({server}, {});
    ASSERT_EQ(result.entries.size(), 1U);
    EXPECT_EQ(result.entries[0].text(network::tag::studyUid), "1.2.826.0.1.3680043.8.498.55");
    for (const char c : result.entries[0].text(network::tag::patientName))
        EXPECT_GE((unsigned char)(c), 0x20U);
    const ObjectFolder folder(m_folder / "got", ObjectFolder::Durability::cached);
    try {
        archive::retrieve(server, {"1.2.826.0.1.3680043.8.498.55", {}}, folder);
        ADD_FAILURE() << "something was retrieved";
    } catch (const task::Error &error) {
        EXPECT_TRUE(error.reason().is(because::serverHasNoSuchStudy)) << error.reason().english();
    }
    EXPECT_TRUE(filesIn(m_folder / "got").empty());
}

// Slices are sorted by their places only if each is a number: no order of the others is certain.
TEST_F(Lies, PlacesThatAreNoNumbersDoNotSort) {
    const std::vector<std::string> axes{"1e300\\0\\0\\0\\1e300\\0", "1\\0\\0\\0\\1\\0"};
    for (const std::string wrong : {"0\\0\\nan", "0\\0\\inf", "0\\0\\1e300"}) {
        const ScriptedServer lying(
            [&](ScriptedAssociation &association, const ScriptedRequest &request) {
                const std::string level = request.text(0x00080052);
                for (int n = 0; n < (level == "IMAGE" ? instances : 1); ++n) {
                    DicomWriter row;
                    row.put({0x0008, 0x0018}, "UI", LyingServer::instance(n));
                    row.put({0x0008, 0x0052}, "CS", level);
                    row.put({0x0020, 0x000d}, "UI", LyingServer::study);
                    row.put({0x0020, 0x000e}, "UI", LyingServer::series);
                    row.put({0x0020, 0x0013}, "IS", std::to_string(n));
                    row.put({0x0020, 0x0032}, "DS",
                            n == 0 ? wrong : "0\\0\\" + std::to_string(instances - n));
                    row.put({0x0020, 0x0037}, "DS", n == 0 ? axes[0] : axes[1]);
                    association.answer(request, 0xff00, row);
                }
                association.answer(request, 0);
            });
        const auto listed =
            archive::listInstances(serverAt(lying.port(), "LIES"), {LyingServer::study, {}})
                .instances;
        ASSERT_EQ(listed.size(), std::size_t(instances));
        for (int n = 0; n < instances; ++n)
            EXPECT_EQ(listed[std::size_t(n)].sopInstanceUid, LyingServer::instance(n)) << wrong;
    }
}

// Answers of another kind than the question.
TEST_F(Lies, AnswersToOtherQuestionsAreRefused) {
    for (const std::uint16_t other : {command::storeRequest, command::getRequest}) {
        const ScriptedServer lying(
            [other](ScriptedAssociation &association, ScriptedRequest request) {
                request.field = other;
                association.answer(request, 0);
            });
        const auto result = archive::search({serverAt(lying.port(), "LIES")}, {});
        ASSERT_TRUE(result.outcomes.at(0).failure.has_value());
        EXPECT_TRUE(result.outcomes[0].failure->is(because::serverSendsTheUnexpected))
            << result.outcomes[0].failure->english();
    }
}

} // namespace pellucid
