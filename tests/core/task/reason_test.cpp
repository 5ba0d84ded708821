// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/task/reason.h"

#include <cerrno>
#include <cstring>
#include <future>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <gtest/gtest.h>

#include "core/dicom/reasons.h"
#include "core/task/reasons.h"

namespace pellucid::task {

namespace {

// A text that an encoding or a template could mistake for its own syntax.
const std::string awkward = "a; %2 b: 3:\n t1:c %1";

int placesOf(const Sentence &sentence) {
    return placesIn(sentence.english);
}

std::string encodedText(const std::string &text) {
    return " t" + std::to_string(text.size()) + ":" + text;
}

// Any sentence encoded with a nested reason in one place and a text in the others.
std::string encodedOf(const Sentence &sentence, const std::string &text, int nested) {
    std::string encoded(sentence.name);
    for (int n = 0; n < placesOf(sentence); ++n)
        encoded += n == nested ? " r1:isDamagedBy" + encodedText(text) + ";" : encodedText(text);
    return encoded + ";";
}

int countOf(const std::string &part, const std::string &text) {
    int count = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
        ++count;
    return count;
}

// True if the reason and all reasons within it have as many arguments as their templates have
// places.
bool hasItsArguments(const Reason &reason) {
    if (int(reason.arguments().size()) != placesOf(reason.sentence()))
        return false;
    for (const Argument &argument : reason.arguments())
        for (const Reason &within : argument.reasons)
            if (!hasItsArguments(within))
                return false;
    return !reason.sentence().english.empty() && !reason.english().empty();
}

Reason wrapped(int times) {
    Reason reason = because::isEmpty;
    for (int n = 0; n < times; ++n)
        reason = because::imagesOnly(reason);
    return reason;
}

} // namespace

TEST(Reason, everyNameIsGivenOnce) {
    std::set<std::string_view> names;
    for (const Sentence &sentence : allSentences())
        EXPECT_TRUE(names.insert(sentence.name).second) << sentence.name;
    EXPECT_TRUE(names.contains("isDamaged"));
}

TEST(Reason, everySentenceComesThrough) {
    for (const Sentence &sentence : allSentences()) {
        const int places = placesOf(sentence);
        for (int nested = 0; nested <= places; ++nested) { // none in the last round
            const std::string encoded = encodedOf(sentence, awkward, nested);
            const auto reason = Reason::decoded(encoded);
            ASSERT_TRUE(reason) << encoded;
            EXPECT_EQ(reason->sentence().name, sentence.name) << encoded;
            ASSERT_EQ(int(reason->arguments().size()), places) << encoded;
            for (int n = 0; n < places; ++n)
                EXPECT_EQ(reason->arguments()[std::size_t(n)],
                          n == nested ? Argument(because::isDamagedBy(awkward)) : Argument(awkward))
                    << encoded;
            EXPECT_EQ(reason->encoded(), encoded);
            EXPECT_EQ(Reason::decoded(reason->encoded()), reason) << encoded;
        }
    }
}

TEST(Reason, everySentenceIsFilled) {
    for (const Sentence &sentence : allSentences()) {
        const std::string form(sentence.english);
        const int places = placesOf(sentence);
        ASSERT_LE(places, 9) << form;
        int mentioned = 0;
        for (int n = 0; n < places; ++n) {
            const int times = countOf("%" + std::to_string(n + 1), form);
            EXPECT_GT(times, 0) << form; // no place is left out
            mentioned += times;
        }
        for (int nested = 0; nested <= places; ++nested) {
            const auto plain = Reason::decoded(encodedOf(sentence, "text", nested));
            ASSERT_TRUE(plain) << form;
            EXPECT_EQ(placesIn(plain->english()), 0) << plain->english();
            // Places within an argument are not filled.
            const auto odd = Reason::decoded(encodedOf(sentence, awkward, nested));
            ASSERT_TRUE(odd) << form;
            EXPECT_EQ(countOf(awkward, odd->english()), mentioned) << odd->english();
        }
    }
}

TEST(Reason, damagedTextIsRefusedOrAReason) {
    for (const Sentence &sentence : allSentences()) {
        const std::string good = encodedOf(sentence, awkward, 0);
        for (std::size_t size = 0; size < good.size(); ++size)
            EXPECT_FALSE(Reason::decoded(std::string_view(good).substr(0, size)))
                << good.substr(0, size);
        EXPECT_FALSE(Reason::decoded(good + ";")) << good;
        EXPECT_FALSE(Reason::decoded(" " + good)) << good;
        for (std::size_t at = 0; at < good.size(); ++at)
            for (const int byte : {0, 0xFF, int(' '), int(';'), int(':'), int('0'), int('9'),
                                   int('r'), int('t'), good[at] ^ 1, good[at] ^ 0x20}) {
                std::string bad = good;
                bad[at] = char(byte);
                const auto reason = Reason::decoded(bad);
                EXPECT_TRUE(!reason || hasItsArguments(*reason)) << bad;
            }
    }
    for (const char *const text : {"",
                                   ";",
                                   " ",
                                   "is damaged",
                                   "isDamaged",
                                   "isDamaged ;",
                                   "isdamaged;",
                                   "isDamaged;isDamaged;",
                                   "isDamaged t1:x;",
                                   "isDamagedBy;",
                                   "isDamagedBy t;",
                                   "isDamagedBy t:;",
                                   "isDamagedBy t2:x;",
                                   "isDamagedBy t-1:x;",
                                   "isDamagedBy t+1:x;",
                                   "isDamagedBy t 1:x;",
                                   "isDamagedBy t18446744073709551615:x;",
                                   "isDamagedBy t99999999999999999999:x;",
                                   "isDamagedBy r18446744073709551615:isDamaged;",
                                   "isDamagedBy r2:isDamaged;;",
                                   "isDamagedBy r1:;",
                                   "isDamagedBy t1:x t1:x;",
                                   "count;"})
        EXPECT_FALSE(Reason::decoded(text)) << text;
}

TEST(Reason, nestingEnds) {
    for (const int times : {0, 1, 4}) {
        const Reason reason = wrapped(times);
        EXPECT_EQ(Reason::decoded(reason.encoded()), reason) << times;
    }
    for (const int times : {5, 6, 1000})
        EXPECT_FALSE(Reason::decoded(wrapped(times).encoded())) << times;
    std::string deep; // without an end
    for (int n = 0; n < 1'000'000; ++n)
        deep += "imagesOnly r1:";
    EXPECT_FALSE(Reason::decoded(deep));
}

TEST(Reason, reasonsWithinAreJoined) {
    const std::vector<Reason> both{because::gapBetween("2.5", "a", 7), because::more(3)};
    const Reason reason = because::missingSlices(both);
    EXPECT_EQ(reason.english(), "missing slices, interpolated: 2.5 mm between a and 7; 3 more");
    EXPECT_EQ(Reason::decoded(reason.encoded()), reason);
    EXPECT_TRUE(reason.is(because::missingSlices));
    EXPECT_FALSE(reason.is(because::more));
    EXPECT_NE(reason, because::missingSlices(std::vector{both[1], both[0]}));
}

TEST(Reason, theSystemsReasonsAreKnown) {
    EXPECT_TRUE(systemReason(ENOSPC).is(because::noSpaceLeft));
    EXPECT_TRUE(
        systemReason(std::make_error_code(std::errc::no_space_on_device)).is(because::noSpaceLeft));
    EXPECT_TRUE(
        systemReason(std::error_code(ENOENT, std::system_category())).is(because::noSuchFile));
    EXPECT_TRUE(systemReason(ENOMEM).is(because::notEnoughMemory));
    // The texts are the system's own.
    for (const int error : {ENOENT, EACCES, EPERM, ENOSPC, EROFS, EISDIR, ENOTDIR, ENAMETOOLONG,
                            EMFILE, EIO, EFBIG, ELOOP})
        if (std::string_view(std::strerror(error)) != "Unknown error") // as Windows has some
            EXPECT_EQ(systemReason(error).english(), std::strerror(error));
    constexpr int unknown = 99999;
    const Reason other = systemReason(unknown);
    EXPECT_TRUE(other.is(because::systemReports));
    EXPECT_EQ(other.english(), std::string("the system reports: ") + std::strerror(unknown));
    // Error numbers of other categories are not the system's.
    EXPECT_TRUE(
        systemReason(std::error_code(int(std::future_errc::no_state), std::future_category()))
            .is(because::systemReports));
}

} // namespace pellucid::task
