// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/client/message.h"

#include <gtest/gtest.h>

#include <random>

#include "core/task/error.h"
#include "tests/support/search_seed.h"

namespace pellucid::network {

namespace {

Connection fullConnection() {
    Connection connection;
    connection.peer = {Protocol::web, "host",       8443,   "SERVER",
                       "US",          "/dicom-web", true,   "ca.pem",
                       "our.pem",     "our.key",    "pass", Authentication::bearer,
                       "user",        "token",      true,   "ISO_IR 100",
                       1.0,           2.0,          3.0};
    connection.purpose = Purpose::store;
    connection.sopClasses = {"1.2.3", "1.2.4"};
    connection.encodings = {{"1.2.3", "1.2.840.10008.1.2"}};
    return connection;
}

} // namespace

TEST(NetworkMessage, ValuesSurviveTheJourney) {
    const Connection connection = fullConnection(), back = unpack<Connection>(pack(connection));
    EXPECT_EQ(back.peer, connection.peer);
    EXPECT_EQ(back.purpose, connection.purpose);
    EXPECT_EQ(back.sopClasses, connection.sopClasses);
    EXPECT_EQ(back.encodings, connection.encodings);
    const Acceptance acceptance{"US",      {"A"},     {"host"}, true, "ca.pem",
                                "our.pem", "our.key", "",       3.0};
    EXPECT_EQ(unpack<Acceptance>(pack(acceptance)).clientHosts, acceptance.clientHosts);
    EXPECT_EQ(pack(unpack<Acceptance>(pack(acceptance))), pack(acceptance));
    const Attributes attributes{{tag::patientName, "M\xC3\xBCller^Eva"}, {tag::studyUid, "1.2.3"}};
    EXPECT_EQ(unpack<Attributes>(pack(attributes)), attributes);
    const RetrievalEnd end{3, 2, 1, {"1.2.3", "1.2.4"}};
    EXPECT_EQ(unpack<RetrievalEnd>(pack(end)), end);
    const Arrival arrival{"1.2", "1.2.3", "1.2.840.10008.1.2", "SENDER"};
    EXPECT_EQ(unpack<Arrival>(pack(arrival)).callingAe, "SENDER");
    const Tokens tokens{"access", "refresh", 300};
    EXPECT_EQ(unpack<Tokens>(pack(tokens)), tokens);
    const Endpoints endpoints{"https://h", "https://h/a", "https://h/t"};
    EXPECT_EQ(unpack<Endpoints>(pack(endpoints)), endpoints);
    const TokenRequest request{{"code", "a&b"}, {"grant_type", "authorization_code"}};
    EXPECT_EQ(unpack<TokenRequest>(pack(request)), request);
    EXPECT_EQ(formEncoded(request), "code=a%26b&grant_type=authorization_code");
    EXPECT_EQ(unpack<Redirection>(pack(Redirection{"state", "yes", "no", 5.0})).failureText, "no");
}

// A token becomes part of a header, a code part of a form.
TEST(NetworkMessage, TokensAndCodesAreVisibleAndNotTooLong) {
    for (const std::string &bad :
         {std::string(), std::string("a b"), std::string("a\r\nX: y"), std::string("a\0b", 3),
          std::string("\xc3\xa4"), std::string(longestToken + 1, 'a')}) {
        EXPECT_THROW(unpack<Tokens>(pack(Tokens{bad, "r", 0})), task::Error) << bad;
        EXPECT_THROW(unpackCode(bad), task::Error) << bad;
        EXPECT_THROW(unpack<Endpoints>(pack(Endpoints{"", bad, "t"})), task::Error) << bad;
        if (!bad.empty())
            EXPECT_THROW(unpack<Tokens>(pack(Tokens{"a", bad, 0})), task::Error) << bad;
    }
    EXPECT_EQ(unpackCode("4/P7q7W91a-oMsCeLvIaQm6bTrgtp7"), "4/P7q7W91a-oMsCeLvIaQm6bTrgtp7");
}

// What arrives may become a file name, and is shown: neither a path nor a line break passes.
TEST(NetworkMessage, IdentifiersArePlain) {
    for (const char *const bad :
         {"", "../../etc/passwd", "1.2/3", "1..2", ".1", "1.", "1.2\n",
          "1.2.3.4.5.6.7.8.9.10.11.12.13.14.15.16.17.18.19.20.21.22.23.24.25."
          "26.27"}) {
        EXPECT_FALSE(isUid(bad)) << bad;
        EXPECT_THROW(unpack<Arrival>(pack(Arrival{"1.2", bad, "1.2.3", ""})), task::Error) << bad;
        EXPECT_THROW(unpack<RetrievalEnd>(pack(RetrievalEnd{0, 1, 0, {bad}})), task::Error) << bad;
    }
    EXPECT_TRUE(isUid("1.2.840.10008.5.1.4.1.1.2"));
    EXPECT_EQ(unpack<Attributes>(pack(Attributes{{1, "a\nb\x1b[31m"}})).at(1), "a b [31m");
}

// A compromised helper may send anything: it is refused or taken, but nothing else happens.
TEST(NetworkMessage, AnyBytesAreRefusedOrTaken) {
    std::mt19937 random(test::searchSeed());
    const std::vector<std::string> valid{
        pack(fullConnection()),
        pack(Query{}),
        pack(RetrievalEnd{}),
        pack(Attributes{{1, "a"}, {2, "b"}}),
        pack(Tokens{"access", "refresh", 300}),
        pack(Endpoints{"https://h", "https://h/a", "https://h/t"})};
    for (int n = 0; n < 4000; ++n) {
        std::string bytes = valid[std::size_t(n) % valid.size()];
        for (int change = 0; change < 3 && !bytes.empty(); ++change)
            bytes[random() % bytes.size()] = char(random());
        bytes.resize(random() % (bytes.size() + 1));
        const auto attempt = [&](auto &&unpack) {
            try {
                unpack(bytes);
            } catch (const task::Error &) {
            }
        };
        attempt(unpack<Connection>);
        attempt(unpack<Query>);
        attempt(unpack<QueryEnd>);
        attempt(unpack<RetrievalEnd>);
        attempt(unpack<Arrival>);
        attempt(unpack<Attributes>);
        attempt(unpack<std::vector<std::string>>);
        attempt(unpackReason);
        attempt(unpack<Tokens>);
        attempt(unpack<Endpoints>);
        attempt(unpackCode);
    }
}

} // namespace pellucid::network
