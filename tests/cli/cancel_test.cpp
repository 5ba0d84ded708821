// SPDX-License-Identifier: GPL-3.0-or-later
// Cancelled work ends soon.
#include <algorithm>
#include <chrono>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <mutex>
#include <optional>

#include "core/decoding/client/decoder.h"
#include "core/decoding/client/unpack_archive.h"
#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/prepare/prepared_engine.h"
#include "core/preprocess/step_cache.h"
#include "core/presets/preset_library.h"
#include "core/volume/nrrd.h"
#include "tests/cli/faults.h"

namespace pellucid {

using namespace test;

namespace {

using Clock = std::chrono::steady_clock;
using Stage = std::function<void(const task::Progress &)>;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// A series and the stages of the work on it.
struct Work {
    fs::path series, many, archive, unpacked, out;
    dicom::VolumeEntry entry;
    volume::Volume volume;
    classify::FieldWindow window{-900.0, 2000.0};
    classify::ShownFields fields;

    std::map<std::string, Stage> stages() const {
        return {
            {"unpacking",
             [this](const task::Progress &progress) {
                 fs::remove_all(unpacked);
                 fs::create_directories(unpacked);
                 decoding::unpackArchive(decoding::Decoder::shared(), archive, unpacked, progress);
             }},
            {"headers", [this](const task::Progress &progress) { dicom::scan({many}, progress); }},
            {"pixels",
             [this](const task::Progress &progress) { dicom::loadVolume(entry, progress); }},
            {"classes",
             [this](const task::Progress &progress) {
                 preprocess::StepCache steps(0);
                 classify::shownFields(
                     volume, window,
                     presets::lookFor(
                         presets::PresetLibrary({}).get("Bone over soft tissue").preset, window),
                     &steps, progress);
             }},
            {"spectra",
             [this](const task::Progress &progress) {
                 scene::Scene scene;
                 scene.tolerance = 1e-4;
                 prepare::prepareEngine({scene, fields}, progress);
             }},
            {"writing", [this](const task::Progress &progress) {
                 fs::remove(out);
                 volume::writeNrrd(out, volume, volume::NrrdEncoding::gzip, progress);
             }}};
    }
};

double millisecondsOf(const Stage &stage) {
    const auto start = Clock::now();
    stage({});
    return millisecondsSince(start);
}

// The time from asking the stage to stop, at a share of its work, to its end. *Units*: ms.
double millisecondsAfterCancel(const Stage &stage, double share, const std::string &name) {
    std::stop_source stop;
    std::optional<Clock::time_point> asked;
    std::mutex mutex; // stages report from several threads
    const task::Progress progress(stop.get_token(), [&](double done) {
        const std::lock_guard lock(mutex);
        if (done < share || asked)
            return;
        asked = Clock::now();
        stop.request_stop();
    });
    EXPECT_THROW(stage(progress), task::Cancelled) << name << " at " << share;
    EXPECT_TRUE(asked) << name << " does not report " << share;
    return asked ? millisecondsSince(*asked) : std::numeric_limits<double>::infinity();
}

class Cancel : public Faults {
protected:
    Work workOf(const std::string &name, int slices) {
        Work work;
        work.series = series(name, slices, 256);
        work.many = folder / (name + " many");
        work.archive = folder / (name + ".zip");
        work.unpacked = folder / (name + " unpacked");
        work.out = folder / (name + ".nrrd");
        // Reading a header takes little time, so each file has ten names.
        fs::create_directories(work.many);
        for (const auto &entry : fs::directory_iterator(work.series))
            for (int n = 0; n < 10; ++n)
                fs::create_hard_link(entry.path(), work.many / (std::to_string(n) +
                                                                entry.path().filename().string()));
        EXPECT_EQ(run("cd " + quoted(folder.path()) + " && python3 -m zipfile -c " +
                      quoted(work.archive) + " " + quoted(fs::path(name)))
                      .exitCode,
                  0);
        work.entry = *dicom::defaultSelection(dicom::scan({work.series})).volume;
        work.volume = dicom::loadVolume(work.entry).volume;
        work.fields = {{classify::densityField(work.volume, work.window)}, {}};
        return work;
    }
};

} // namespace

// Work that is asked to stop does little more, wherever it is: at most three times the work on an
// eighth of the series. Work that stops only at its end takes eight times as long as an eighth. No
// partial file is left. (The window does not wait for it: see cancelTakesEffectAtOnce.)
TEST_F(Cancel, EveryStageEndsSoon) {
    const Work whole = workOf("whole", 160), eighth = workOf("eighth", 20);
    const auto stages = whole.stages(), parts = eighth.stages();
    for (const auto &[name, stage] : stages) {
        stage({}); // transforms are planned once
        const Stage &part = parts.at(name);
        part({});
        const double maxMs = 3.0 * std::min(millisecondsOf(part), millisecondsOf(part));
        double slowestMs = 0.0;
        for (const double share : {0.0, 0.2, 0.4}) {
            // The measurement is repeated, because the machine may have been busy for a moment.
            double fastestMs = std::numeric_limits<double>::infinity();
            for (int attempt = 0; attempt < 3 && fastestMs > maxMs; ++attempt) {
                fastestMs = std::min(fastestMs, millisecondsAfterCancel(stage, share, name));
                EXPECT_FALSE(fs::exists(whole.out));
            }
            slowestMs = std::max(slowestMs, fastestMs);
        }
        std::cout << name << ": " << slowestMs << " ms after it was asked to, of " << maxMs
                  << " that it may take\n";
        EXPECT_LT(slowestMs, maxMs) << name;
    }
}

} // namespace pellucid
