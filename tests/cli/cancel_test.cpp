// SPDX-License-Identifier: GPL-3.0-or-later
// How soon work ends that is asked to.
#include <chrono>
#include <functional>
#include <iostream>
#include <map>
#include <mutex>

#include "core/decoder/decoder.h"
#include "core/decoder/unpack_archive.h"
#include "core/dicom/load_volume.h"
#include "core/dicom/scan.h"
#include "core/prepare/prepared_engine.h"
#include "core/preprocess/step_cache.h"
#include "core/presets/preset_library.h"
#include "core/volume/nrrd.h"
#include "tests/cli/faults.h"

namespace pellucid {

using namespace test;

// Wherever work is when it is asked to stop, it does little more, and leaves no file that is not
// whole. (The window does not wait for it: see cancelGivesTheProgramBackAtOnce.)
TEST_F(Faults, CancellingIsPossibleAtEveryStage) {
    const fs::path in = series("head", 160, 256), out = folder / "out.nrrd";
    const fs::path archive = folder / "head.zip", unpacked = folder / "unpacked";
    ASSERT_EQ(
        run("cd " + quoted(folder.path()) + " && python3 -m zipfile -c head.zip head").exitCode, 0);
    const auto catalogue = dicom::scan({in});
    const dicom::VolumeEntry &entry = *dicom::defaultSelection(catalogue).volume;
    const volume::Volume volume = dicom::loadVolume(entry).volume;
    const classify::FieldWindow window{-900.0, 2000.0};
    const classify::Look tissues =
        presets::lookFor(presets::PresetLibrary({}).get("Bone over soft tissue").preset, window);
    const classify::ShownFields fields{{classify::densityField(volume, window)}, {}};
    scene::Scene scene;
    scene.tolerance = 1e-4;
    using Stage = std::function<void(const task::Progress &)>;
    const std::map<std::string, Stage> stages{
        {"unpacking",
         [&](const task::Progress &progress) {
             fs::create_directories(unpacked);
             decoder::unpackArchive(decoder::Decoder::shared(), archive, unpacked, progress);
         }},
        {"headers", [&](const task::Progress &progress) { dicom::scan({in}, progress); }},
        {"pixels", [&](const task::Progress &progress) { dicom::loadVolume(entry, progress); }},
        {"classes",
         [&](const task::Progress &progress) {
             preprocess::StepCache steps(0);
             classify::shownFields(volume, window, tissues, &steps, progress);
         }},
        {"spectra",
         [&](const task::Progress &progress) {
             prepare::prepareEngine(scene, fields, {}, progress);
         }},
        {"writing", [&](const task::Progress &progress) {
             volume::writeNrrd(out, volume, volume::NrrdEncoding::gzip, progress);
         }}};
    using Clock = std::chrono::steady_clock;
    const auto millisecondsSince = [](Clock::time_point start) {
        return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    };
    for (const auto &[name, stage] : stages) {
        stage({}); // plans of transforms are made once
        const auto start = Clock::now();
        stage({});
        const double wholeMs = millisecondsSince(start);
        double slowestMs = 0.0;
        for (const double share : {0.0, 0.2, 0.4}) {
            fs::remove(out);
            fs::remove_all(unpacked);
            std::stop_source stop;
            Clock::time_point asked;
            std::mutex mutex; // stages report from several threads
            const task::Progress progress(stop.get_token(), [&](double done) {
                const std::lock_guard lock(mutex);
                if (done < share || stop.stop_requested())
                    return;
                asked = Clock::now();
                stop.request_stop();
            });
            EXPECT_THROW(stage(progress), task::Cancelled) << name << " at " << share;
            slowestMs = std::max(slowestMs, millisecondsSince(asked));
            EXPECT_FALSE(fs::exists(out));
        }
        std::cout << name << ": " << wholeMs << " ms, at most " << slowestMs
                  << " ms after it was asked to\n";
        EXPECT_LT(slowestMs, wholeMs) << name;
    }
}

} // namespace pellucid
