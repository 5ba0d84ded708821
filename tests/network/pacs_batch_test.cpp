// SPDX-License-Identifier: GPL-3.0-or-later
// Batches from and to real servers, and in Orthanc when a series has arrived.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

#include "core/archive/instance_list.h"
#include "core/archive/search.h"
#include "core/network/client/query.h"
#include "tests/network/pacs.h"
#include "tests/network/processes.h"
#include "tests/support/command.h"

namespace pellucid {

using namespace test;
namespace tag = network::tag;

namespace {

constexpr const char *twoOutputs = R"({"recipe": 1, "series": {"modality": "CT"}, "outputs": [
    {"name": "front", "format": "dicom", "view": "front", "size": 64},
    {"name": "left", "format": "npy", "view": "left", "size": 64}]})";
constexpr const char *onePicture = R"({"recipe": 1, "outputs": [
    {"name": "front", "format": "dicom", "view": "front", "size": 64}]})";
// What PS3.4, C.4.3 calls C-GET of the Study Root; a program has to name it to retrieve.
constexpr const char *getClass = "1.2.840.10008.5.1.4.1.2.2.3";

} // namespace

class PacsBatch : public Pacs {
protected:
    void SetUp() override {
        Pacs::SetUp();
        if (IsSkipped())
            return;
        const char *const cli = std::getenv("PELLUCID_CLI");
        if (cli == nullptr)
            GTEST_SKIP() << "PELLUCID_CLI is not set";
        m_cli = cli;
        ::setenv("XDG_DATA_HOME", (m_folder / "data").c_str(), 1);
        ::setenv("XDG_CACHE_HOME", (m_folder / "cache").c_str(), 1);
    }
    void TearDown() override {
        ::unsetenv("XDG_DATA_HOME");
        ::unsetenv("XDG_CACHE_HOME");
    }

    CommandResult cli(const std::string &arguments) const {
        return run("'" + m_cli + "' " + arguments);
    }
    fs::path recipe(const std::string &text) const {
        const fs::path file = m_folder / "recipe.json";
        writeText(file, text);
        return file;
    }
    CommandResult batch(const fs::path &recipe, const std::string &arguments) const {
        return cli("batch '" + recipe.string() + "' --json " + arguments);
    }
    void add(const std::string &name, const std::string &ae, int port) const {
        const CommandResult added =
            cli("server add " + name + " --dicom " + ae + "@127.0.0.1:" + std::to_string(port));
        ASSERT_EQ(added.exitCode, 0) << added.error;
    }

    /// The UIDs of a study's series of a modality.
    static std::vector<std::string>
    seriesOf(const archive::Server &server, const std::string &study, const std::string &modality) {
        archive::SearchTerms terms;
        terms.studyUid = study;
        terms.level = network::Level::series;
        std::vector<std::string> uids;
        for (const archive::FoundEntry &entry : archive::search({server}, terms).entries)
            if (entry.text(tag::modality) == modality)
                uids.push_back(entry.text(tag::seriesUid));
        return uids;
    }
    /// The pictures that a server has of a study.
    static std::vector<std::string> picturesOf(const archive::Server &server,
                                               const std::string &study) {
        return seriesOf(server, study, "OT");
    }
    static bool waitFor(const std::function<bool()> &condition) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (!condition()) {
            if (std::chrono::steady_clock::now() > end)
                return false;
            ::usleep(50000);
        }
        return true;
    }

    /// A record, without what differs between files and a server, and between runs.
    static std::string comparable(const fs::path &done) {
        std::istringstream in(readText(done));
        std::string text;
        for (std::string line; std::getline(in, line);)
            if (line.find("\"inputs\"") == std::string::npos &&
                line.find("\"load\"") == std::string::npos &&
                line.find("\"render\"") == std::string::npos)
                text += line + "\n";
        return text;
    }
    static void expectSameResults(const fs::path &here, const fs::path &there) {
        const std::vector<fs::path> files = filesIn(here);
        EXPECT_FALSE(files.empty());
        EXPECT_EQ(filesIn(there).size(), files.size());
        for (const fs::path &file : files) {
            const fs::path other = there / fs::relative(file, here);
            if (file.filename() == "done.json")
                EXPECT_EQ(comparable(other), comparable(file)) << other;
            else
                EXPECT_TRUE(readText(other) == readText(file)) << other << " differs";
        }
    }

    std::string m_cli;
};

