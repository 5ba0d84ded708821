// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/corpus.h"

#include <archive.h>
#include <archive_entry.h>

#include "core/batch/recipe.h"
#include "core/decoding/client/message.h"
#include "core/decoding/process/parse.h"
#include "core/decoding/process/reasons.h"
#include "core/dicom/write_capture.h"
#include "core/dicom/write_series.h"
#include "core/measure/measurement.h"
#include "core/phantom/phantom.h"
#include "core/presets/preset_library.h"
#include "core/scene/scene.h"
#include "core/task/reason.h"
#include "core/task/reasons.h"
#include "core/volume/nrrd.h"
#include "tests/fuzz/network_corpus.h"
#include "tests/fuzz/targets.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"
#include "ui/library/library.h"
#include "ui/opening/session.h"

namespace pellucid::fuzz {

namespace {

namespace fs = std::filesystem;
using test::writeText;

volume::Volume smallVolume() {
    return phantom::makePhantom(
        phantom::Kind::head,
        phantom::phantomLattice(phantom::Kind::head, {.size = volume::GridSize{24, 20, 2}}));
}

void writeDicom(const fs::path &folder) {
    using Syntax = dicom::TransferSyntax;
    for (const Syntax syntax :
         {Syntax::implicitLittle, Syntax::explicitLittle, Syntax::explicitBig, Syntax::deflated,
          Syntax::rle, Syntax::jpegLossless, Syntax::jpegLs, Syntax::jpeg2000}) {
        const fs::path series = folder / "series";
        dicom::writeCtSeries(series, smallVolume(),
                             {.patientName = "Fuzz^Jane", .windows = {{40, 400, "soft"}}}, syntax);
        fs::rename(series / "IM0001.dcm", folder / ("syntax" + std::to_string(int(syntax))));
        fs::remove_all(series);
    }
    const std::vector<std::uint8_t> rgba(16 * 8 * 4, 90);
    dicom::writeCapture(folder / "capture", rgba, 8, 16, {.patientName = "Fuzz^Jane"});
}

void append(std::string &out, unsigned group, unsigned element, const char *vr,
            const std::string &value) {
    const auto put16 = [&](unsigned v) {
        out += char(v & 0xFF);
        out += char(v >> 8 & 0xFF);
    };
    put16(group);
    put16(element);
    out += vr;
    const std::string padded = value.size() % 2 == 0 ? value : value + ' ';
    if (std::string_view(vr) == "SQ") {
        put16(0);
        put16(unsigned(padded.size()));
        put16(0);
    } else {
        put16(unsigned(padded.size()));
    }
    out += padded;
}

void writeDirectory(const fs::path &folder) {
    std::string record, item, sequence, meta, file(128, '\0');
    append(record, 0x0004, 0x1430, "CS", "IMAGE");
    append(record, 0x0004, 0x1500, "CS", "DISC\\SERIES\\IM0001");
    item = std::string("\xFE\xFF\0\xE0", 4) + char(record.size()) + std::string(3, '\0') + record;
    sequence = item + item;
    append(meta, 0x0002, 0x0002, "UI", std::string("1.2.840.10008.1.3.10\0", 21));
    append(meta, 0x0002, 0x0010, "UI", std::string("1.2.840.10008.1.2.1\0", 20));
    file += "DICM" + meta;
    append(file, 0x0004, 0x1220, "SQ", sequence);
    writeText(folder / "dicomdir", file);
}

void writeArchives(const fs::path &folder) {
    for (const char *const options : {"zip:store", "zip:compression=deflate"}) {
        struct archive *writer = archive_write_new();
        archive_write_set_format_zip(writer);
        archive_write_set_options(writer, options);
        const fs::path path = folder / std::to_string(std::string_view(options).size());
        archive_write_open_filename(writer, path.c_str());
        for (const char *const name : {"a/b.dcm", "../c"}) {
            struct archive_entry *entry = archive_entry_new();
            archive_entry_set_pathname(entry, name);
            archive_entry_set_filetype(entry, AE_IFREG);
            archive_entry_set_perm(entry, 0644);
            const std::string text(300, 'x');
            archive_entry_set_size(entry, la_int64_t(text.size()));
            archive_write_header(writer, entry);
            archive_write_data(writer, text.data(), text.size());
            archive_entry_free(entry);
        }
        archive_write_close(writer);
        archive_write_free(writer);
    }
}

void writeMessages(const fs::path &folder) {
    const fs::path dicom = folder / "dicom";
    fs::create_directory(dicom);
    writeDicom(dicom);
    writeText(folder / "header",
              decoding::pack(decoding::process::parseHeader(test::readBytes(dicom / "syntax1"))));
    writeText(folder / "attributes", decoding::pack(decoding::process::listAttributes(
                                         test::readBytes(dicom / "syntax1"))));
    fs::remove_all(dicom);
    writeText(folder / "directory", decoding::pack(decoding::DirectoryFile{true, {{"A", "B"}}}));
    decoding::VolumeLayout nrrd;
    nrrd.size = {4, 3, 2};
    nrrd.stepsMm = {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};
    nrrd.dataFile = "samples.raw";
    writeText(folder / "nrrd", decoding::pack(nrrd));
    writeText(folder / "reason",
              task::because::jpeg2000(task::because::isDamagedBy("text")).encoded());
    writeText(folder / "archive",
              decoding::pack(std::vector<decoding::ArchiveFile>{{"name", 7, false}}));
}

void writePresets(const fs::path &folder) {
    const auto library = presets::PresetLibrary::ofUser();
    for (const auto &entry : library.entries())
        if (entry.isBuiltIn())
            writeText(folder / entry.preset.name, presets::toJson(entry.preset));
}

void writeRecipes(const fs::path &folder) {
    writeText(folder / "smallest",
              R"({"recipe": 1, "outputs": [{"view": "front", "format": "npy"}]})");
    writeText(folder / "views", R"({"recipe": 1, "series": {"modality": ["CT", "MR"],
        "slice_mm": [0.5, 3], "description": "*a?", "min_slices": 9}, "outputs": [
        {"name": "a", "views": {"size": [9, 8], "views": ["RAO30", {"primary_deg": 5}]}},
        {"name": "b", "turntable": 7, "view": "LAO30,CRA20", "format": "mp4", "size": 12},
        {"name": "c", "look": "Bone", "tolerance": "fine", "pixel_mm": 0.5, "deidentify": true,
         "without_couch": true, "format": "dicom"}]})");
    const auto library = presets::PresetLibrary({});
    writeText(folder / "scene", batch::recipeOf({}, library.get("Bone").preset,
                                                batch::Format::captureLoop, 12, false));
}

