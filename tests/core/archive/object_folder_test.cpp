// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/object_folder.h"

#include <fstream>

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

#include "core/archive/reasons.h"
#include "core/task/error.h"
#include "core/task/reasons.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;

const std::string root = "1.2.826.0.1.3680043.8.498.";
const network::Arrival announced{
    "1.2.840.10008.5.1.4.1.1.2", root + "1.1", "1.2.840.10008.1.2.1", {}};

std::string objectWith(int value) {
    const test::TemporaryFolder folder;
    test::SeriesKnobs knobs;
    knobs.value = [value](int, int, int) { return value; };
    test::sliceOf(knobs, 0).write(folder / "object.dcm");
    return test::readText(folder / "object.dcm");
}

StoredObject keep(const ObjectFolder &folder, const std::string &bytes,
                  const std::vector<ObjectFolder::Place> &places = {}) {
    const auto file = folder.open(announced);
    EXPECT_EQ(::write(file->view().get(), bytes.data(), bytes.size()), ssize_t(bytes.size()));
    return folder.keep(*file, announced, bytes.size(), places);
}

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

// A helper that has been taken over still has the file open after the object was checked.
TEST(ObjectFolder, WhatWasCheckedCannotBeWrittenAnyMore) {
    const test::TemporaryFolder folder;
    const ObjectFolder objects(folder.path(), ObjectFolder::Durability::cached);
    const std::string object = objectWith(1), other = objectWith(2);
    const auto file = objects.open(announced);
    const int helpers = ::dup(file->view().get());
    ASSERT_EQ(::write(helpers, object.data(), object.size()), ssize_t(object.size()));
    const StoredObject kept = objects.keep(*file, announced, object.size());
    ASSERT_EQ(::pwrite(helpers, other.data(), other.size(), 0), ssize_t(other.size()));
    ASSERT_EQ(::ftruncate(helpers, 10), 0);
    ::close(helpers);
    EXPECT_EQ(test::readText(kept.path), object);
    // Nor does it decide how much is kept.
    const auto shorter = objects.open(announced);
    ASSERT_EQ(::write(shorter->view().get(), "DICM", 4), 4);
    EXPECT_THROW(objects.keep(*shorter, announced, object.size()), task::Error);
}

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

// Patients' data are the user's alone, whatever new files are otherwise.
TEST(ObjectFolder, OnlyTheUserMayRead) {
    const test::TemporaryFolder folder;
    const mode_t before = ::umask(0);
    const ObjectFolder objects(folder / "new/folder", ObjectFolder::Durability::cached);
    objects.create();
    const StoredObject kept = keep(objects, objectWith(1));
    ::umask(before);
    using std::filesystem::perms;
    const auto of = [](const std::filesystem::path &path) {
        return std::filesystem::status(path).permissions();
    };
    EXPECT_EQ(of(kept.path), perms::owner_read | perms::owner_write);
    for (auto above = kept.path.parent_path(); above != folder.path(); above = above.parent_path())
        EXPECT_EQ(of(above), perms::owner_all) << above;
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