TEST_F(PacsBatch, AStudyOfAServerIsRenderedAsItsFilesAre) {
    Dcmqrscp dcmqrscp;
    put(serverAt(dcmqrscp.port(), "COMMON"), series("A", 12));
    Proxy proxy(dcmqrscp.port());
    add("s", "COMMON", proxy.port());
    const fs::path by = recipe(twoOutputs), here = m_folder / "here", there = m_folder / "there";
    const CommandResult local =
        batch(by, "'" + (m_folder / "A").string() + "' --out '" + here.string() + "'");
    ASSERT_EQ(local.exitCode, 0) << local.error;
    const std::string from = "--from s --find modality=CT --out '" + there.string() + "'";
    const CommandResult remote = batch(by, from);
    ASSERT_EQ(remote.exitCode, 0) << remote.error;
    expectSameResults(here, there);
    EXPECT_EQ(filesIn(m_folder / "cache" / "pellucid" / "sessions").size(), 0U);
    // The second time, the server is only asked whether anything has changed.
    const std::size_t before = proxy.fromProgram().size();
    EXPECT_NE(proxy.fromProgram().find(getClass), std::string::npos);
    const CommandResult again = batch(by, from + " --resume");
    EXPECT_EQ(again.exitCode, 0) << again.error;
    EXPECT_NE(again.out.find("\"skipped\": 1"), std::string::npos) << again.out;
    EXPECT_GT(proxy.fromProgram().size(), before);
    EXPECT_EQ(proxy.fromProgram().find(getClass, before), std::string::npos);
}

// One series of a study, by its UID; a series of another modality than the recipe's is not used.
TEST_F(PacsBatch, ASeriesIsChosenByItsUid) {
    Dcmqrscp dcmqrscp;
    const archive::Server server = serverAt(dcmqrscp.port(), "COMMON");
    const fs::path sent = series("B", 8);
    put(server, sent);
    const std::string study = studyIn(sent);
    // A second series of the study, with more slices.
    const fs::path more = series("C", 12);
    std::string files;
    for (const fs::path &file : filesIn(more))
        files += " '" + file.string() + "'";
    ASSERT_EQ(run("dcmodify -nb -q -m '(0020,000d)=" + study + "' -m '(0010,0010)=Test^B' " +
                  "-m '(0010,0020)=ID-B'" + files)
                  .exitCode,
              0);
    put(server, more);
    add("s", "COMMON", dcmqrscp.port());
    const std::vector<std::string> both = seriesOf(server, study, "CT");
    ASSERT_EQ(both.size(), 2U);
    const fs::path by = recipe(onePicture);
    const std::string out = " --out '" + (m_folder / "out").string() + "'";
    for (const std::string &uid : both) {
        const CommandResult rendered =
            batch(by, "--from s --find study=" + study + " series=" + uid + out);
        EXPECT_EQ(rendered.exitCode, 0) << rendered.error;
        EXPECT_NE(readText(m_folder / "out" / uid / "done.json").find(uid), std::string::npos);
    }
    // Two series of one study are two results.
    EXPECT_TRUE(fs::exists(m_folder / "out" / both[0] / "done.json"));
    EXPECT_EQ(batch(by, "--from s --find study=" + study + " series=1.2.3" + out).exitCode, 7);
    // A series needs its study, and a UID is one.
    EXPECT_EQ(batch(by, "--from s --find series=" + both[0] + out).exitCode, 2);
    EXPECT_EQ(batch(by, "--from s --find study=" + study + " series=x" + out).exitCode, 2);
    const fs::path other =
        recipe(R"({"recipe": 1, "series": {"modality": "MR"}, "outputs": [{"view": "front"}]})");
    const CommandResult none =
        batch(other, "--from s --find study=" + study + " series=" + both[0] + out);
    EXPECT_EQ(none.exitCode, 0) << none.error; // the recipe does not ask for it
    EXPECT_NE(none.out.find("\"without_such_a_series\": [\n"), std::string::npos) << none.out;
}

