// SPDX-License-Identifier: GPL-3.0-or-later
// The program against real servers: DCMTK's dcmqrscp and Orthanc.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <future>
#include <iostream>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <thread>
#include <utility>

#include "core/archive/listener.h"
#include "core/archive/reasons.h"
#include "core/archive/receiving.h"
#include "core/archive/retrieval.h"
#include "core/archive/run_transfer.h"
#include "core/archive/search.h"
#include "core/archive/sending.h"
#include "core/archive/transfer_log.h"
#include "core/dicom/arriving_series.h"
#include "core/dicom/load_volume.h"
#include "core/network/client/reasons.h"
#include "core/network/process/reasons.h"
#include "core/task/error.h"
#include "tests/network/lying_server.h"
#include "tests/network/pacs.h"
#include "tests/network/scripted_server.h"
#include "tests/support/command.h"
#include "tests/support/search_seed.h"

namespace pellucid {

using namespace test;
namespace because = task::because;
using archive::ObjectFolder;
using archive::RetrievalReport;

TEST_F(Pacs, EveryServiceOfEachServer) {
    test::Dcmqrscp dcmqrscp;
    std::vector<archive::Server> servers{serverAt(dcmqrscp.port(), "COMMON")};
    std::unique_ptr<test::Orthanc> orthanc;
    if (test::isInstalled("Orthanc")) {
        orthanc = std::make_unique<test::Orthanc>();
        servers.push_back(serverAt(orthanc->port(), "ORTHANC"));
    }
    std::unique_ptr<test::PixelMed> pixelMed;
    if (test::PixelMed::isInstalled()) {
        pixelMed = std::make_unique<test::PixelMed>();
        servers.push_back(serverAt(pixelMed->port(), "PIXELMED"));
    }
    const fs::path sent = series("A", 24);
    const std::string study = studyIn(sent);
    for (const archive::Server &server : servers) {
        std::string offers;
        network::Link link(network::Connection{server.peer, network::Purpose::echo});
        link.echo({}, [&](network::Step, const std::string &found) { offers = found; });
        EXPECT_EQ(offers, "C-FIND, C-GET, C-MOVE, C-STORE");
        put(server, sent);
        auto found = archive::search({server}, {.patientName = "Test^*"});
        // PixelMed lists an object a moment after it has confirmed it.
        for (int n = 0; n < 100 && found.entries.empty(); ++n, ::usleep(100000))
            found = archive::search({server}, {.patientName = "Test^*"});
        ASSERT_EQ(found.entries.size(), 1U);
        EXPECT_EQ(found.entries[0].text(network::tag::studyUid), study);
        EXPECT_EQ(found.entries[0].text(network::tag::patientName), "Test^A");
        const std::string to = "got-" + server.peer.calledAe;
        const RetrievalReport report = get(server, study, to);
        EXPECT_TRUE(report.isComplete());
        EXPECT_EQ(report.state.received, 24U);
        EXPECT_EQ(dataSetsIn(m_folder / to), dataSetsIn(sent));
        std::uintmax_t bytes = 0;
        for (const fs::path &file : filesIn(m_folder / to))
            bytes += fs::file_size(file);
        EXPECT_EQ(report.state.bytes, bytes);
        // A second time, there is nothing to do.
        const RetrievalReport again = get(server, study, to);
        EXPECT_EQ(again.state.present, 24U);
        EXPECT_EQ(again.state.received, 0U);
        // What lacks, and only that.
        fs::remove(filesIn(m_folder / to)[3]);
        EXPECT_EQ(get(server, study, to).state.received, 1U);
        EXPECT_EQ(dataSetsIn(m_folder / to), dataSetsIn(sent));
    }
}

// What a server stores compressed arrives as it is stored. (Deflated objects are deflated again.)
TEST_F(Pacs, CompressedObjectsStayCompressed) {
    std::unique_ptr<test::Orthanc> orthanc;
    if (test::isInstalled("Orthanc"))
        orthanc = std::make_unique<test::Orthanc>();
    using dicom::TransferSyntax;
    struct Case {
        std::string name;
        TransferSyntax syntax;
        std::string option; // by which dcmqrscp accepts it
    };
    for (const auto &[name, syntax, option] :
         {Case{"ls", TransferSyntax::jpegLs, "+xt"},
          Case{"ll", TransferSyntax::jpegLossless, "+xs"}, Case{"rle", TransferSyntax::rle, "+xr"},
          Case{"j2k", TransferSyntax::jpeg2000, "+xv"},
          Case{"imp", TransferSyntax::implicitLittle, "+xi"}}) {
        const fs::path sent = series(name, 5, 48, syntax);
        test::Dcmqrscp dcmqrscp({option});
        std::vector<archive::Server> servers{serverAt(dcmqrscp.port(), "COMMON")};
        if (orthanc)
            servers.push_back(serverAt(orthanc->port(), "ORTHANC"));
        for (const archive::Server &server : servers) {
            put(server, sent);
            const std::string to = name + server.peer.calledAe;
            const RetrievalReport report = get(server, studyIn(sent), to);
            EXPECT_TRUE(report.isComplete()) << to << report.missing.front().reason.english();
            const auto metaSyntax = [](const fs::path &folder) {
                return dicom::scan({folder})
                    .patients.at(0)
                    .studies.at(0)
                    .series.at(0)
                    .volumes.at(0)
                    .frames.size();
            };
            EXPECT_EQ(metaSyntax(m_folder / to), 5U) << to;
            EXPECT_EQ(dataSetsIn(m_folder / to), dataSetsIn(sent)) << to;
        }
    }
}

TEST_F(Pacs, EveryServiceOfDicomWeb) {
    if (!test::isInstalled("Orthanc") ||
        !fs::exists("/usr/share/orthanc/plugins/libOrthancDicomWeb.so"))
        GTEST_SKIP() << "Orthanc's DICOMweb plugin is not installed";
    test::Orthanc orthanc(test::Orthanc::dicomWeb());
    archive::Server server{
        "web",
        archive::webPeer("http://127.0.0.1:" + std::to_string(orthanc.webPort()) + "/dicom-web")};
    network::Link link(network::Connection{server.peer, network::Purpose::echo});
    link.echo();
    const fs::path plain = series("A", 24),
                   compressed = series("B", 6, 48, dicom::TransferSyntax::jpegLs);
    put(server, plain);
    put(server, compressed);
    const auto found = archive::search({server}, {});
    EXPECT_EQ(found.entries.size(), 2U);
    const auto named = archive::search({server}, {.patientName = "Test^A"});
    ASSERT_EQ(named.entries.size(), 1U);
    EXPECT_EQ(named.entries[0].text(network::tag::studyUid), studyIn(plain));
    for (const auto &[name, sent] : {std::pair("a", plain), std::pair("b", compressed)}) {
        const RetrievalReport report = get(server, studyIn(sent), name);
        EXPECT_TRUE(report.isComplete()) << report.missing.front().reason.english();
        EXPECT_EQ(dataSetsIn(m_folder / name), dataSetsIn(sent));
    }
    server.peer.path = "/elsewhere";
    const auto wrong = archive::search({server}, {});
    EXPECT_TRUE(wrong.outcomes[0].failure->is(because::serverHasNothingThere));
    server.limit = 1;
    server.peer.path = "/dicom-web";
    EXPECT_TRUE(archive::search({server}, {}).outcomes[0].reachedLimit);
}

// The commands that take a path also take a server, and leave nothing behind.
TEST_F(Pacs, CommandsTakeAStudyFromAServer) {
    const char *const cli = std::getenv("PELLUCID_CLI");
    if (cli == nullptr)
        GTEST_SKIP() << "PELLUCID_CLI is not set";
    test::Dcmqrscp dcmqrscp;
    const fs::path sent = series("F", 24);
    put(serverAt(dcmqrscp.port(), "COMMON"), sent);
    ::setenv("XDG_DATA_HOME", (m_folder / "data").c_str(), 1);
    ::setenv("XDG_CACHE_HOME", (m_folder / "cache").c_str(), 1);
    const auto run = [&](const std::string &arguments) {
        return test::run(std::string("'") + cli + "' " + arguments);
    };
    ASSERT_EQ(
        run("server add s --dicom COMMON@127.0.0.1:" + std::to_string(dcmqrscp.port())).exitCode,
        0);
    const std::string from = " --from s --study " + studyIn(sent);
    const std::string here = (m_folder / "here.npy").string(),
                      there = (m_folder / "there.npy").string();
    ASSERT_EQ(run("render '" + sent.string() + "' -o '" + here + "'").exitCode, 0);
    for (const std::string series : {"", " --series 1"}) {
        const auto rendered = run("render" + from + series + " -o '" + there + "'");
        EXPECT_EQ(rendered.exitCode, 0) << rendered.error;
        EXPECT_EQ(readText(there), readText(here));
        fs::remove(there);
    }
    const auto info = run("info --json" + from);
    EXPECT_EQ(info.exitCode, 0) << info.error;
    EXPECT_NE(info.out.find("Test^F"), std::string::npos);
    EXPECT_EQ(filesIn(m_folder / "cache" / "pellucid" / "sessions").size(), 0U);
    // Each mistake has its own exit code, and nothing is written.
    const std::string out = " -o '" + there + "'";
    EXPECT_EQ(run("render" + out).exitCode, 2);
    EXPECT_EQ(run("render --from s" + out).exitCode, 2);
    EXPECT_EQ(run("render --from nobody --study 1.2" + out).exitCode, 2);
    EXPECT_EQ(run("render" + from + " --series soft" + out).exitCode, 2);
    EXPECT_EQ(run("get s --study " + studyIn(sent) + " --series soft").exitCode, 2);
    EXPECT_EQ(run("render '" + sent.string() + "'" + from + out).exitCode, 2);
    // What is well formed, and not there.
    EXPECT_EQ(run("render --from s --study 1.2.3.4" + out).exitCode, 3);
    EXPECT_EQ(run("get s --study 1.2.3.4").exitCode, 3);
    for (const std::string series : {"7", "1.2.3.4.5"}) {
        EXPECT_EQ(run("render" + from + " --series " + series + out).exitCode, 3) << series;
        EXPECT_EQ(run("get s --study " + studyIn(sent) + " --series " + series).exitCode, 3)
            << series;
    }
    EXPECT_EQ(run("transfers list").out, ""); // none of it can be tried again
    ASSERT_EQ(
        run("server add dead --dicom X@127.0.0.1:" + std::to_string(test::freePort())).exitCode, 0);
    EXPECT_EQ(run("info --from dead --study 1.2.3.4").exitCode, 6);
    EXPECT_FALSE(fs::exists(there));
}

// A program that is killed while it retrieves leaves nothing that is half there, and the next one
// goes on by itself.
TEST_F(Pacs, KillsLoseNothing) {
    const char *const cli = std::getenv("PELLUCID_CLI");
    if (cli == nullptr)
        GTEST_SKIP() << "PELLUCID_CLI is not set";
    test::Dcmqrscp dcmqrscp;
    const fs::path sent = series("K", 40);
    put(serverAt(dcmqrscp.port(), "COMMON"), sent);
    const auto expected = dataSetsIn(sent);
    const std::string study = studyIn(sent);
    const std::string data = (m_folder / "data").string();
    fs::create_directories(data);
    ::setenv("XDG_DATA_HOME", data.c_str(), 1);
    const std::string add = std::string("'") + cli + "' server add s --dicom COMMON@127.0.0.1:" +
                            std::to_string(dcmqrscp.port());
    ASSERT_EQ(test::run(add).exitCode, 0);
    std::mt19937 random(test::searchSeed());
    const int kills = std::getenv("PELLUCID_LONG_TESTS") != nullptr ? 200 : 15;
    for (int n = 0; n < kills; ++n) {
        const std::string to = (m_folder / ("kill" + std::to_string(n))).string();
        const std::string get =
            std::string("'") + cli + "' get s --study " + study + " --to '" + to + "' --json";
        const pid_t child = ::fork();
        if (child == 0) {
            ::setpgid(0, 0);
            ::execl("/bin/sh", "sh", "-c", ("exec " + get + " >/dev/null 2>&1").c_str(), nullptr);
            ::_exit(127);
        }
        ::usleep(useconds_t(random() % 250000));
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        for (const std::string &set : dataSetsIn(to))
            EXPECT_TRUE(expected.contains(set));
        const auto again = test::run(get);
        EXPECT_EQ(again.exitCode, 0) << again.error;
        EXPECT_EQ(dataSetsIn(to), expected);
        fs::remove_all(to);
    }
    ::unsetenv("XDG_DATA_HOME");
}

// A study that the server does not have leaves nothing to try again. What has arrived before stays,
// with the reason.
TEST_F(PacsScripted, AStudyThatIsNotThereLeavesNoTransfer) {
    ::setenv("XDG_DATA_HOME", (m_folder / "data").c_str(), 1);
    std::atomic<std::size_t> most = 0; // objects that the server sends
    LyingServer server(6, [&](ScriptedAssociation &association, const ScriptedRequest &request,
                              const std::vector<std::string> &uids) {
        const std::size_t count = std::min(uids.size(), most.load());
        for (std::size_t n = 0; n < count; ++n)
            LyingServer::sendTruly(association, uids[n]);
        association.endGet(request, 0, int(count));
    });
    archive::Server at = serverAt(server.port(), "LIES");
    at.connections = 1;
    archive::TransferLog log(m_folder / "transfers.sqlite");
    const auto run = [&](const std::string &to) {
        archive::Transfer transfer;
        transfer.server = at.name;
        transfer.wanted.studyUid = LyingServer::study;
        transfer.folder = m_folder / to;
        const std::int64_t id = log.add(transfer);
        std::optional<task::Reason> failure;
        try {
            archive::runTransfer(log, id, at);
        } catch (const task::Error &error) {
            failure = error.reason();
        }
        return std::pair(log.transfer(id), failure);
    };
    const auto isRefused = [](const std::optional<task::Reason> &failure) {
        return failure && failure->is(because::serverHasNoSuchStudy);
    };
    const auto nothing = run("nothing");
    EXPECT_FALSE(nothing.second) << nothing.second->english();
    ASSERT_TRUE(nothing.first.has_value()); // it may still come
    EXPECT_EQ(nothing.first->total, 6U);
    most = 2;
    const auto begun = run("part");
    EXPECT_FALSE(begun.second) << begun.second->english();
    EXPECT_EQ(begun.first->received, 2U);
    server.forgetStudy();
    for (const std::string to : {"new", "nothing"}) {
        const auto refused = run(to);
        EXPECT_TRUE(isRefused(refused.second)) << to;
        EXPECT_FALSE(refused.first.has_value()) << to;
    }
    const auto kept = run("part");
    EXPECT_TRUE(isRefused(kept.second));
    ASSERT_TRUE(kept.first.has_value());
    EXPECT_EQ(kept.first->state, archive::TransferState::incomplete);
    EXPECT_EQ(kept.first->received, 2U);
    EXPECT_EQ(kept.first->total, 6U);
    EXPECT_TRUE(isRefused(task::Reason::decoded(kept.first->reason)));
    EXPECT_EQ(filesIn(m_folder / "part").size(), 2U);
    EXPECT_EQ(log.transfers().size(), 1U);
    ::unsetenv("XDG_DATA_HOME");
}

TEST_F(Pacs, AServerThatOnlySendsIsGivenAPort) {
    test::Dcmqrscp dcmqrscp;
    archive::Server server = serverAt(dcmqrscp.port(), "COMMON");
    const fs::path sent = series("M", 20);
    put(server, sent);
    server.retrieve = archive::RetrieveMethod::move;
    const ObjectFolder folder(m_folder / "got", ObjectFolder::Durability::cached);
    const RetrievalReport report =
        archive::retrieve(server, {studyIn(sent), {}}, folder, {}, {},
                          {.ae = "PELLUCID", .port = dcmqrscp.destinationPort});
    EXPECT_TRUE(report.isComplete());
    EXPECT_EQ(dataSetsIn(m_folder / "got"), dataSetsIn(sent));
    // A destination that the server does not know.
    const ObjectFolder other(m_folder / "other", ObjectFolder::Durability::cached);
    const RetrievalReport refused = archive::retrieve(server, {studyIn(sent), {}}, other, {}, {},
                                                      {.ae = "NOBODY", .port = test::freePort()});
    ASSERT_EQ(refused.missing.size(), 20U);
    EXPECT_NE(refused.missing[0].reason.english().find("0xA801"), std::string::npos)
        << refused.missing[0].reason.english();
    // The port of another receiver.
    int port = 0;
    const int taken = test::listenOn(port);
    EXPECT_NE(failureOf([&] {
                  archive::retrieve(server, {studyIn(sent), {}}, other, {}, {}, {.port = port});
              }).find("is in use"),
              std::string::npos);
    ::close(taken);
}

// A pulled cable at any moment: the reason is named, nothing is half there, and the next retrieval
// brings the rest, each object once.
TEST_F(Pacs, CutsAndStallsLoseNothing) {
    test::Dcmqrscp dcmqrscp;
    archive::Server server = serverAt(dcmqrscp.port(), "COMMON");
    const fs::path sent = series("C", 24);
    put(server, sent);
    const auto expected = dataSetsIn(sent);
    const std::string study = studyIn(sent);
    long bytes = 0;
    for (const fs::path &file : filesIn(sent))
        bytes += long(fs::file_size(file));
    test::Proxy proxy(dcmqrscp.port());
    server.peer.port = proxy.port();
    server.peer.silenceSeconds = 2.0;
    server.connections = 2;
    std::mt19937 random(test::searchSeed());
    const int cuts = std::getenv("PELLUCID_LONG_TESTS") != nullptr ? 200 : 12;
    for (int n = 0; n < cuts; ++n) {
        const std::string to = "cut" + std::to_string(n);
        // Each connection is cut, also those that replace it, so most attempts end incomplete.
        test::Mischief mischief;
        const long at = long(random() % (std::uint32_t(bytes) / 2));
        (n % 6 == 5 ? mischief.stallAfter : mischief.cutAfter) = at;
        proxy.set(mischief);
        std::size_t had = 0;
        try {
            const RetrievalReport report = get(server, study, to);
            had = report.state.received;
            for (const auto &object : report.missing)
                EXPECT_FALSE(object.reason.english().empty());
        } catch (const task::Error &error) {
            EXPECT_EQ(error.code(), task::ErrorCode::unreachable) << error.what();
            EXPECT_FALSE(error.reason().english().empty());
        }
        // Nothing that is there is wrong.
        for (const std::string &set : dataSetsIn(m_folder / to))
            EXPECT_TRUE(expected.contains(set)) << "cut after " << at;
        proxy.set({});
        const RetrievalReport rest = get(server, study, to);
        EXPECT_TRUE(rest.isComplete());
        EXPECT_GE(rest.state.present, had);
        EXPECT_EQ(dataSetsIn(m_folder / to), expected) << "cut after " << at;
        fs::remove_all(m_folder / to);
    }
}

// At 20 ms round trip, objects come over several connections, and in time.
TEST_F(Pacs, ALongWayIsUsedByConnectionsTogether) {
    test::Dcmqrscp dcmqrscp;
    archive::Server server = serverAt(dcmqrscp.port(), "COMMON");
    const fs::path sent = series("W", 64, 128);
    put(server, sent);
    test::Proxy proxy(dcmqrscp.port());
    proxy.set({.delayMs = 10});
    server.peer.port = proxy.port();
    const std::string study = studyIn(sent);
    server.connections = 1;
    const double one = get(server, study, "one").seconds;
    server.connections = 4;
    const RetrievalReport four = get(server, study, "four");
    EXPECT_TRUE(four.isComplete());
    EXPECT_LT(four.seconds, 0.75 * one);
    std::cout << "64 objects at 20 ms: " << one << " s by one connection, " << four.seconds
              << " s by four\n";
}

// Over 100 Mbit/s: the panes open with the first slices, the projection after an eighth of them,
// and the whole is there a moment after the last byte.
TEST_F(Pacs, ASeriesIsSeenLongBeforeItIsHere) {
    // dcmqrscp lets its connections wait for each other.
    if (!test::isInstalled("Orthanc"))
        GTEST_SKIP() << "Orthanc is not installed";
    test::Orthanc orthanc;
    archive::Server server = serverAt(orthanc.port(), "ORTHANC");
    const int slices = std::getenv("PELLUCID_LONG_TESTS") != nullptr ? 512 : 96;
    const fs::path sent = series("S", slices, 512);
    put(server, sent);
    test::Proxy proxy(orthanc.port());
    proxy.set({.bytesPerSecond = 100e6 / 8.0});
    server.peer.port = proxy.port();
    const std::string study = studyIn(sent);
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    const auto since = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
    double first = 0.0, eighth = 0.0, whole = 0.0, listing = 0.0, firstObject = 0.0;
    std::atomic<double> lastByte = 0.0;
    std::map<std::string, std::size_t> numbers;
    std::shared_ptr<dicom::ArrivingSeries> arriving;
    std::promise<void> listed;
    std::jthread loader([&] {
        listed.get_future().wait();
        const auto arrived =
            arriving->load({}, [&](const dicom::PartialVolume &part, const task::Progress &) {
                first = first == 0.0 ? since() : first;
                if (part.stride <= 8 && eighth == 0.0)
                    eighth = since();
            });
        whole = since();
        EXPECT_EQ(arrived.loaded.volume.lattice().size().k, slices);
    });
    archive::RetrievalObserver observer;
    observer.listed = [&](const archive::Listing &list) {
        for (const archive::Instance &instance : list.instances)
            numbers.emplace(instance.sopInstanceUid, numbers.size());
        arriving = std::make_shared<dicom::ArrivingSeries>(numbers.size());
        listing = since();
        listed.set_value();
    };
    observer.stored = [&](const archive::StoredObject &object) {
        lastByte = since();
        firstObject = firstObject == 0.0 ? double(lastByte) : firstObject;
        arriving->add(numbers.at(object.sopInstanceUid), object.path);
    };
    const ObjectFolder folder(m_folder / "got", ObjectFolder::Durability::cached);
    EXPECT_TRUE(archive::retrieve(server, {study, {}}, folder, observer).isComplete());
    loader.join();
    std::cout << slices << " slices at 100 Mbit/s: listed after " << listing
              << " s, the first here after " << firstObject << " s, shown after " << first
              << " s, an eighth after " << eighth << " s, all here after " << lastByte
              << " s, assembled " << whole - lastByte << " s later\n";
    EXPECT_GT(first, 0.0);
    EXPECT_GT(eighth, 0.0);
    EXPECT_LT(eighth, 0.6 * lastByte);
}

TEST_F(Pacs, TheListenerConfirmsWhatItHas) {
    if (!test::isInstalled("storescu"))
        GTEST_SKIP() << "storescu is not installed";
    const fs::path sent = series("L", 6);
    const ObjectFolder folder(m_folder / "in", ObjectFolder::Durability::synced);
    fs::create_directories(folder.folder());
    archive::TransferLog log(m_folder / "transfers.sqlite");
    std::vector<archive::ConnectionEnd> ends;
    archive::Receiving receiving(folder, &log);
    archive::ListenerOptions options;
    options.port = 0;
    options.senders = {{"KNOWN", "127.0.0.1"}, {"OTHER", "127.0.0.1"}};
    std::optional<archive::Listener> listener(
        std::in_place, options, [&] { return receiving.receiver(); },
        archive::ListenerObserver{[&](const archive::ConnectionEnd &end) { ends.push_back(end); }});
    const auto storescu = [&](const std::string &from, const std::string &to) {
        return test::run("storescu -R -aet " + from + " -aec " + to + " +sd 127.0.0.1 " +
                         std::to_string(listener->port()) + " '" + sent.string() + "'")
            .exitCode;
    };
    EXPECT_EQ(storescu("KNOWN", "PELLUCID"), 0);
    EXPECT_EQ(dataSetsIn(folder.folder()), dataSetsIn(sent));
    EXPECT_EQ(log.arrivals().size(), 6U);
    EXPECT_NE(storescu("STRANGER", "PELLUCID"), 0);
    EXPECT_NE(storescu("KNOWN", "ANOTHER"), 0);
    EXPECT_EQ(dataSetsIn(folder.folder()).size(), 6U);
    EXPECT_EQ(
        test::run("echoscu -aet KNOWN -aec PELLUCID 127.0.0.1 " + std::to_string(listener->port()))
            .exitCode,
        0);
    // Each sender is counted by itself, also for what is here already.
    EXPECT_EQ(storescu("OTHER", "PELLUCID"), 0);
    listener.reset(); // waits for the connections to end
    std::map<std::string, std::size_t> stored;
    for (const archive::ConnectionEnd &end : ends) {
        stored[end.sender] += end.stored;
        EXPECT_EQ(end.address, "127.0.0.1");
    }
    EXPECT_EQ(stored["KNOWN"], 6U);
    EXPECT_EQ(stored["OTHER"], 6U);
}

// One server is dead, one hangs: the third answers at once.
TEST_F(Pacs, DeadServersDelayNobody) {
    test::Dcmqrscp dcmqrscp;
    const archive::Server alive = serverAt(dcmqrscp.port(), "COMMON");
    put(alive, series("D", 2));
    archive::Server dead = serverAt(test::freePort(), "DEAD"), hangs = alive;
    dead.name = "dead";
    hangs.name = "hangs";
    int silentPort = 0;
    const int silent = test::listenOn(silentPort); // accepts, and says nothing
    hangs.peer.port = silentPort;
    hangs.peer.associationSeconds = 2.0;
    std::map<std::string, double> ended;
    const auto begin = std::chrono::steady_clock::now();
    const auto result = archive::search(
        {dead, hangs, alive}, {},
        {{}, [&](const archive::ServerOutcome &outcome) {
             ended[outcome.server] =
                 std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
         }});
    ::close(silent);
    EXPECT_EQ(result.entries.size(), 1U);
    EXPECT_LT(ended["test"], ended["hangs"]);
    for (const archive::ServerOutcome &outcome : result.outcomes) {
        EXPECT_EQ(outcome.failure.has_value(), outcome.server != "test") << outcome.server;
        if (outcome.server == "dead") {
            EXPECT_TRUE(outcome.failure->is(because::connectionIsRefused));
        } else if (outcome.server == "hangs") {
            EXPECT_TRUE(outcome.failure->is(because::serverDoesNotAnswer))
                << outcome.failure->english();
        }
    }
}

TEST_F(Pacs, ASearchEndsAtItsLimit) {
    test::Dcmqrscp dcmqrscp;
    archive::Server server = serverAt(dcmqrscp.port(), "COMMON");
    for (int n = 0; n < 5; ++n)
        put(server, series("S" + std::to_string(n), 1, 16));
    server.limit = 3;
    const auto some = archive::search({server}, {});
    EXPECT_EQ(some.entries.size(), 3U);
    EXPECT_TRUE(some.outcomes[0].reachedLimit);
    server.limit = 5;
    const auto all = archive::search({server}, {});
    EXPECT_EQ(all.entries.size(), 5U);
    EXPECT_FALSE(all.outcomes[0].reachedLimit);
}

} // namespace pellucid