void writeViewLists(const fs::path &folder) {
    writeText(folder / "list", R"({"size": [64, 48], "pixel_mm": 0.5, "views": ["RAO30,CRA20",
        {"primary_deg": -30, "secondary_deg": 20, "roll_deg": 7},
        {"matrix": [[2, 0, 0, 10], [0, 0, -2, 20], [0, 0, 0, 1]]}]})");
}

void writeScenes(const fs::path &folder) {
    scene::Scene scene;
    writeText(folder / "plain", scene::toJson(scene));
    const auto library = presets::PresetLibrary::ofUser();
    for (const auto &entry : library.entries()) {
        if (!entry.isBuiltIn())
            continue;
        scene.fieldWindow = entry.preset.window;
        scene.look =
            presets::lookFor(entry.preset, entry.preset.window.value_or(classify::FieldWindow()));
        scene.shading = entry.preset.shading;
        writeText(folder / entry.preset.name, scene::toJson(scene));
    }
}

void writeMeasurements(const fs::path &folder) {
    const mpr::Axes axes = mpr::standardAxes(mpr::Orientation::axial);
    writeText(
        folder / "three",
        measure::toJson({{measure::Kind::distance, "one", {{0, 0, 0}, {1, 2, 3}}, axes},
                         {measure::Kind::angle, "two", {{0, 0, 0}, {1, 2, 3}, {4, 5, 6}}, axes},
                         {measure::Kind::ellipse, "", {{-1, 0, 0}, {5, 2, 0}}, axes}}));
}