// A server that does not tell the kinds of its objects gives back what a batch has sent to it.
TEST_F(PacsBatch, AMultiFrameCaptureComesBack) {
    Dcmqrscp dcmqrscp;
    const archive::Server server = serverAt(dcmqrscp.port(), "COMMON");
    const fs::path sent = series("E", 8);
    put(server, sent);
    const std::string study = studyIn(sent);
    add("s", "COMMON", dcmqrscp.port());
    const fs::path by = recipe(R"({"recipe": 1, "series": {"modality": "CT"}, "outputs": [
        {"name": "grey", "turntable": 3, "size": 32, "format": "dicom-loop"},
        {"name": "color", "turntable": 3, "size": 32, "format": "dicom-loop",
         "look": "Bone over soft tissue"}]})");
    ASSERT_EQ(batch(by, "--from s --find study=" + study + " --send s").exitCode, 0);
    ASSERT_EQ(picturesOf(server, study).size(), 2U);
    const archive::RetrievalReport report = archive::retrieve(
        server, {study, {}},
        archive::ObjectFolder(m_folder / "back", archive::ObjectFolder::Durability::cached));
    EXPECT_TRUE(report.isComplete()) << report.missing.front().reason.english();
    EXPECT_EQ(report.state.received, 10U);
}

// The UIDs of the pictures depend on the images and the recipe: what is sent again is there once.
TEST_F(PacsBatch, PicturesThatAreSentAgainAreThereOnce) {
    Dcmqrscp dcmqrscp;
    const archive::Server server = serverAt(dcmqrscp.port(), "COMMON");
    const fs::path sent = series("D", 8);
    put(server, sent);
    const std::string study = studyIn(sent);
    add("s", "COMMON", dcmqrscp.port());
    // The second recipe asks for no modality, but pictures of earlier runs are no images of the
    // study.
    std::size_t pictures = 0;
    for (const char *const text : {twoOutputs, onePicture}) {
        const fs::path by = recipe(text);
        ++pictures;
        for (const std::string how : {"", "", " --resume", " --resume"}) {
            const CommandResult made =
                batch(by, "--from s --find study=" + study + " --send s" + how);
            EXPECT_EQ(made.exitCode, 0) << made.error;
            EXPECT_EQ(made.out.find("\"skipped\": 1") != std::string::npos, how != "") << made.out;
            const std::vector<std::string> uids = picturesOf(server, study);
            EXPECT_EQ(uids.size(), pictures);
            EXPECT_EQ(archive::listInstances(server, {study, uids}).instances.size(), pictures);
        }
        // Files in a folder are the same images.
        EXPECT_EQ(batch(by, "'" + sent.string() + "' --send s").exitCode, 0);
        EXPECT_EQ(picturesOf(server, study).size(), pictures);
    }
    // A server that is not there is noticed before anything is rendered, and gets it later.
    add("gone", "COMMON", freePort());
    const fs::path by = recipe(twoOutputs);
    const CommandResult lost = batch(by, "--from s --find study=" + study + " --send gone");
    EXPECT_EQ(lost.exitCode, 6) << lost.error;
    EXPECT_EQ(lost.out, "");
    Dcmqrscp other;
    add("gone", "COMMON", other.port());
    EXPECT_EQ(batch(by, "--from s --find study=" + study + " --send gone --resume").exitCode, 0);
    EXPECT_EQ(picturesOf(serverAt(other.port(), "COMMON"), study).size(), 1U);
}

// Each connection breaks before the server has sent a large image: the study with large images
// fails and is listed, the others are done, and the next run does what is missing.
TEST_F(PacsBatch, AServerThatBreaksOffCostsTheStudiesThatItDoesNotSend) {
    Dcmqrscp dcmqrscp;
    const archive::Server server = serverAt(dcmqrscp.port(), "COMMON");
    constexpr long bytesOfLarge = 2L * 128 * 128;
    const fs::path large = series("large", 4, 128);
    put(server, large);
    for (const std::string name : {"E", "F"})
        put(server, series(name, 4, 24));
    Proxy proxy(dcmqrscp.port());
    proxy.set({.cutAfter = bytesOfLarge - 1});
    add("s", "COMMON", proxy.port());
    const fs::path by = recipe(twoOutputs), out = m_folder / "out";
    const std::string from = "--from s --find modality=CT --out '" + out.string() + "'";
    const CommandResult broken = batch(by, from);
    EXPECT_EQ(broken.exitCode, 7) << broken.error;
    EXPECT_NE(broken.out.find("\"done\": 2"), std::string::npos) << broken.out;
    EXPECT_NE(broken.out.find(studyIn(large)), std::string::npos) << broken.out;
    for (const std::string name : {"large", "E", "F"})
        EXPECT_EQ(fs::exists(out / studyIn(m_folder / name) / "done.json"), name != "large");
    proxy.set({});
    const CommandResult rest = batch(by, from + " --resume");
    EXPECT_EQ(rest.exitCode, 0) << rest.error;
    EXPECT_NE(rest.out.find("\"done\": 1"), std::string::npos) << rest.out;
    EXPECT_NE(rest.out.find("\"skipped\": 2"), std::string::npos) << rest.out;
    EXPECT_TRUE(fs::exists(out / studyIn(large) / "done.json"));
    // A server that does not answer at all has no studies to list.
    add("gone", "COMMON", freePort());
    EXPECT_EQ(batch(by, "--from gone --out '" + out.string() + "'").exitCode, 6);
}

