// SPDX-License-Identifier: GPL-3.0-or-later
// The list of servers, and what is refused before any server is asked.
#include "tests/cli/cli.h"

#include <nlohmann/json.hpp>

#include "tests/network/servers.h"

namespace pellucid {

namespace {

using namespace test;

class CliServers : public Cli {
protected:
    CommandResult own(const std::string &arguments) {
        return cli(arguments, "XDG_DATA_HOME=" + quoted(folder / "data"));
    }
    void add(const std::string &arguments) {
        const auto r = own("server add " + arguments);
        ASSERT_EQ(r.exitCode, 0) << r.error;
    }
};

} // namespace

TEST_F(CliServers, TheListShowsWhatDiffersFromTheDefault) {
    std::ofstream(folder / "ca.pem") << "-";
    std::string authorities = (folder / "ca.pem").string();
    if (programOfAnotherSystem() != nullptr) {
        std::ranges::replace(authorities, '/', '\\');
        authorities = "Z:" + authorities;
    }
    add("plain --dicom PLAIN@127.0.0.1:104");
    add("other --dicom OTHER@127.0.0.1:11113 --tls on --calling-ae ME --retrieve move "
        "--connections 1 --limit 0 --uncompress --character-set 'ISO_IR 100' --authorities " +
        quoted(folder / "ca.pem"));
    add("web --web https://127.0.0.1/dicom-web --authentication basic --user eva");
    const auto lines = own("server list");
    EXPECT_EQ(lines.exitCode, 0);
    EXPECT_EQ(lines.out,
              "plain                 PLAIN@127.0.0.1:104\n"
              "other                 OTHER@127.0.0.1:11113  TLS  calling AE ME  retrieve move  "
              "1 connection  no limit  uncompress  character set ISO_IR 100  authorities " +
                  authorities +
                  "\nweb                   https://127.0.0.1/dicom-web  authentication basic  "
                  "user eva\n");
    const auto json = nlohmann::json::parse(own("server list --json").out);
    ASSERT_EQ(json.size(), 3U);
    const nlohmann::json plain{{"name", "plain"},
                               {"address", "PLAIN@127.0.0.1:104"},
                               {"tls", false},
                               {"calling_ae", "PELLUCID"},
                               {"retrieve", "automatic"},
                               {"sends_from", nlohmann::json::array()},
                               {"connections", 4},
                               {"limit", 200},
                               {"uncompress", false},
                               {"character_set", ""},
                               {"authentication", "none"},
                               {"allow_insecure_login", false},
                               {"user", ""},
                               {"login",
                                {{"issuer", ""},
                                 {"authorization_url", ""},
                                 {"token_url", ""},
                                 {"client_id", ""},
                                 {"scope", ""}}},
                               {"authorities", ""},
                               {"certificate", ""},
                               {"key", ""}};
    EXPECT_EQ(json[0], plain);
    EXPECT_EQ(json[1]["retrieve"], "move");
    EXPECT_EQ(json[1]["limit"], 0);
    EXPECT_EQ(json[1]["uncompress"], true);
    EXPECT_EQ(json[2]["authentication"], "basic");
    EXPECT_EQ(json[2]["user"], "eva");
}

TEST_F(CliServers, OptionsOfTheOtherKindOfServerAreRefused) {
    for (const char *option : {"--tls on", "--tls off", "--uncompress", "--retrieve get",
                               "--calling-ae ME", "--character-set 'ISO_IR 100'"}) {
        const std::string name = std::string(option).substr(0, std::string(option).find(' '));
        expectOneLine(own(std::string("server add s --web http://127.0.0.1/ ") + option), 2, name);
    }
    for (const char *option :
         {"--issuer https://a", "--authorization-url https://a", "--token-url https://a",
          "--client-id x", "--scope x", "--authentication bearer"}) {
        const std::string name = std::string(option).substr(0, std::string(option).find(' '));
        expectOneLine(own(std::string("server add s --dicom A@127.0.0.1 ") + option), 2, name);
    }
    expectOneLine(own("server add s --dicom A@127.0.0.1 --authentication oauth"), 2, "DICOMweb");
    EXPECT_EQ(own("server list").out, "");
}

TEST_F(CliServers, ASearchThatMakesNoSenseIsRefused) {
    add("s --dicom A@127.0.0.1:" + std::to_string(freePort()));
    expectOneLine(own("find s --date 20261399"), 2, "'20261399' is not a calendar date");
    expectOneLine(own("find s --date 20260102-20260101"), 2, "ends before it begins");
    if (programOfAnotherSystem() == nullptr) // Windows has Unicode arguments alone
        expectOneLine(own("find s --name \"$(printf 'M\\374ller')\""), 2, "UTF-8");
    expectOneLine(own("find s --level series --study 1.2 --name A"), 2,
                  "--name does not apply to a search at the level 'series'");
    expectOneLine(own("find s --series 1.2"), 2,
                  "--series does not apply to a search at the level 'study'");
    expectOneLine(own("get s --study 1.2 --series soft"), 2, "'soft'");
    expectOneLine(own("render --from s --study 1.2 --series soft -o " + quoted(folder / "o.png")),
                  2, "'soft'");
    EXPECT_EQ(own("transfers list").out, "");
}

// The port of another receiver: what to do is said, and the exit code is not that of a mistake.
TEST_F(CliServers, APortInUseIsNamed) {
    int port = 0;
    const int taken = listenOn(port);
    const auto r =
        own("listen --any --to " + quoted(folder / "in") + " --port " + std::to_string(port));
    ::close(taken);
    expectOneLine(r, 6, "port " + std::to_string(port) + " is in use");
    EXPECT_NE(r.error.find("--port"), std::string::npos) << r.error;
}

} // namespace pellucid