void writeSessions(const fs::path &folder) {
    ui::Session session;
    session.files = {"/a/b.dcm", "/a/c.dcm"};
    session.key = "0123456789abcdef";
    session.view.exposure = {scene::Exposure(), picture::ToneSubject(session.view.scene)};
    writeText(folder / "files", ui::toJson(session));
    session.files.clear();
    session.phantom = "head";
    session.hasEnded = true;
    writeText(folder / "phantom", ui::toJson(session));
}

void writeLibrary(const fs::path &folder) {
    needApplication();
    const test::TemporaryFolder place;
    ui::LibrarySeries series;
    series.study.patientName = "Fuzz^Jane";
    series.study.uid = "1.2.3";
    series.volumes.resize(2);
    series.files = {{"/a/b.dcm", "1.2.3.1"}, {"/a/c.dcm", "1.2.3.2"}};
    ui::Library({place.path()}).put({series});
    fs::copy_file(ui::LibraryPlace{place.path()}.listFile(), folder / "list",
                  fs::copy_options::overwrite_existing); // a corpus is kept
}

void writeSlicer(const fs::path &folder) {
    writeText(folder / "vp", "1\n1\n0.9\n0.1\n0.2\n10\n8 -3024 0 100 0 1100 1 3071 1\n"
                             "4 0 1 255 1\n8 -3024 0 0 0 3071 1 1 1\n");
}

void writeSlicerJson(const fs::path &folder) {
    writeText(folder / "json", R"({"@schema":"volume-property-schema-v1.0.0.json#",
"volumeProperties":[{"name":"X","components":[{"rgbTransferFunction":{"points":[
{"x":-100,"color":[0.1,0.2,0.3]},{"x":900,"color":[1,1,1]}]},
"scalarOpacity":{"points":[{"x":-100,"y":0},{"x":900,"y":0.9}]}}]}]})");
}

} // namespace

void writeCorpus(const std::string &target, const fs::path &folder) {
    if (target == "dicom")
        writeDicom(folder);
    else if (target == "directory")
        writeDirectory(folder);
    else if (target == "archive")
        writeArchives(folder);
    else if (target == "message")
        writeMessages(folder);
    else if (target == "nrrd")
        for (const auto encoding : {volume::NrrdEncoding::raw, volume::NrrdEncoding::gzip})
            volume::writeNrrd(folder / ("volume" + std::to_string(int(encoding)) + ".nrrd"),
                              smallVolume(), encoding);
    else if (target == "preset")
        writePresets(folder);
    else if (target == "recipe")
        writeRecipes(folder);
    else if (target == "view_list")
        writeViewLists(folder);
    else if (target == "scene")
        writeScenes(folder);
    else if (target == "measurements")
        writeMeasurements(folder);
    else if (target == "slicer_preset")
        writeSlicer(folder);
    else if (target == "slicer_preset_json")
        writeSlicerJson(folder);
    else if (target == "session")
        writeSessions(folder);
    else if (target == "library")
        writeLibrary(folder);
    else if (target == "wisdom")
        writeText(folder / "wisdom",
                  "(fftw-3.3.10 fftwf_wisdom #x458a31c8 #x92381c4c #x4f974889 #xcd46f97e\n"
                  "  (fftwf_codelet_n1fv_64_avx2 0 #x11048 #x11048 #x0 #x2f9d9d2d #x0f0f0f0f "
                  "#x12345678 #x87654321)\n)\n");
    else
        writeNetworkCorpus(target, folder);
}

} // namespace pellucid::fuzz
