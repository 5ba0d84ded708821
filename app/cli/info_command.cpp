// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/cli/input.h"
#include "app/cli/json_text.h"
#include "app/cli/terminal.h"
#include "core/decoding/client/decoder.h"
#include "core/dicom/scan.h"
#include "core/segment/segmentation.h"
#include "core/task/error.h"

namespace pellucid::cli {

namespace {

using nlohmann::json;

constexpr double degrees = 180.0 / 3.14159265358979323846;

const char *nameOf(volume::WindowFunction function) {
    switch (function) {
    case volume::WindowFunction::sigmoid:
        return "sigmoid";
    case volume::WindowFunction::table:
        return "table";
    case volume::WindowFunction::linear:
        return "linear";
    case volume::WindowFunction::linearExact:
        break;
    }
    return "linear exact";
}

json volumeJson(const dicom::VolumeEntry &v) {
    const volume::Lattice &l = v.geometry.lattice;
    json windows = json::array();
    for (const auto &w : v.notes.windows)
        windows.push_back({{"center", w.center},
                           {"width", w.width},
                           {"name", w.name},
                           {"function", nameOf(w.function)}});
    const auto vector = [](const glm::dvec3 &x) { return json{x.x, x.y, x.z}; };
    // Sizes and positions that the files do not state are null.
    const auto ifKnown = [](bool isKnown, const json &value) { return isKnown ? value : json(); };
    json out = {
        {"label", dicom::labelText(v.label)},
        {"volume", v.placed},
        {"size", {l.size().i, l.size().j, l.size().k}},
        {"spacing_mm",
         {ifKnown(v.notes.hasSpacing, l.spacingMm(0)), ifKnown(v.notes.hasSpacing, l.spacingMm(1)),
          ifKnown(v.notes.hasDepth, l.sliceDistanceMm())}},
        {"spacing_place", volume::spacingPlaceName(v.notes.spacingPlace)},
        {"tilt_deg", ifKnown(v.placed, l.shearRad() * degrees)},
        {"origin_mm", ifKnown(v.placed, vector(l.origin().mm))},
        {"steps_mm", ifKnown(v.placed, {vector(l.step(0)), vector(l.step(1)), vector(l.step(2))})},
        {"frames", v.frames.size()},
        {"gaps_filled", v.fillsHoles},
        {"resampled", !v.geometry.frameOffsetsMm.empty()},
        {"unit", volume::unitName(v.unit)},
        {"lossy", v.notes.lossy},
        {"windows", windows},
        {"warnings", englishTexts(v.notes.warnings)}};
    if (!v.placed)
        out["reason"] = v.notPlacedReason->english();
    return out;
}

// ", 0.500 x 0.500 x 2.000 mm"; of images the distance between slices has no meaning.
std::string spacingText(const dicom::VolumeEntry &v) {
    if (!v.notes.hasSpacing)
        return ", pixels of unknown size";
    const volume::Lattice &l = v.geometry.lattice;
    const std::string_view place = volume::spacingPlaceName(v.notes.spacingPlace);
    return fmt::format(", {:.3f} x {:.3f}{} mm{}{}", l.spacingMm(0), l.spacingMm(1),
                       v.notes.hasDepth ? fmt::format(" x {:.3f}", l.sliceDistanceMm()) : "",
                       place.empty() ? "" : " ", place);
}

// The names of a file's segments, or why it cannot be read.
struct SegmentNames {
    std::vector<std::string> names;
    std::optional<task::Reason> reason;
};

SegmentNames segmentNames(const dicom::SegmentationFile &file, const Context &context) {
    try {
        return {segment::segmentNames(file.path, task::Progress(context.stop)), std::nullopt};
    } catch (const task::Error &error) {
        return {{}, error.reason()};
    }
}

json segmentationJson(const dicom::Catalogue &catalogue, const dicom::SegmentationFile &file,
                      const Context &context) {
    const SegmentNames segments = segmentNames(file, context);
    json out = {{"path", catalogue.named(file.path).string()},
                {"modality", file.modality},
                {"description", file.description},
                {"segments", segments.names}};
    if (segments.reason)
        out["reason"] = segments.reason->english();
    return out;
}

void printSegmentation(const dicom::Catalogue &catalogue, const dicom::SegmentationFile &file,
                       const Context &context) {
    const SegmentNames segments = segmentNames(file, context);
    fmt::print("    {} {}: {}\n", printable(file.modality), printable(file.description),
               printable(catalogue.named(file.path).string()));
    std::string names;
    for (const std::string &name : segments.names)
        names += (names.empty() ? "" : ", ") + name;
    fmt::print("      {}\n", segments.reason
                                 ? printable(segments.reason->english())
                                 : fmt::format("{}: {}", counted(segments.names.size(), "segment"),
                                               printable(names)));
}

json catalogueJson(const dicom::Catalogue &catalogue, const Context &context) {
    json patients = json::array();
    for (const auto &p : catalogue.patients) {
        json studies = json::array();
        for (const auto &s : p.studies) {
            json series = json::array();
            for (const auto &e : s.series) {
                json volumes = json::array();
                for (const auto &v : e.volumes) {
                    volumes.push_back(volumeJson(v));
                    volumes.back()["number"] = volumes.size();
                }
                series.push_back({{"uid", e.uid},
                                  {"number", e.number},
                                  {"description", e.description},
                                  {"modality", e.modality},
                                  {"body_part", e.bodyPart},
                                  {"volumes", volumes}});
            }
            json segmentations = json::array();
            for (const auto &file : s.segmentations)
                segmentations.push_back(segmentationJson(catalogue, file, context));
            studies.push_back({{"uid", s.uid},
                               {"date", s.date},
                               {"description", s.description},
                               {"series", series},
                               {"segmentations", segmentations}});
        }
        patients.push_back({{"id", p.id},
                            {"name", p.name},
                            {"birth_date", p.birthDate},
                            {"sex", p.sex},
                            {"studies", studies}});
    }
    json skipped = json::array();
    for (const auto &s : catalogue.skipped)
        skipped.push_back({{"path", s.path.string()}, {"reason", s.reason.english()}});
    return {{"patients", patients}, {"skipped", skipped}};
}

void printCatalogue(const dicom::Catalogue &catalogue, const Context &context) {
    for (const auto &p : catalogue.patients) {
        fmt::print("Patient {} ({})\n", p.name.empty() ? "without name" : printable(p.name),
                   printable(p.id));
        for (const auto &s : p.studies) {
            fmt::print("  Study {} {}\n", printable(s.date), printable(s.description));
            for (const auto &e : s.series) {
                fmt::print("    Series {} {} {}\n", e.number, printable(e.modality),
                           printable(e.description));
                for (const auto &v : e.volumes) {
                    const volume::Lattice &l = v.geometry.lattice;
                    const std::string number =
                        e.volumes.size() == 1 ? "" : fmt::format("{}. ", &v - e.volumes.data() + 1);
                    fmt::print("      {}{}{} x {} x {}{}{}{}\n", number,
                               v.label.empty() ? "" : printable(dicom::labelText(v.label)) + ": ",
                               l.size().i, l.size().j, l.size().k, spacingText(v),
                               v.unit == volume::ValueUnit::none
                                   ? ""
                                   : fmt::format(", {}", volume::unitName(v.unit)),
                               v.notes.lossy ? ", lossy" : "");
                    for (const auto &w : v.notes.warnings)
                        fmt::print("        {}\n", printable(w.english()));
                }
            }
            for (const auto &file : s.segmentations)
                printSegmentation(catalogue, file, context);
        }
    }
    if (!catalogue.skipped.empty())
        fmt::print("Not used ({}):\n", catalogue.skipped.size());
    for (const auto &s : dicom::problemsOf(catalogue))
        fmt::print("  {}: {}\n", printable(s.path.string()), printable(s.reason.english()));
}

void printHeaders(const std::vector<std::filesystem::path> &paths, bool asJson,
                  const Context &context) {
    json all = json::array();
    for (const std::filesystem::path &path : paths) {
        const decoding::AttributeList list =
            decoding::Decoder::shared().attributes(path, task::Progress(context.stop));
        json attributes = json::array();
        for (const decoding::Attribute &a : list.attributes) {
            const std::string indent(2 * std::size_t(a.depth), ' ');
            if (asJson)
                attributes.push_back({{"depth", a.depth},
                                      {"tag", tagText(a)},
                                      {"vr", a.vr},
                                      {"name", a.name},
                                      {"value", a.value}});
            else if (a.tag == 0)
                fmt::print("{}item {}\n", indent, printable(a.name));
            else
                fmt::print("{}{} {} {}: {}\n", indent, tagText(a), printable(a.vr),
                           printable(a.name), printable(a.value));
        }
        if (asJson)
            all.push_back({{"path", path.string()},
                           {"complete", list.isComplete},
                           {"attributes", attributes}});
        else if (!list.isComplete)
            fmt::print("The list is not complete.\n");
    }
    if (asJson)
        std::puts(jsonText(all).c_str());
}

} // namespace

void addInfoCommand(CLI::App &app, const Context &context) {
    struct Options {
        std::vector<std::string> paths;
        RemoteOptions remote;
        bool json = false, large = false, header = false;
    };
    auto options = std::make_shared<Options>();
    CLI::App *command = app.add_subcommand(
        "info", "List patients, studies, series, geometry, warnings and skipped files");
    CLI::Option *const path = command->add_option(
        "PATH", options->paths,
        "Files, folders, DICOMDIRs, ZIP archives, or volumes in NRRD, NIfTI or MetaImage");
    addRemoteOptions(*command, options->remote, *path);
    command->add_flag("--json", options->json, "Print one JSON object");
    command->add_flag("--header", options->header, "Print all attributes of DICOM files")
        ->needs(path);
    addLargeOption(*command, options->large);
    command->callback([options, context] {
        requirePathOrServer(!options->paths.empty(), options->remote);
        std::vector<std::filesystem::path> paths(options->paths.begin(), options->paths.end());
        std::optional<FetchedStudy> fetched;
        if (options->remote.isGiven()) {
            fetched.emplace(options->remote, "", context);
            paths = {fetched->path()};
        }
        if (options->header) {
            printHeaders(paths, options->json, context);
            return;
        }
        naming(paths.front(), [&] {
            const dicom::Catalogue catalogue =
                dicom::scan(paths, task::Progress(context.stop), {options->large});
            if (options->json)
                std::puts(jsonText(catalogueJson(catalogue, context)).c_str());
            else
                printCatalogue(catalogue, context);
            if (catalogue.empty())
                failWithoutImages(catalogue, paths.front());
        });
    });
}

} // namespace pellucid::cli