// Orthanc runs packaging/orthanc/pellucid.lua for each series that has arrived.
class PacsBatchInOrthanc : public PacsBatch {
protected:
    void SetUp() override {
        PacsBatch::SetUp();
        if (IsSkipped())
            return;
        for (const std::string program : {"Orthanc", "bash", "flock"})
            if (!isInstalled(program))
                GTEST_SKIP() << program << " is not installed";
        // Tells when it runs. Its name and that of the recipe need to be quoted.
        const fs::path program = this->program();
        const std::string log = " >>'" + calls().string() + "'\n";
        writeText(program,
                  "#!/bin/sh\necho begin" + log + "'" + m_cli + "' \"$@\"\necho end $?" + log);
        fs::permissions(program, fs::perms::owner_all);
        m_recipe = m_folder / "the recipe's $HOME.json";
        writeText(m_recipe, onePicture);
        m_orthanc = std::make_unique<Orthanc>(
            R"(, "StableAge": 1, "LuaScripts": [")" PELLUCID_SOURCE
            R"(/packaging/orthanc/pellucid.lua"], "Pellucid": {"Server": "orthanc", "Recipe": ")" +
            m_recipe.string() + R"(", "Queue": ")" + queue().string() + R"(", "Program": ")" +
            program.string() + "\"}");
        m_server = serverAt(m_orthanc->port(), "ORTHANC");
        add("orthanc", "ORTHANC", m_orthanc->port());
    }

    fs::path program() const { return m_folder / "pellucid's cli"; }
    fs::path calls() const { return m_folder / "calls"; }
    /// Where series wait.
    fs::path queue() const { return m_folder / "queue's"; }
    std::size_t waiting() const {
        std::error_code none;
        const fs::directory_iterator each(queue(), none);
        return std::size_t(std::distance(begin(each), end(each)));
    }
    /// Waits until the program has run so many times, each after the end of the one before.
    void expectCalls(int count) const {
        std::string expected;
        for (int n = 0; n < count; ++n)
            expected += "begin\nend 0\n";
        waitFor([&] { return readText(calls()).size() >= expected.size(); });
        EXPECT_EQ(readText(calls()), expected);
    }

    fs::path m_recipe;
    std::unique_ptr<Orthanc> m_orthanc;
    archive::Server m_server;
};

