// SPDX-License-Identifier: GPL-3.0-or-later
// Neither the patient nor a secret appears where other programs, users or later readers can see it.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <unistd.h>
#include <vector>

#include "app/cli/reasons.h"
#include "core/archive/listener.h"
#include "core/archive/receiving.h"
#include "core/archive/run_transfer.h"
#include "core/archive/search.h"
#include "core/archive/sending.h"
#include "core/archive/server.h"
#include "core/archive/transfer_log.h"
#include "core/network/client/reasons.h"
#include "core/system/log.h"
#include "tests/network/http_server.h"
#include "tests/network/pacs.h"
#include "tests/network/processes.h"
#include "tests/support/command.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/files.h"

namespace pellucid {

using namespace test;
namespace because = task::because;

namespace {

// Words that nothing else on this machine contains.
struct Words {
    std::string name = word(), id = word(), password = word(), token = word();
    std::array<std::string, 4> all() const { return {name, id, password, token}; }
    bool isIn(std::string_view text) const {
        for (const std::string &each : all())
            if (text.find(each) != std::string_view::npos)
                return true;
        return false;
    }

private:
    static std::string word() {
        static std::random_device random;
        std::string text = "Q";
        for (int n = 0; n < 15; ++n)
            text += char('A' + random() % 26);
        return text;
    }
};

// Looks at all processes until it is destroyed.
class Watch {
public:
    explicit Watch(const Words &words)
        : m_words(words), m_thread([this](const std::stop_token &stop) {
              while (!stop.stop_requested())
                  look();
          }) {}
    /// Where one of the words was seen.
    std::set<std::string> end() {
        m_thread.request_stop();
        m_thread.join();
        return m_places;
    }
    /// The number of looks at a network helper.
    int helpers() const { return m_helpers; }

private:
    void look() {
        for (const ProcessEntry &entry : processes()) {
            if (m_words.isIn(textOfProcess(entry.pid, "cmdline")))
                m_places.insert("the arguments of " + entry.name);
            if (entry.name != "pellucid-net" || entry.parent != ::getpid())
                continue;
            ++m_helpers;
            if (m_words.isIn(textOfProcess(entry.pid, "environ")))
                m_places.insert("the environment of " + entry.name);
        }
    }

