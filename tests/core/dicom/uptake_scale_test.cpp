// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/dicom/load_volume.h"
#include "core/dicom/reasons.h"
#include "core/dicom/scan.h"
#include "core/dicom/uptake_scale.h"
#include "core/task/reasons.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/temporary_folder.h"

namespace pellucid {

namespace {

using decoding::InstanceHeader;
using decoding::PetHeader;
using dicom::UptakeScale;
using volume::ValueUnit;

// An hour from injection to scan, 370 MBq of fluorine-18 in a patient of 70 kg.
PetHeader fdg() {
    PetHeader pet;
    pet.units = "BQML";
    pet.decayCorrection = "START";
    pet.seriesDate = pet.acquisitionDate = "20260115";
    pet.seriesTime = pet.acquisitionTime = "103000.00";
    pet.injectionTime = "093000.00";
    pet.weightKg = 70.0;
    pet.injectedBq = 3.7e8;
    pet.halfLifeS = 6586.2;
    pet.corrections = "DECY\\ATTN";
    return pet;
}

UptakeScale scaleOf(const PetHeader &pet) {
    InstanceHeader header;
    header.pet = pet;
    return dicom::uptakeScale({&header});
}

// By definition: a whole body with the injected activity spread evenly has the value 1.
constexpr double factorAtInjection = 70.0 * 1000.0 / 3.7e8;

TEST(UptakeScale, AccountsForDecayFromInjectionToTheSeries) {
    const UptakeScale scale = scaleOf(fdg());
    EXPECT_EQ(scale.unit, ValueUnit::uptake);
    EXPECT_FALSE(scale.notUptake);
    EXPECT_NEAR(scale.factor, factorAtInjection * std::exp2(3600.0 / 6586.2), 1e-15);
}

TEST(UptakeScale, ValuesCorrectedToTheInjectionHaveNotDecayed) {
    PetHeader pet = fdg();
    pet.decayCorrection = "ADMIN";
    EXPECT_DOUBLE_EQ(scaleOf(pet).factor, factorAtInjection);
}

TEST(UptakeScale, ASeriesThatWasReconstructedLaterRefersToItsFirstAcquisition) {
    InstanceHeader first, second;
    first.pet = second.pet = fdg();
    first.pet->seriesTime = second.pet->seriesTime = "150000";
    first.pet->acquisitionTime = "103500";
    second.pet->acquisitionTime = "103000";
    EXPECT_NEAR(dicom::uptakeScale({&first, &second}).factor,
                factorAtInjection * std::exp2(3600.0 / 6586.2), 1e-15);
}

TEST(UptakeScale, InjectionBeforeMidnightIsOfTheDayBefore) {
    PetHeader pet = fdg();
    pet.seriesTime = pet.acquisitionTime = "003000";
    pet.injectionTime = "233000";
    EXPECT_NEAR(scaleOf(pet).factor, factorAtInjection * std::exp2(3600.0 / 6586.2), 1e-15);
}

TEST(UptakeScale, ADateThatAnAnonymiserLeftBehindIsNotBelieved) {
    PetHeader pet = fdg();
    pet.injectionTime.clear();
    pet.injectionDateTime = "20010203093000.00";
    EXPECT_NEAR(scaleOf(pet).factor, factorAtInjection * std::exp2(3600.0 / 6586.2), 1e-15);
}

TEST(UptakeScale, OtherUnitsOfTheFilesAreKept) {
    PetHeader pet = fdg();
    pet.units = "GML";
    EXPECT_EQ(scaleOf(pet).unit, ValueUnit::uptake);
    EXPECT_EQ(scaleOf(pet).factor, 1.0);
    pet.uptakeType = "LBM";
    EXPECT_EQ(scaleOf(pet).unit, ValueUnit::none);
    EXPECT_TRUE(scaleOf(pet).notUptake->is(task::because::uptakeIsOfType));
    pet = fdg();
    pet.units = "CNTS";
    EXPECT_TRUE(scaleOf(pet).notUptake->is(task::because::petUnitIs));
    pet.uptakePerCount = 0.0004;
    EXPECT_EQ(scaleOf(pet).unit, ValueUnit::uptake);
    EXPECT_EQ(scaleOf(pet).factor, 0.0004);
    pet.corrections = "DECY";
    EXPECT_TRUE(scaleOf(pet).notUptake->is(task::because::notAttenuationCorrected));
    pet.units = "GML";
    EXPECT_TRUE(scaleOf(pet).notUptake->is(task::because::notAttenuationCorrected));
    pet.corrections.clear(); // nothing is said
    EXPECT_EQ(scaleOf(pet).unit, ValueUnit::uptake);
}

TEST(UptakeScale, SaysWhatIsMissing) {
    const auto reason = [](const std::function<void(PetHeader &)> &change) {
        PetHeader pet = fdg();
        change(pet);
        const UptakeScale scale = scaleOf(pet);
        EXPECT_EQ(scale.unit, ValueUnit::activity);
        EXPECT_EQ(scale.factor, 1.0);
        return scale.notUptake.value_or(task::because::isEmpty);
    };
    namespace because = task::because;
    EXPECT_TRUE(reason([](PetHeader &p) { p.weightKg = 0.0; }).is(because::noPlausibleWeight));
    EXPECT_TRUE(reason([](PetHeader &p) { p.weightKg = 70000.0; }).is(because::noPlausibleWeight));
    EXPECT_TRUE(reason([](PetHeader &p) { p.injectedBq = 0.0; }).is(because::noInjectedActivity));
    EXPECT_TRUE(reason([](PetHeader &p) { p.injectedBq = 370.0; }).is(because::noInjectedActivity));
    EXPECT_TRUE(
        reason([](PetHeader &p) { p.corrections = "DECY"; }).is(because::notAttenuationCorrected));
    EXPECT_TRUE(reason([](PetHeader &p) { p.injectedBq = 3.7e5; }).is(because::noInjectedActivity));
    // Two statements that contradict each other.
    EXPECT_TRUE(reason([](PetHeader &p) {
                    p.injectionDateTime = "20260115083000.00";
                }).is(because::noDecayTime));
    // Zirconium-89, perhaps injected days before.
    EXPECT_TRUE(reason([](PetHeader &p) { p.halfLifeS = 282276.0; }).is(because::noDecayTime));
    // Minutes in place of seconds.
    EXPECT_TRUE(reason([](PetHeader &p) {
                    p.radionuclide = "^18^Fluorine";
                    p.halfLifeS = 109.77;
                }).is(because::halfLifeIsWrong));
    EXPECT_TRUE(reason([](PetHeader &p) { p.injections = 2; }).is(because::severalInjections));
    EXPECT_TRUE(
        reason([](PetHeader &p) { p.decayCorrection = "NONE"; }).is(because::notDecayCorrected));
    EXPECT_TRUE(reason([](PetHeader &p) { p.halfLifeS = 0.0; }).is(because::noDecayTime));
    EXPECT_TRUE(reason([](PetHeader &p) { p.injectionTime = "9:30"; }).is(because::noDecayTime));
    // Twenty half-lives.
    EXPECT_TRUE(reason([](PetHeader &p) { p.halfLifeS = 180.0; }).is(because::noDecayTime));
}

TEST(UptakeScale, FilesThatDifferHaveNone) {
    for (const auto &change : std::initializer_list<void (*)(PetHeader &)>{
             [](PetHeader &p) { p.weightKg = 80.0; },
             [](PetHeader &p) { p.decayCorrection = "NONE"; },
             [](PetHeader &p) { p.corrections = "DECY"; },
             [](PetHeader &p) { p.injectionTime = "083000"; },
             [](PetHeader &p) { p.halfLifeS = 1221.8; }}) {
        InstanceHeader first, second;
        first.pet = second.pet = fdg();
        change(*second.pet);
        EXPECT_TRUE(
            dicom::uptakeScale({&first, &second}).notUptake->is(task::because::petFilesDiffer));
        EXPECT_TRUE(
            dicom::uptakeScale({&second, &first}).notUptake->is(task::because::petFilesDiffer));
    }
}

// Zirconium-89, six days before: only the date tells.
TEST(UptakeScale, AnInjectionDaysBeforeHasADate) {
    PetHeader pet = fdg();
    pet.halfLifeS = 282276.0;
    const double expected = factorAtInjection * std::exp2((6.0 * 86400.0 + 3600.0) / 282276.0);
    for (const char *const stated : {"20260109093000", "20260109093000.00+0100"}) {
        pet.injectionDateTime = stated;
        EXPECT_NEAR(scaleOf(pet).factor, expected, 1e-12) << stated;
    }
    // The date in universal time, the rest of the file an hour east of it.
    pet.timezone = "+0100";
    pet.injectionDateTime = "20260109083000+0000";
    EXPECT_NEAR(scaleOf(pet).factor, expected, 1e-12);
}

// Texts that are no DICOM date, and one whose zone the other times may not share.
TEST(UptakeScale, AnInjectionThatIsNotUnderstoodIsNotUsed) {
    PetHeader pet = fdg();
    for (const char *const stated : {"2026-01-15 09:30:00", "2026+0100", "20260115083000+0000"}) {
        pet.injectionDateTime = stated;
        pet.injectionTime.clear();
        EXPECT_TRUE(scaleOf(pet).notUptake->is(task::because::noDecayTime)) << stated;
    }
    pet.injectionTime = "093000";
    pet.injectionDateTime = "2026-01-15 09:30:00";
    EXPECT_NEAR(scaleOf(pet).factor, factorAtInjection * std::exp2(3600.0 / 6586.2), 1e-12);
}

// An anonymiser moved the dates of the series by 20 days and forgot that of the injection.
TEST(UptakeScale, TimesOfDayReplaceADateThatCannotBe) {
    PetHeader pet = fdg();
    pet.injectionDateTime = "20251226093000";
    EXPECT_NEAR(scaleOf(pet).factor, factorAtInjection * std::exp2(3600.0 / 6586.2), 1e-12);
    pet.injectionDateTime.clear();
    pet.seriesDate = "20251226"; // of the series only
    pet.seriesTime = "150000";
    EXPECT_NEAR(scaleOf(pet).factor, factorAtInjection * std::exp2(3600.0 / 6586.2), 1e-12);
}

// A dynamic scan begins just before the injection: the dose is what it would have been then.
TEST(UptakeScale, ADynamicScanMayBeginBeforeTheInjection) {
    PetHeader pet = fdg();
    pet.injectionTime = "103010";
    pet.injectionDateTime = "20260115103010";
    EXPECT_TRUE(scaleOf(pet).notUptake->is(task::because::noDecayTime)); // it is a static scan
    pet.isDynamic = true;
    for (const double halfLifeS : {6586.2, 45724.0, 282276.0}) {
        pet.halfLifeS = halfLifeS;
        EXPECT_NEAR(scaleOf(pet).factor, factorAtInjection * std::exp2(-10.0 / halfLifeS), 1e-12);
    }
    pet.injectionTime = "113010"; // an hour is an error
    pet.injectionDateTime = "20260115113010";
    EXPECT_TRUE(scaleOf(pet).notUptake->is(task::because::noDecayTime));
}

// A scan over midnight whose writer kept the date of its start.
TEST(UptakeScale, DatesThatDoNotChangeAtMidnightAreNotBelieved) {
    InstanceHeader first, second;
    first.pet = second.pet = fdg();
    for (InstanceHeader *const h : {&first, &second}) {
        h->pet->seriesTime = "233000";
        h->pet->injectionTime = "223000";
    }
    first.pet->acquisitionTime = "233000";
    second.pet->acquisitionTime = "000500";
    EXPECT_TRUE(dicom::uptakeScale({&first, &second}).notUptake->is(task::because::noDecayTime));
    second.pet->acquisitionDate = "20260116";
    EXPECT_NEAR(dicom::uptakeScale({&first, &second}).factor,
                factorAtInjection * std::exp2(3600.0 / 6586.2), 1e-12);
}

// Only the last bed position is here, and the series has the time of its reconstruction: the frame
// tells when the scan began.
TEST(UptakeScale, APartOfAScanRefersToTheScansBegin) {
    PetHeader pet = fdg();
    pet.seriesTime = "150000";
    pet.acquisitionTime = "110000";
    pet.frameReferenceS = 1800.0;
    EXPECT_NEAR(scaleOf(pet).factor, factorAtInjection * std::exp2(3600.0 / 6586.2), 1e-12);
    // The reference time is that of the frame's mean activity, about half of its duration later.
    pet.frameDurationS = 120.0;
    pet.frameReferenceS = 1860.0;
    EXPECT_NEAR(scaleOf(pet).factor, factorAtInjection * std::exp2(3600.0 / 6586.2),
                1e-4 * factorAtInjection);
}

TEST(UptakeScale, ReadsDicomTimes) {
    EXPECT_EQ(*dicom::secondsAt("20240301", "000000") - *dicom::secondsAt("20240229", "2359"),
              60.0);
    EXPECT_NEAR(*dicom::secondsAt("20240301", "120000.25") - *dicom::secondsAt("20240301", "12"),
                0.25, 1e-5);
    for (const char *const bad : {"", "2024", "20241301", "20240230", "abcdefgh"})
        EXPECT_FALSE(dicom::secondsAt(bad, "12")) << bad;
    for (const char *const bad : {"", "1", "24", "ab", "10:45", "10:45:00", "104", "10450"})
        EXPECT_FALSE(dicom::secondsAt("20240301", bad)) << bad;
}

// A PET series as scanners write it: a rescale and a window of its own in each slice.
test::SeriesKnobs petSeries() {
    test::SeriesKnobs knobs;
    knobs.modality = "PT";
    knobs.value = [](int, int, int k) { return 1000 * (k + 1); };
    knobs.window = [](int k) { return glm::dvec2(500.0 * (k + 1), 1000.0 * (k + 1)); };
    knobs.change = [](test::DicomWriter &w, int k) {
        w.put({0x0008, 0x0016}, "UI", std::string("1.2.840.10008.5.1.4.1.1.128"));
        w.put({0x0008, 0x0021}, "DA", std::string("20260115"));
        w.put({0x0008, 0x0022}, "DA", std::string("20260115"));
        w.put({0x0008, 0x0031}, "TM", std::string("103000.00"));
        w.put({0x0008, 0x0032}, "TM", std::string("103000.00"));
        w.putNumbers({0x0010, 0x1030}, {70.0});
        w.put({0x0054, 0x1001}, "CS", std::string("BQML"));
        w.put({0x0054, 0x1102}, "CS", std::string("START"));
        w.put({0x0028, 0x0051}, "CS", std::string("DECY\\ATTN\\SCAT"));
        w.putNumbers({0x0028, 0x1052}, {0.0});
        w.putNumbers({0x0028, 0x1053}, {0.5 + 0.25 * k});
        test::DicomWriter dose;
        dose.put({0x0018, 0x1072}, "TM", std::string("093000.00"));
        dose.putNumbers({0x0018, 0x1074}, {3.7e8});
        dose.putNumbers({0x0018, 0x1075}, {6586.2});
        w.putSequence({0x0054, 0x0016}, {dose});
    };
    return knobs;
}

TEST(UptakeScale, ASeriesIsLoadedInUptakeValues) {
    const test::TemporaryFolder folder;
    test::writeSeries(folder.path(), petSeries());
    const auto catalogue = dicom::scan({folder.path()});
    const dicom::VolumeEntry &entry = *dicom::defaultSelection(catalogue).volume;
    EXPECT_EQ(entry.unit, ValueUnit::uptake);
    EXPECT_TRUE(entry.notes.darkIsHigh);
    EXPECT_TRUE(entry.notes.windows.empty()); // each slice has another one
    const volume::Volume volume = dicom::loadVolume(entry).volume;
    const double factor = factorAtInjection * std::exp2(3600.0 / 6586.2);
    for (int k = 0; k < 6; ++k) {
        const double expected = 1000.0 * (k + 1) * (0.5 + 0.25 * k) * factor;
        EXPECT_NEAR(volume.value({4, 3, k}), expected, 1e-6 * expected) << k;
    }
}

TEST(UptakeScale, ASeriesWithoutAWeightIsAnActivityAndSaysWhy) {
    const test::TemporaryFolder folder;
    test::SeriesKnobs knobs = petSeries();
    knobs.change = [change = knobs.change](test::DicomWriter &w, int k) {
        change(w, k);
        w.remove({0x0010, 0x1030});
    };
    test::writeSeries(folder.path(), knobs);
    const auto catalogue = dicom::scan({folder.path()});
    const dicom::VolumeEntry &entry = *dicom::defaultSelection(catalogue).volume;
    EXPECT_EQ(entry.unit, ValueUnit::activity);
    ASSERT_FALSE(entry.notes.warnings.empty());
    EXPECT_EQ(entry.notes.warnings.front().english(),
              "the values are not SUV: the patient's weight is missing or implausible");
    EXPECT_NEAR(dicom::loadVolume(entry).volume.value({0, 0, 1}), 2000.0 * 0.75, 1e-3);
}

// Two phases, and a series time of the reconstruction: START means the first acquisition of all.
TEST(UptakeScale, LaterPhasesReferToTheStartOfTheirSeries) {
    const test::TemporaryFolder folder;
    test::SeriesKnobs knobs = petSeries();
    knobs.value = [](int, int, int) { return 1000; };
    knobs.change = [change = knobs.change](test::DicomWriter &w, int k) {
        change(w, k);
        w.put({0x0008, 0x0031}, "TM", std::string("180000"));
        w.put({0x0008, 0x0032}, "TM", std::string(k < 3 ? "103000" : "113000"));
        w.put({0x0020, 0x0100}, "IS", std::string(k < 3 ? "1" : "2"));
        w.putNumbers({0x0020, 0x0032}, {-5.0, 7.0, 2.0 * (k % 3)});
        w.putNumbers({0x0028, 0x1053}, {1.0});
    };
    test::writeSeries(folder.path(), knobs);
    const auto catalogue = dicom::scan({folder.path()});
    const auto all = dicom::selections(catalogue);
    ASSERT_EQ(all.size(), 2U);
    const double factor = factorAtInjection * std::exp2(3600.0 / 6586.2);
    for (const dicom::Selection &s : all)
        EXPECT_NEAR(s.volume->valueFactor, factor, 1e-6 * factor);
}

TEST(Windows, OfSlicesThatDisagreeAreNotThoseOfTheSeries) {
    const test::TemporaryFolder folder;
    test::SeriesKnobs knobs;
    knobs.modality = "MR";
    knobs.window = [](int k) { return glm::dvec2(11.0 + 50.0 * k, 22.0 + 100.0 * k); };
    test::writeSeries(folder / "different", knobs);
    knobs.window = [](int k) { return glm::dvec2(300.0 + k, 600.0); };
    test::writeSeries(folder / "alike", knobs);
    const auto windows = [&](const char *name) {
        const auto catalogue = dicom::scan({folder / name});
        return dicom::defaultSelection(catalogue).volume->notes.windows;
    };
    EXPECT_TRUE(windows("different").empty());
    ASSERT_EQ(windows("alike").size(), 1U);
    EXPECT_EQ(windows("alike")[0].width, 600.0);
}

} // namespace

} // namespace pellucid
