// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/json_value_nlohmann.h"

#include <functional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/files/reasons.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid {
namespace {

namespace because = task::because;
using files::JsonValue;

enum class Fruit { apple, pear };
constexpr files::JsonWords<Fruit, 2> fruits{{{"apple", Fruit::apple}, {"pear", Fruit::pear}}};

class JsonValueTest : public testing::Test {
protected:
    const nlohmann::json parsed = nlohmann::json::parse(R"({
        "number": 2.5, "large": 1e300, "text": "pear", "nothing": null,
        "list": [1, -2, 3], "four": [4, 3, 2, 1], "flag": true, "mixed": [1, "x"], "object": {"b": [{"c": 4}], "a": 5}})");
    const JsonValue in{parsed};

    static task::Reason reasonOf(const std::function<void()> &read) {
        try {
            read();
        } catch (const task::Error &error) {
            EXPECT_EQ(error.code(), task::ErrorCode::usage);
            return error.reason();
        }
        return because::inWords("accepted");
    }
};

TEST_F(JsonValueTest, ReadsWhatIsThere) {
    EXPECT_TRUE(in.isObject());
    EXPECT_EQ(in["number"].number(), 2.5);
    EXPECT_EQ(in["large"].number(1e301), 1e300);
    EXPECT_EQ(in["text"].text(), "pear");
    EXPECT_EQ(in["text"].meaning(fruits), Fruit::pear);
    EXPECT_STREQ(files::wordFor(Fruit::pear, fruits), "pear");
    EXPECT_EQ(in["list"].numbers(), (std::vector<double>{1, -2, 3}));
    EXPECT_EQ(in["list"].threeNumbers(3.0), (std::array<double, 3>{1, -2, 3}));
    EXPECT_EQ(in["four"].fourNumbers(), (std::array<double, 4>{4, 3, 2, 1}));
    EXPECT_TRUE(in["flag"].boolean());
    EXPECT_EQ(in.at("object").at("b").at(0).at("c").number(), 4.0);
    EXPECT_EQ(in["list"].size(), 3U);
    EXPECT_EQ(in["list"].elements()[2].number(), 3.0);
    const auto members = in["object"].members();
    ASSERT_EQ(members.size(), 2U);
    EXPECT_EQ(members[0].first, "a");
    EXPECT_EQ(members[0].second.number(), 5.0);
}

TEST_F(JsonValueTest, AbsentValuesKnowTheirPointer) {
    EXPECT_TRUE(in["nothing"]); // null is a value
    EXPECT_FALSE(in["absent"]);
    EXPECT_FALSE(in["list"]["absent"]);
    EXPECT_FALSE(in["absent"]["too"]);
    EXPECT_EQ(reasonOf([&] { in["absent"]["too"].text(); }),
              because::at("/absent/too", because::mustBeAText));
    EXPECT_EQ(reasonOf([&] { in.at("absent"); }), because::hasNo("absent"));
    EXPECT_EQ(reasonOf([&] { in["object"].at("absent"); }),
              because::at("/object", because::hasNo("absent")));
    EXPECT_EQ(reasonOf([&] { in["list"].at("x"); }), because::at("/list", because::mustBeAnObject));
    EXPECT_EQ(reasonOf([&] { in["list"].at(3); }), because::at("/list", because::hasNo("3")));
}

TEST_F(JsonValueTest, RefusesWithPointerAndReason) {
    EXPECT_EQ(reasonOf([&] { in["text"].number(); }), because::at("/text", because::mustBeANumber));
    EXPECT_EQ(reasonOf([&] { in["large"].number(); }),
              because::at("/large", because::isOutOfRange));
    EXPECT_EQ(reasonOf([&] { in["text"].numbers(); }),
              because::at("/text", because::mustBeNumbers));
    EXPECT_EQ(reasonOf([&] { in["mixed"].numbers(); }),
              because::at("/mixed/1", because::mustBeANumber));
    EXPECT_EQ(reasonOf([&] { in["list"].twoNumbers(); }),
              because::at("/list", because::mustBeTwoNumbers));
    EXPECT_EQ(reasonOf([&] { in["mixed"].twoNumbers(); }),
              because::at("/mixed/1", because::mustBeANumber));
    EXPECT_EQ(reasonOf([&] { in["text"].threeNumbers(); }),
              because::at("/text", because::mustBeThreeNumbers));
    EXPECT_EQ(reasonOf([&] { in["list"].threeNumbers(2.0); }),
              because::at("/list/2", because::isOutOfRange));
    EXPECT_EQ(reasonOf([&] { in["list"].fourNumbers(); }),
              because::at("/list", because::mustBeFourNumbers));
    EXPECT_EQ(reasonOf([&] { in["number"].boolean(); }),
              because::at("/number", because::mustBeTrueOrFalse));
    EXPECT_EQ(reasonOf([&] { in["object"].elements(); }),
              because::at("/object", because::mustBeAList));
    EXPECT_EQ(reasonOf([&] { in["list"].members(); }),
              because::at("/list", because::mustBeAnObject));
    EXPECT_EQ(reasonOf([&] { in["list"].text(); }), because::at("/list", because::mustBeAText));
    const nlohmann::json plum = "plum";
    EXPECT_EQ(reasonOf([&] { JsonValue(plum).meaning(fruits); }),
              because::isNoneOf("plum", "apple, pear"));
}

TEST_F(JsonValueTest, AChecksErrorIsRefusedAtThePointer) {
    const JsonValue number = in["number"];
    EXPECT_EQ(number.checked([] { return 3; }), 3);
    const task::Reason refused = reasonOf([&] {
        number.checked([] { throw task::Error(task::ErrorCode::unusable, because::isEmpty); });
    });
    EXPECT_EQ(refused, because::at("/number", because::isEmpty));
    EXPECT_EQ(files::jsonPointer(refused), "/number");
    EXPECT_EQ(files::jsonPointer(because::isEmpty), "");
}

TEST(JsonFault, IsWithoutTheLibrarysTag) {
    try {
        const auto parsed = nlohmann::json::parse("[1");
        FAIL() << "accepted: " << parsed;
    } catch (const std::exception &error) {
        EXPECT_EQ(files::jsonFault(error).rfind("parse error at line 1", 0), 0U);
    }
}

} // namespace
} // namespace pellucid
