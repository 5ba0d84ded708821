// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/object_folder.h"

#include <fstream>

#include <gtest/gtest.h>

#include <unistd.h>

#include "core/task/error.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;

const std::string root = "1.2.826.0.1.3680043.8.498.";
const exchange::Arrival announced{
    "1.2.840.10008.5.1.4.1.1.2", root + "1.1", "1.2.840.10008.1.2.1", {}};

std::string objectWith(int value) {
    const test::TemporaryFolder folder;
    test::SeriesKnobs knobs;
    knobs.value = [value](int, int, int) { return value; };
    test::sliceOf(knobs, 0).write(folder / "object.dcm");
    return test::readText(folder / "object.dcm");
}

StoredObject keep(const ObjectFolder &folder, const std::string &bytes,
                  const std::optional<ObjectFolder::Place> &place = {}) {
    const auto file = folder.open(announced);
    EXPECT_EQ(::write(file->descriptor(), bytes.data(), bytes.size()), ssize_t(bytes.size()));
    return folder.keep(*file, announced, bytes.size(), place);
}

task::Reason refusal(const ObjectFolder &folder, const std::string &bytes,
                     const std::optional<ObjectFolder::Place> &place = {}) {
    try {
        keep(folder, bytes, place);
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
    const ObjectFolder objects(folder.path(), ObjectFolder::Keeps::inMemoryOfTheSystem);
    const std::string object = objectWith(1);
    EXPECT_TRUE(
        refusal(objects, object, {{root + "9", root + "3"}}).is(because::isNotWhatWasAnnounced));
    EXPECT_TRUE(
        refusal(objects, object, {{root + "2", root + "9"}}).is(because::isNotWhatWasAnnounced));
    EXPECT_FALSE(objects.has(root + "2", root + "3", root + "1.1"));
    keep(objects, object, {{root + "2", root + "3"}});
    EXPECT_TRUE(objects.has(root + "2", root + "3", root + "1.1"));
}

TEST(ObjectFolder, WhatIsThereIsNotReplaced) {
    const test::TemporaryFolder folder;
    const ObjectFolder objects(folder.path(), ObjectFolder::Keeps::onDisk);
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
        const ObjectFolder objects(folder.path(), ObjectFolder::Keeps::inMemoryOfTheSystem);
        const StoredObject kept = keep(objects, object);
        std::ofstream(kept.path, std::ios::trunc | std::ios::binary) << left;
        EXPECT_FALSE(objects.has(root + "2", root + "3", root + "1.1")) << left.size();
        keep(objects, object);
        EXPECT_TRUE(objects.has(root + "2", root + "3", root + "1.1"));
        EXPECT_EQ(test::readText(kept.path), object);
    }
}

} // namespace pellucid::archive