TEST_F(PacsBatchInOrthanc, EachSeriesThatArrivesIsRenderedOnce) {
    std::vector<std::string> studies;
    const auto arrives = [&](const std::string &name) {
        const fs::path sent = series(name, 12);
        put(m_server, sent);
        const std::string study = studyIn(sent);
        const auto begin = std::chrono::steady_clock::now();
        EXPECT_TRUE(waitFor([&] { return !picturesOf(m_server, study).empty(); })) << name;
        std::cout << "from the last image to its picture: "
                  << std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()
                  << " s, of which 1 s of waiting for more\n";
        studies.push_back(study);
    };
    arrives("A");
    // The picture is an object of the study: that which a batch of the files makes.
    const fs::path out = m_folder / "out";
    const CommandResult local = batch(recipe(onePicture), "'" + (m_folder / "A").string() +
                                                              "' --out '" + out.string() + "'");
    ASSERT_EQ(local.exitCode, 0) << local.error;
    const archive::ObjectFolder folder(m_folder / "got", archive::ObjectFolder::Durability::cached);
    const archive::Wanted pictures{studies[0], picturesOf(m_server, studies[0])};
    ASSERT_TRUE(archive::retrieve(m_server, pictures, folder).isComplete());
    ASSERT_EQ(filesIn(m_folder / "got").size(), 1U);
    EXPECT_TRUE(dataSetOf(filesIn(m_folder / "got").front()) ==
                dataSetOf(out / studies[0] / "front.dcm"));
    EXPECT_EQ(studyIn(m_folder / "got"), studies[0]);
    // A UID that is a command of the shell is not run.
    const fs::path evil = series("E", 1);
    ASSERT_EQ(run("dcmodify -nb -q -m \"(0020,000e)=1';touch " + (m_folder / "x").string() +
                  ";'\" '" + filesIn(evil).front().string() + "'")
                  .exitCode,
              0);
    ASSERT_EQ(run("storescu -aec ORTHANC 127.0.0.1 " + std::to_string(m_orthanc->port()) + " '" +
                  filesIn(evil).front().string() + "'")
                  .exitCode,
              0);
    // A picture is a series that arrives, too. When two more series have been rendered, Orthanc has
    // long told of it.
    arrives("B");
    arrives("C");
    EXPECT_FALSE(fs::exists(m_folder / "x"));
    expectCalls(3);
    for (const std::string &study : studies) {
        EXPECT_EQ(picturesOf(m_server, study).size(), 1U);
        EXPECT_EQ(seriesOf(m_server, study, "CT").size(), 1U);
    }
}

// Series that arrive together are rendered one after the other, and none is forgotten.
TEST_F(PacsBatchInOrthanc, SeriesThatArriveTogetherWaitForEachOther) {
    std::vector<std::string> studies;
    for (const std::string name : {"A", "B", "C"})
        studies.push_back(studyIn(series(name, 8)));
    for (const std::string name : {"A", "B", "C"})
        put(m_server, m_folder / name);
    for (const std::string &study : studies)
        EXPECT_TRUE(waitFor([&] { return picturesOf(m_server, study).size() == 1; }));
    expectCalls(3);
}

// However many arrive, one process works; what cannot be rendered now waits.
TEST_F(PacsBatchInOrthanc, ManySeriesWaitAsFiles) {
    constexpr std::size_t many = 50;
    const auto become = [this](const std::string &code) {
        const fs::path text = m_folder / "program";
        writeText(text, "#!/bin/sh\n" + code + "\n");
        fs::permissions(text, fs::perms::owner_all);
        fs::rename(text, program());
    };
    const std::string log = ">>'" + calls().string() + "'\n",
                      gate = "'" + (m_folder / "go").string();
    const auto sent = [&](std::size_t n) {
        const fs::path folder = series(std::to_string(n), 1, 8);
        put(m_server, folder);
        return dicom::scan({folder}).patients.at(0).studies.at(0).series.at(0).uid;
    };
    // Out of order: the server cannot be reached.
    become("echo failed " + log + "exit 6");
    std::vector<std::string> uids{sent(0)};
    EXPECT_TRUE(waitFor([&] { return fs::exists(calls()); }));
    EXPECT_EQ(waiting(), 1U);
    become("while [ -e \"$0\" ] && [ ! -e " + gate + "' ]; do sleep 0.02; done\necho $7 " + log);
    for (std::size_t n = 1; n < many; ++n)
        uids.push_back(sent(n));
    EXPECT_TRUE(waitFor([&] { return waiting() == many; })) << waiting();
    // All processes of the script name the recipe.
    std::size_t processCount = 0;
    EXPECT_TRUE(waitFor([&] {
        const auto all = processes();
        processCount = std::size_t(std::count_if(all.begin(), all.end(), [&](const auto &entry) {
            return textOfProcess(entry.pid, "cmdline").find(m_recipe.string()) != std::string::npos;
        }));
        return processCount <= 2; // the queue's and the program
    })) << processCount;
    writeText(m_folder / "go", "");
    EXPECT_TRUE(waitFor([&] { return waiting() == 0; })) << waiting();
    std::istringstream called(readText(calls()));
    std::multiset<std::string> rendered, expected{"failed"};
    for (std::string line; std::getline(called, line);)
        rendered.insert(line);
    for (const std::string &uid : uids)
        expected.insert("series=" + uid);
    EXPECT_EQ(rendered, expected);
}

} // namespace pellucid
