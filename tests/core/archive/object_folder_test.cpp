// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/object_folder.h"

#include <fstream>

#include "core/archive/reasons.h"
#include "core/task/error.h"
#include "core/task/reasons.h"
#include "tests/core/archive/kept_object.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;

using namespace test;

task::Reason refusal(const ObjectFolder &folder, const std::string &bytes,
                     const std::vector<ObjectFolder::Place> &places = {}) {
    try {
        keep(folder, bytes, places);
    } catch (const task::Error &error) {
        EXPECT_EQ(error.code(), task::ErrorCode::unusable);
        return error.reason();
    }
    return because::isEmpty;
}

} // namespace

// A server that lists an object of one study and sends one of another is not believed.
TEST(ObjectFolder, AnObjectOfAnotherPlaceIsRefused) {
    const test::TemporaryFolder folder;
    const ObjectFolder objects(folder.path(), ObjectFolder::Durability::cached);
    const std::string object = objectWith(1);
    EXPECT_TRUE(
        refusal(objects, object, {{root + "9", root + "3"}}).is(because::isNotWhatWasAnnounced));
    EXPECT_TRUE(
        refusal(objects, object, {{root + "2", root + "9"}}).is(because::isNotWhatWasAnnounced));
    EXPECT_FALSE(objects.find(root + "2", root + "3", root + "1.1"));
    keep(objects, object, {{root + "2", root + "3"}});
    EXPECT_TRUE(objects.find(root + "2", root + "3", root + "1.1"));
}

TEST(ObjectFolder, WhatIsThereIsNotReplaced) {
    const test::TemporaryFolder folder;
    const ObjectFolder objects(folder.path(), ObjectFolder::Durability::synced);
    const std::string first = objectWith(1), second = objectWith(2);
    const StoredObject kept = keep(objects, first);
    EXPECT_EQ(keep(objects, first).path, kept.path); // the same once more
    EXPECT_TRUE(refusal(objects, second).is(because::anotherObjectHasItsUid));
    EXPECT_EQ(test::readText(kept.path), first);
}

// A power cut may leave a name without its bytes.
TEST(ObjectFolder, WhatIsDamagedIsNotThereAndIsReplaced) {
    const std::string object = objectWith(1);
    for (const std::string &left :
         {std::string(), object.substr(0, object.size() / 2), object.substr(0, object.size() - 10),
          std::string("no DICOM file at all")}) {
        const test::TemporaryFolder folder;
        const ObjectFolder objects(folder.path(), ObjectFolder::Durability::cached);
        const StoredObject kept = keep(objects, object);
        std::ofstream(kept.path, std::ios::trunc | std::ios::binary) << left;
        EXPECT_FALSE(objects.find(root + "2", root + "3", root + "1.1")) << left.size();
        keep(objects, object);
        EXPECT_TRUE(objects.find(root + "2", root + "3", root + "1.1"));
        EXPECT_EQ(test::readText(kept.path), object);
    }
}

// What differs for good, and what archives correct.
TEST(ObjectFolder, AnotherPatientIsNoticed) {
    const Patient jane{"DOE^JANE", "ID-1", "19700101"};
    EXPECT_FALSE(isOfAnother(jane, jane));
    EXPECT_FALSE(isOfAnother(jane, {"Doe, Jane", "ID-1 ", "19700101"}));
    EXPECT_FALSE(isOfAnother(jane, {"MILLER^JANE", "ID-1", "19700101"})); // married
    EXPECT_FALSE(isOfAnother(jane, {"DOE^JANE", "ID-1", "19700110"}));    // mistyped
    EXPECT_FALSE(isOfAnother(jane, {}));
    EXPECT_FALSE(isOfAnother({}, jane));
    EXPECT_FALSE(isOfAnother(jane, {"DOE^JANE", "", ""}));
    EXPECT_FALSE(isOfAnother(jane, {"MILLER^JANE", "", "19700101"}));
    EXPECT_FALSE(isOfAnother(jane, {"MILLER^JANE", "ID-1", ""}));
    EXPECT_TRUE(isOfAnother(jane, {"OTHER^PATIENT", "", ""}));
    EXPECT_TRUE(isOfAnother(jane, {"", "", "19800202"}));
    EXPECT_TRUE(isOfAnother(jane, {"OTHER^PATIENT", "ID-999", "19800202"}));
    EXPECT_TRUE(isOfAnother(jane, {"DOE^JANE", "ID-2", "19700101"}));
    EXPECT_TRUE(isOfAnother(jane, {"OTHER^PATIENT", "ID-1", "19800202"}));
    EXPECT_TRUE(isOfAnother({"DOE^JANE", "", "19700101"}, {"OTHER^PATIENT", "ID-9", "19800202"}));
}

} // namespace pellucid::archive
