// SPDX-License-Identifier: GPL-3.0-or-later
// Permissions of files, and handles of them.
#include <sys/stat.h>
#include <unistd.h>

#include "core/task/error.h"
#include "tests/core/archive/kept_object.h"

namespace pellucid::archive {

using namespace test;

// A compromised helper may keep the file open after the check.
TEST(ObjectFolder, WhatWasCheckedCannotBeWrittenAnyMore) {
    const TemporaryFolder folder;
    const ObjectFolder objects(folder.path(), ObjectFolder::Durability::cached);
    const std::string object = objectWith(1), other = objectWith(2);
    const auto file = objects.open(announced);
    const int helpers = ::dup(file->view().get());
    ASSERT_EQ(::write(helpers, object.data(), object.size()), ssize_t(object.size()));
    const StoredObject kept = objects.keep(*file, announced, object.size());
    ASSERT_EQ(::pwrite(helpers, other.data(), other.size(), 0), ssize_t(other.size()));
    ASSERT_EQ(::ftruncate(helpers, 10), 0);
    ::close(helpers);
    EXPECT_EQ(readText(kept.path), object);
    // Nor does it decide how much is kept.
    const auto shorter = objects.open(announced);
    ASSERT_EQ(::write(shorter->view().get(), "DICM", 4), 4);
    EXPECT_THROW(objects.keep(*shorter, announced, object.size()), task::Error);
}

// Patients' data are the user's alone, whatever new files are otherwise.
TEST(ObjectFolder, OnlyTheUserMayRead) {
    const TemporaryFolder folder;
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

} // namespace pellucid::archive
