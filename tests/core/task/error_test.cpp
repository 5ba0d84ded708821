// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/task/error.h"

#include <memory>
#include <new>
#include <type_traits>

#include <gtest/gtest.h>

#include "core/preprocess/reasons.h"
#include "core/task/progress.h"
#include "core/task/reasons.h"

namespace pellucid {
namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;
using task::orOutOfMemory;

TEST(Error, NamesThePath) {
    const Error error(ErrorCode::unusable, because::isEmpty, "/a/b");
    EXPECT_STREQ(error.what(), "/a/b: is empty");
    EXPECT_EQ(error.reason(), because::isEmpty);
}

TEST(OrOutOfMemory, GivesWhatTheWorkGives) {
    EXPECT_EQ(orOutOfMemory(because::notEnoughMemory, [] { return 7; }), 7);
    // The result need not be copyable.
    EXPECT_EQ(*orOutOfMemory(because::notEnoughMemory, [] { return std::make_unique<int>(8); }), 8);
    int value = 0;
    const auto itself = [&]() -> int & { return value; };
    static_assert(std::is_same_v<decltype(orOutOfMemory(because::notEnoughMemory, itself)), int &>);
    EXPECT_EQ(&orOutOfMemory(because::notEnoughMemory, itself), &value);
    orOutOfMemory(because::notEnoughMemory, [&] { value = 9; });
    EXPECT_EQ(value, 9);
}

TEST(OrOutOfMemory, NamesWhatNeededTheMemory) {
    try {
        orOutOfMemory(because::noMemoryForTheStep("median"), [] { throw std::bad_alloc(); });
        FAIL() << "nothing was thrown";
    } catch (const Error &error) {
        EXPECT_EQ(error.code(), ErrorCode::outOfMemory);
        EXPECT_EQ(error.reason(), because::noMemoryForTheStep("median"));
    }
    // A size beyond the address space counts as too little memory, too.
    EXPECT_THROW(orOutOfMemory(because::notEnoughMemory, [] { throw std::bad_array_new_length(); }),
                 Error);
}

TEST(OrOutOfMemory, LeavesOtherFailuresAlone) {
    try {
        orOutOfMemory(because::notEnoughMemory,
                      [] { throw Error(ErrorCode::unusable, because::isEmpty, "/a"); });
        FAIL() << "nothing was thrown";
    } catch (const Error &error) {
        EXPECT_EQ(error.code(), ErrorCode::unusable);
        EXPECT_EQ(error.reason(), because::isEmpty);
        EXPECT_EQ(error.path(), "/a");
    }
    EXPECT_THROW(orOutOfMemory(because::notEnoughMemory, [] { throw task::Cancelled(); }),
                 task::Cancelled);
}

} // namespace
} // namespace pellucid
