// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "core/dicom/missing_objects.h"
#include "core/dicom/reasons.h"
#include "core/dicom/scan.h"
#include "core/files/atomic_file.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {

namespace {

namespace because = task::because;

// Whether the volumes of a scan say that objects are missing.
bool saysSo(const std::filesystem::path &path) {
    const dicom::Catalogue catalogue = dicom::scan({path});
    EXPECT_TRUE(catalogue.skipped.empty()); // the note is no file of its own
    const auto &warnings = dicom::defaultSelection(catalogue).volume->notes.warnings;
    return std::any_of(warnings.begin(), warnings.end(), [](const task::Reason &warning) {
        return warning.is(because::objectsOfStudyMissing);
    });
}

} // namespace

// Whatever is opened of a study that was not retrieved completely: its folder, one above it, a
// series, a file.
TEST(MissingObjects, AreToldOfWhateverIsOpened) {
    const test::TemporaryFolder folder;
    const auto study = folder.path() / "study", series = study / "series";
    std::filesystem::create_directories(series);
    test::SeriesKnobs knobs;
    knobs.slices = 3;
    test::writeSeries(series, knobs);
    EXPECT_FALSE(saysSo(folder.path()));
    dicom::noteMissingObjects(study, {}, 43);
    for (const auto &path :
         {folder.path(), study, series, std::filesystem::directory_iterator(series)->path()})
        EXPECT_TRUE(saysSo(path)) << path;
    dicom::noteMissingObjects(study, {}, 0);
    EXPECT_FALSE(saysSo(study));
}

// A part of a study that is complete says nothing about the rest.
TEST(MissingObjects, APartThatIsCompleteLeavesTheNoteOfTheWhole) {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "series" / "1.dcm";
    const auto missing = [&] { return dicom::missingObjectsBeside(file).value_or(0); };
    dicom::noteMissingObjects(folder.path(), {}, 5);
    dicom::noteMissingObjects(folder.path(), {"1.2"}, 0);
    EXPECT_EQ(missing(), 5U);
    dicom::noteMissingObjects(folder.path(), {}, 0);
    EXPECT_EQ(missing(), 0U);
    dicom::noteMissingObjects(folder.path(), {"1.2", "1.3"}, 4);
    dicom::noteMissingObjects(folder.path(), {"1.2"}, 0);
    EXPECT_EQ(missing(), 4U);
    dicom::noteMissingObjects(folder.path(), {"1.3", "1.2"}, 0);
    EXPECT_EQ(missing(), 0U);
}

TEST(MissingObjects, ANoteThatIsNoneIsIgnored) {
    const test::TemporaryFolder folder;
    for (const char *text : {"", "many", "-3", "5 of 6"}) {
        files::AtomicFile file(folder.path() / dicom::missingObjectsName);
        file.write(std::string_view(text));
        file.commit();
        EXPECT_FALSE(dicom::missingObjectsBeside(folder.path() / "1.dcm")) << text;
    }
}

} // namespace pellucid
