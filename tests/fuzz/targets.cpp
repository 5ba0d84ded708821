// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/targets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <QCoreApplication>

#include "core/batch/recipe.h"
#include "core/decoding/client/message.h"
#include "core/decoding/client/reasons.h"
#include "core/decoding/process/parse.h"
#include "core/dicom/group_series.h"
#include "core/fourier/spectrum.h"
#include "core/fourier/transforms/wisdom.h"
#include "core/measure/measurement.h"
#include "core/presets/preset.h"
#include "core/presets/slicer_preset.h"
#include "core/scene/scene.h"
#include "core/task/error.h"
#include "tests/fuzz/network_targets.h"
#include "tests/support/temporary_folder.h"
#include "ui/library/library.h"
#include "ui/opening/session.h"

namespace pellucid::fuzz {

namespace {

namespace fs = std::filesystem;
using Bytes = std::span<const std::byte>;

void check(bool holds) {
    if (!holds)
        std::abort();
}

std::string textOf(Bytes bytes) {
    return {reinterpret_cast<const char *>(bytes.data()), bytes.size()};
}

// The same file is reused: making a new one each time would take most of the time.
fs::path fileOf(Bytes bytes, const char *name) {
    static const test::TemporaryFolder folder;
    const fs::path path = folder / name;
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char *>(bytes.data()), std::streamsize(bytes.size()));
    return path;
}

template <class F> void refusing(F &&f) {
    try {
        f();
    } catch (const task::Error &error) {
        check(!error.reason().english().empty());
    }
}

// Goes from the bytes of a file to the lattice of a volume, through the messages between decoder
// and program.
void dicom(Bytes bytes) {
    refusing([&] {
        const auto header = decoding::process::parseHeader(bytes);
        const std::string packed = decoding::pack(header);
        const auto received =
            decoding::unpack<decoding::InstanceHeader>(std::as_bytes(std::span(packed)));
        check(decoding::pack(received) == packed);
        if (decoding::whyUnusable(received))
            return;
        // A stack of the slice and two shifted copies.
        std::vector<dicom::SeriesFile> files;
        for (int n = 0; n < 3; ++n) {
            dicom::SeriesFile file{"slice" + std::to_string(n), received};
            file.header.sopInstanceUid += std::to_string(n);
            for (auto &frame : file.header.frames)
                if (frame.positionMm)
                    *frame.positionMm += glm::dvec3(0.0, 0.0, 2.0 * n);
            files.push_back(std::move(file));
        }
        std::vector<dicom::Skipped> skipped;
        for (const auto &entry : dicom::groupSeries(files, skipped)) {
            check(!entry.frames.empty());
            check(entry.geometry.lattice.size().i == received.columns);
        }
    });
    refusing([&] {
        const std::string packed = decoding::pack(decoding::process::listAttributes(bytes));
        const auto received =
            decoding::unpack<decoding::AttributeList>(std::as_bytes(std::span(packed)));
        check(decoding::pack(received) == packed);
    });
    refusing([&] {
        const auto image = decoding::process::decodeImage(bytes);
        check(!decoding::whyUnusable(image.header));
        check(image.samples.size() == std::size_t(image.header.rows) *
                                          std::size_t(image.header.columns) *
                                          image.header.frames.size());
    });
}

void directory(Bytes bytes) {
    refusing([&] { decoding::pack(decoding::process::parseDirectory(bytes)); });
}

void archive(Bytes bytes) {
    refusing([&] {
        decoding::process::listArchive(bytes, [](const decoding::ArchiveFile &) {});
        std::size_t total = 0;
        decoding::process::readArchive(
            bytes, [&](const decoding::ArchiveFile &, Bytes part, std::int32_t) {
                total += part.size();
                if (total > (std::size_t(1) << 26)) // the program's own limit is elsewhere
                    throw task::Error(task::ErrorCode::unusable,
                                      task::because::unpacksToMoreThanAnnounced);
            });
    });
}

void message(Bytes bytes) {
    refusing([&] {
        const auto header = decoding::unpack<decoding::InstanceHeader>(bytes);
        check(!header.frames.empty());
    });
    refusing([&] { decoding::unpack<decoding::DirectoryFile>(bytes); });
    refusing([&] { decoding::unpack<decoding::AttributeList>(bytes); });
    refusing([&] { decoding::unpack<std::vector<decoding::ArchiveFile>>(bytes); });
    refusing([&] { decoding::unpack<decoding::VolumeLayout>(bytes); });
    refusing([&] {
        const task::Reason reason = decoding::unpackReason(bytes);
        const std::string again = reason.encoded();
        check(decoding::unpackReason(std::as_bytes(std::span(again))) == reason);
        (void)reason.english();
    });
}

void nrrd(Bytes bytes) {
    refusing([&] {
        const auto layout = decoding::process::parseVolumeLayout(bytes);
        const std::string packed = decoding::pack(layout);
        const auto received =
            decoding::unpack<decoding::VolumeLayout>(std::as_bytes(std::span(packed)));
        check(decoding::pack(received) == packed);
        (void)volume::Lattice::make(received.size, {received.originMm}, received.stepsMm);
        const std::size_t each = decoding::bytesOf(layout.scalar);
        if (layout.size.count() > (1U << 24) || !layout.dataFile.empty())
            return;
        std::size_t left = layout.size.count() * each;
        decoding::process::readSamples(
            bytes, {left, int(each), layout.isDeflated, layout.isSwapped, layout.at, layout.skip},
            [&](Bytes part, bool) {
                check(!part.empty() && part.size() <= left && part.size() % each == 0);
                left -= part.size();
            });
        check(left == 0);
    });
}

void preset(Bytes bytes) {
    refusing([&] {
        const auto preset = presets::presetFromJson(textOf(bytes));
        // An accepted preset can be saved and read back unchanged.
        const std::string kept = presets::toJson(preset);
        check(presets::toJson(presets::presetFromJson(kept)) == kept);
    });
}

void scene(Bytes bytes) {
    refusing([&] {
        const auto scene = scene::sceneFromJson(textOf(bytes));
        const std::string kept = scene::toJson(scene);
        check(scene::toJson(scene::sceneFromJson(kept)) == kept);
    });
}

void recipe(Bytes bytes) {
    refusing([&] {
        const batch::Recipe read = batch::recipeFromJson(textOf(bytes), {});
        check(read.digest == batch::recipeFromJson(textOf(bytes), {}).digest);
        for (const batch::Output &output : read.outputs)
            check(!batch::filesOf(output).empty() && !output.views.empty());
        check(batch::explained(read).size() == read.outputs.size() + 1);
    });
}

void viewList(Bytes bytes) {
    refusing([&] {
        const scene::ViewList list = scene::viewListFromJson(textOf(bytes));
        scene::Camera base;
        if (list.size)
            base.width = (*list.size)[0], base.height = (*list.size)[1];
        const auto lattice = volume::Lattice::centred({4, 5, 6}, {1.0, 1.0, 2.0});
        for (const scene::ViewList::View &view : list.views) {
            // What is accepted is a rotation, and its matrix is understood.
            const scene::Camera camera = scene::cameraOf(view, base, lattice);
            check(std::abs(glm::length(camera.orientation) - 1.0) < 1e-9);
            check(camera.pixelMm > 0.0 && std::isfinite(camera.pixelMm));
            scene::pixelMmOf(scene::projectionMatrix(camera, lattice));
        }
    });
}

void measurements(Bytes bytes) {
    refusing([&] { measure::toJson(measure::measurementsFromJson(textOf(bytes))); });
}

void slicerPreset(Bytes bytes) {
    refusing([&] { presets::importSlicerPreset(fileOf(bytes, "property.vp")); });
}

void slicerPresetJson(Bytes bytes) {
    refusing([&] { presets::importSlicerPreset(fileOf(bytes, "property.vp.json")); });
}

void session(Bytes bytes) {
    refusing([&] {
        const std::string kept = ui::toJson(ui::sessionFromJson(textOf(bytes)));
        check(ui::toJson(ui::sessionFromJson(kept)) == kept);
    });
}

// The list of a study library is read, rebuilt or left alone; then it can be searched.
void library(Bytes bytes) {
    needApplication();
    const test::TemporaryFolder folder;
    const ui::LibraryPlace place{folder.path()};
    std::ofstream(place.listFile(), std::ios::binary)
        .write(reinterpret_cast<const char *>(bytes.data()), std::streamsize(bytes.size()));
    const ui::OpenedLibrary opened = ui::openLibrary(folder.path());
    refusing([&] {
        ui::Library list(opened.place);
        for (const auto &study : list.find("a", ui::StudyOrder::newestFirst, 0, 50).studies) {
            for (const auto &volume : list.volumes(study))
                list.files(study, volume);
            const auto copies = list.copiesOf(study);
            list.remove(study);
            list.removeCopies(copies);
        }
    });
}

// FFTW reads this file: wrong wisdom must not make transforms wrong.
void wisdom(Bytes bytes) {
    refusing([&] { fourier::keepWisdomIn(fileOf(bytes, "wisdom")); });
}

} // namespace

void needApplication() {
    static int count = 1;
    static std::array<char, 5> name{"fuzz"};
    static std::array<char *, 2> arguments{name.data(), nullptr};
    static const QCoreApplication application(count, arguments.data());
}

const std::vector<NamedTarget> &targets() {
    static const std::vector<NamedTarget> all{{"dicom", dicom},
                                              {"directory", directory},
                                              {"archive", archive},
                                              {"message", message},
                                              {"nrrd", nrrd},
                                              {"preset", preset},
                                              {"scene", scene},
                                              {"recipe", recipe},
                                              {"view_list", viewList},
                                              {"measurements", measurements},
                                              {"slicer_preset", slicerPreset},
                                              {"slicer_preset_json", slicerPresetJson},
                                              {"session", session},
                                              {"library", library},
                                              {"wisdom", wisdom},
                                              {"packing", packing},
                                              {"network_message", networkMessage},
                                              {"packet", packet},
                                              {"control", control},
                                              {"multipart", multipart},
                                              {"dicom_json", dicomJson},
                                              {"file_start", fileStart}};
    return all;
}

} // namespace pellucid::fuzz
