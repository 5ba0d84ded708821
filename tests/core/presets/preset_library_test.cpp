// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/presets/preset_library.h"

#include <csignal>
#include <fstream>

#include <gtest/gtest.h>

#ifndef _WIN32
#include <sys/resource.h>
#include <unistd.h>
#endif

#include "core/files/reasons.h"
#include "core/task/error.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {
namespace {

using presets::Preset;
using presets::PresetLibrary;

Preset named(const std::string &name, double weight = 1.0) {
    Preset preset;
    preset.name = name;
    preset.look.transferFunction.weights = {0.0, weight};
    return preset;
}

std::size_t filesIn(const std::filesystem::path &folder) {
    return std::size_t(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(PresetLibrary, BuiltInPresetsAreEnoughAndAllValid) {
    const PresetLibrary library{std::filesystem::path()};
    int ct = 0, mr = 0;
    for (const auto &entry : library.entries()) {
        EXPECT_TRUE(entry.isBuiltIn());
        ct += entry.preset.modality == "CT";
        mr += entry.preset.modality == "MR";
    }
    EXPECT_GE(ct, 12);
    EXPECT_GE(mr, 3);
    EXPECT_NE(library.find("x-RAY"), nullptr);
}

TEST(PresetLibrary, SavesReplacesFindsAndRemoves) {
    test::TemporaryFolder folder;
    PresetLibrary library(folder / "presets"); // created on demand
    library.save(named("Mine", 0.5));
    library.save(named("mine", 1.5));
    PresetLibrary again(folder / "presets");
    ASSERT_NE(again.find("Mine"), nullptr);
    EXPECT_EQ(again.get("Mine").preset.look.transferFunction.weights[1], 1.5);
    EXPECT_EQ(filesIn(folder / "presets"), 1U);
    // Names that look alike to a file system stay apart.
    again.save(named("a/b"));
    again.save(named("a\\b"));
    again.save(named("骨"));
    EXPECT_EQ(PresetLibrary(folder / "presets").entries().size(),
              PresetLibrary({}).entries().size() + 4);
    again.remove("a/b");
    EXPECT_EQ(again.find("a/b"), nullptr);
    EXPECT_NE(again.find("a\\b"), nullptr);
    EXPECT_THROW(again.get("nothing of the kind"), task::Error);
}

TEST(PresetLibrary, BuiltInOnesStay) {
    test::TemporaryFolder folder;
    PresetLibrary library(folder / "presets");
    EXPECT_THROW(library.save(named("Bone")), task::Error);
    EXPECT_THROW(library.remove("Bone"), task::Error);
    EXPECT_THROW(library.save(named("")), task::Error);
}

TEST(PresetLibrary, MalformedPresetsAreNotSaved) {
    test::TemporaryFolder folder;
    PresetLibrary library(folder / "presets");
    try {
        library.save(named("two\nlines"));
        FAIL();
    } catch (const task::Error &error) {
        EXPECT_EQ(error.code(), task::ErrorCode::usage);
        EXPECT_EQ(error.reason().english(),
                  "the preset cannot be saved: /name: must be one line of 1 to 80 characters");
    }
}

TEST(PresetLibrary, ABadFileIsPassedOverWithItsReason) {
    test::TemporaryFolder folder;
    std::filesystem::create_directories(folder / "presets");
    std::ofstream(folder / "presets/broken.json") << "{\n\"schema\": ";
    std::ofstream(folder / "presets/.half.json.abc") << "{";
    std::ofstream(folder / "presets/notes.txt") << "hello";
    PresetLibrary library(folder / "presets");
    library.save(named("Mine"));
    ASSERT_EQ(library.skipped().size(), 1U);
    EXPECT_EQ(library.skipped()[0].path.filename(), "broken.json");
    const task::Reason &reason = library.skipped()[0].reason;
    ASSERT_TRUE(reason.is(task::because::atLine)) << reason.english();
    EXPECT_EQ(reason.arguments()[0].text, "2");
    EXPECT_NE(library.find("Mine"), nullptr);
    // A preset of the same name does not overwrite it either.
    library.save(named("broken"));
    EXPECT_NE(PresetLibrary(folder / "presets").find("broken"), nullptr);
    EXPECT_EQ(PresetLibrary(folder / "presets").skipped().size(), 1U);
    EXPECT_TRUE(std::filesystem::exists(folder / "presets/broken.json"));
}

TEST(PresetLibrary, AFolderThatCannotBeWrittenIsNamed) {
    test::TemporaryFolder folder;
    // A file is in place of the folder, which not even root can write to.
    std::ofstream(folder / "presets") << "in the way";
    PresetLibrary library(folder / "presets");
    try {
        library.save(named("Mine"));
        FAIL();
    } catch (const task::Error &error) {
        EXPECT_EQ(error.code(), task::ErrorCode::output);
    }
}

#ifndef _WIN32
// A limit on the size of files acts as a full disk: the former preset stays unharmed.
TEST(PresetLibrary, AFullDiskLosesNothing) {
    test::TemporaryFolder folder;
    PresetLibrary library(folder / "presets");
    library.save(named("Mine", 0.5));
    Preset longer = named("Mine", 1.5);
    longer.notes = std::string(60000, 'x');
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    rlimit small = before;
    small.rlim_cur = 20000;
    setrlimit(RLIMIT_FSIZE, &small);
    EXPECT_THROW(library.save(longer), task::Error);
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(filesIn(folder / "presets"), 1U);
    EXPECT_EQ(PresetLibrary(folder / "presets").get("Mine").preset.look.transferFunction.weights[1],
              0.5);
}
#endif

} // namespace
} // namespace pellucid