    const Words &m_words;
    std::set<std::string> m_places;
    std::atomic<int> m_helpers = 0;
    std::jthread m_thread;
};

std::mutex logMutex;
std::string logText;

// The sink stays until the program ends.
void keepLog() {
    system::setLogSink([](const std::string &line) {
        const std::lock_guard lock(logMutex);
        logText += line + "\n";
    });
}

// A study of small objects.
void writeStudy(const fs::path &folder, const Words &words, const std::string &study, int objects) {
    fs::create_directories(folder);
    for (int n = 0; n < objects; ++n) {
        DicomWriter writer;
        writer.put({0x0008, 0x0016}, "UI", "1.2.840.10008.5.1.4.1.1.7");
        writer.put({0x0008, 0x0018}, "UI", study + ".1." + std::to_string(n + 1));
        writer.put({0x0008, 0x0020}, "DA", "20260101");
        writer.put({0x0008, 0x0060}, "CS", "OT");
        writer.put({0x0010, 0x0010}, "PN", words.name + "^" + words.name);
        writer.put({0x0010, 0x0020}, "LO", words.id);
        writer.put({0x0020, 0x000d}, "UI", study);
        writer.put({0x0020, 0x000e}, "UI", study + ".1");
        writer.put({0x0020, 0x0013}, "IS", std::to_string(n + 1));
        writer.write(folder / ("object" + std::to_string(n)));
    }
}

} // namespace

TEST_F(Pacs, NeitherPatientsNorSecretsShowOutside) {
    if (!isInstalled("storescu"))
        GTEST_SKIP() << "storescu is not installed";
    keepLog();
    const Words words;
    const std::string study = "1.2.826.0.1.3680043.8.498.66";
    const fs::path sent = m_folder / "sent";
    constexpr int objects = 12;
    writeStudy(sent, words, study, objects);
    const std::string data = (m_folder / "data").string();
    fs::create_directories(data);
    ::setenv("XDG_DATA_HOME", data.c_str(), 1);

    Dcmqrscp dcmqrscp;
    Proxy proxy(dcmqrscp.port());
    proxy.set({.delayMs = 5}); // long enough to look at the helpers
    archive::Server server = serverAt(proxy.port(), "COMMON");
    server.peer.authentication = network::Authentication::basic;
    server.peer.user = "reader";
    server.peer.secret = words.password;
    auto list = archive::ServerList::ofUser();
    list.put(server);
    std::string authorization; // as the web server gets it
    HttpServer refusing([&](const HttpRequest &request) {
        authorization = request.header("authorization");
        return HttpAnswer{401, "text/plain", "", ""};
    });
    archive::Server web{"web", archive::webPeer(refusing.url() + "/dicom-web")};
    web.peer.authentication = network::Authentication::bearer;
    web.peer.secret = words.token;
    list.put(web);

    Watch watch(words);
    put(server, sent);
    // By name, and by the ID.
    EXPECT_EQ(archive::search({server}, {.patientName = words.name + "*"}).entries.size(), 1U);
    EXPECT_EQ(archive::search({server}, {.patientId = words.id}).entries.size(), 1U);
    const auto refused = archive::search({web}, {.patientName = words.name});
    ASSERT_TRUE(refused.outcomes.at(0).failure.has_value());
    EXPECT_TRUE(refused.outcomes[0].failure->is(because::serverDoesNotAcceptTheLogin))
        << refused.outcomes[0].failure->english();
    EXPECT_FALSE(words.isIn(refused.outcomes[0].failure->english()));
    // A retrieval for the library, as the workstation does it.
    const fs::path log = archive::TransferLog::fileOfUser();
    archive::TransferLog transfers(log);
    archive::Transfer transfer;
    transfer.server = server.name;
    transfer.wanted = {study, {}};
    transfer.title = "2026-01-01 OT";
    transfer.folder = archive::libraryObjectFolder();
    EXPECT_TRUE(archive::runTransfer(transfers, transfers.add(transfer), server).isComplete());
    // The same objects are received in another folder.
    const archive::ObjectFolder received(m_folder / "received",
                                         archive::ObjectFolder::Durability::synced);
    fs::create_directories(received.folder());
    archive::TransferLog arrivals(log);
    archive::Receiving receiving(received, &arrivals);
    {
        archive::ListenerOptions options;
        options.port = 0;
        options.acceptsAnyone = true;
        const archive::Listener listener(options, [&] { return receiving.receiver(); });
        const auto result = run("storescu -R -aec PELLUCID +sd 127.0.0.1 " +
                                std::to_string(listener.port()) + " '" + sent.string() + "'");
        EXPECT_EQ(result.exitCode, 0) << result.error;
    }
    EXPECT_EQ(watch.end(), std::set<std::string>());
    EXPECT_GT(watch.helpers(), 5);
    ::unsetenv("XDG_DATA_HOME");

    // All of this was used: the servers got it, and the objects contain it.
    EXPECT_NE(proxy.fromProgram().find(words.password), std::string::npos);
    EXPECT_GT(refusing.requestCount(), 0U);
    EXPECT_NE(authorization.find(words.token), std::string::npos);
    EXPECT_EQ(dataSetsIn(received.folder()), dataSetsIn(sent));
    EXPECT_EQ(dataSetsIn(transfer.folder), dataSetsIn(sent));
    EXPECT_TRUE(words.isIn(readText(filesIn(received.folder()).front())));

    // Names of files and folders.
    for (const auto &entry : fs::recursive_directory_iterator(m_folder.path()))
        EXPECT_FALSE(words.isIn(entry.path().string())) << entry.path();
    for (const auto &entry : fs::directory_iterator(fs::temp_directory_path()))
        EXPECT_FALSE(words.isIn(entry.path().string())) << entry.path();
    // Files beside the objects: the list of servers, the database and its journal.
    std::size_t others = 0;
    for (const fs::path &file : filesIn(data)) {
        if (file.extension() == ".dcm")
            continue;
        ++others;
        EXPECT_FALSE(words.isIn(readText(file))) << file;
    }
    EXPECT_GE(others, 2U);
    EXPECT_EQ(transfers.arrivals().size(), 2U * objects);
    const std::lock_guard lock(logMutex);
    EXPECT_FALSE(words.isIn(logText)) << logText;
}

// The command line refuses it on adding and, of a list that says nothing about it, on use, before
// it asks for the password.
TEST_F(PacsScripted, APasswordIsSentWithoutTlsOnlyIfTheUserAllowsIt) {
    const char *const cli = std::getenv("PELLUCID_CLI");
    if (cli == nullptr)
        GTEST_SKIP() << "PELLUCID_CLI is not set";
    // Without a terminal.
    const std::string command =
        "XDG_DATA_HOME='" + m_folder.path().string() + "' setsid -w '" + std::string(cli) + "' ";
    const std::string add = command + "server add s --web http://192.0.2.1/dicom-web "
                                      "--authentication basic --user eva";
    const auto refused = run(add);
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_NE(refused.error.find("--allow-insecure-login"), std::string::npos) << refused.error;
    EXPECT_EQ(run(command + "server list").out, "");
    EXPECT_EQ(run(add + " --allow-insecure-login").exitCode, 0);
    EXPECT_NE(run(command + "server list").out.find("insecure login allowed"), std::string::npos);
    const auto asked = run(command + "echo s");
    EXPECT_NE(asked.error.find(task::Reason(because::passwordNeedsATerminal).english()),
              std::string::npos)
        << asked.error;
    const fs::path list = m_folder / "pellucid" / "servers.json";
    std::string text = readText(list);
    const std::string consent = "\"allow_insecure_login\": true,";
    ASSERT_NE(text.find(consent), std::string::npos) << text;
    writeText(list, text.erase(text.find(consent), consent.size()));
    const auto used = run(command + "echo s");
    EXPECT_EQ(used.exitCode, 2);
    EXPECT_NE(used.error.find("--allow-insecure-login"), std::string::npos) << used.error;
}

} // namespace pellucid
