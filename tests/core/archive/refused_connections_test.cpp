// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/refused_connections.h"
#include "core/network/client/reasons.h"
#include "core/network/process/reasons.h"

#include <gtest/gtest.h>

#include <string>

namespace pellucid::archive {

namespace because = task::because;
using Clock = RefusedConnections::Clock;
using std::chrono::minutes;
using std::chrono::seconds;

TEST(RefusedConnections, TheFirstOfAnAddressAndAKindIsReportedTheOthersAreCounted) {
    RefusedConnections refused;
    const Clock::time_point begin = Clock::now();
    EXPECT_TRUE(refused.isNew("10.0.0.1", because::senderIsUnknown("10.0.0.1"), begin));
    EXPECT_FALSE(refused.summary(begin + minutes(2)).has_value());
    for (int n = 0; n < 1000; ++n) // with AE titles that nobody repeats
        EXPECT_FALSE(refused.isNew("10.0.0.1", because::senderIsUnknown("A" + std::to_string(n)),
                                   begin + seconds(1)));
    EXPECT_TRUE(refused.isNew("10.0.0.1", because::tlsIsNotAnswered, begin + seconds(1)));
    EXPECT_FALSE(refused.summary(begin + seconds(59)).has_value());
    const auto summary = refused.summary(begin + seconds(62));
    ASSERT_TRUE(summary.has_value());
    EXPECT_EQ(summary->english(), "more refused connections from 10.0.0.1: 1000");
    EXPECT_FALSE(refused.summary(begin + minutes(5)).has_value());
}

// Of many addresses, only the first are told apart.
TEST(RefusedConnections, ManyAddressesMakeFewLines) {
    RefusedConnections refused;
    const Clock::time_point begin = Clock::now();
    int reported = 0;
    for (int n = 0; n < 10000; ++n) {
        const std::string address =
            "10.0." + std::to_string(n / 250) + "." + std::to_string(n % 250);
        reported += refused.isNew(address, because::senderIsUnknown(address), begin) ? 1 : 0;
    }
    EXPECT_EQ(reported, 64);
    const auto summary = refused.summary(begin + minutes(1));
    ASSERT_TRUE(summary.has_value());
    EXPECT_EQ(summary->english(), "more refused connections from several addresses: 9936");
    // An address that has been quiet makes room, and is reported again.
    EXPECT_TRUE(refused.isNew("10.0.0.0", because::senderIsUnknown("x"), begin + minutes(61)));
    EXPECT_TRUE(refused.isNew("10.9.9.9", because::senderIsUnknown("x"), begin + minutes(61)));
}

} // namespace pellucid::archive
