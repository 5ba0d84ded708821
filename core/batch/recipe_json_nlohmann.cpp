// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "core/batch/reasons.h"
#include "core/batch/recipe.h"
#include "core/classify/reasons.h"
#include "core/files/json_lines_nlohmann.h"
#include "core/files/read_text.h"
#include "core/files/reasons.h"
#include "core/presets/preset_json_nlohmann.h"
#include "core/presets/preset_library.h"
#include "core/presets/reasons.h"
#include "core/scene/reasons.h"
#include "core/scene/scene_json_nlohmann.h"
#include "core/scene/view_list_nlohmann.h"
#include "core/system/content_digest.h"
#include "core/system/text.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::batch {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using files::JsonValue;
using files::JsonWords;
using nlohmann::json;
using scene::StandardView;
using scene::ViewList;

constexpr JsonWords<Format, 7> formats{{{"png", Format::png},
                                        {"png16", Format::png16},
                                        {"npy", Format::npy},
                                        {"nrrd", Format::nrrd},
                                        {"dicom", Format::capture},
                                        {"dicom-loop", Format::captureLoop},
                                        {"mp4", Format::video}}};
constexpr JsonWords<Fit, 2> fits{{{"volume", Fit::volume}, {"body", Fit::body}}};
constexpr std::size_t maxNameBytes = 60;

bool isSafe(char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ||
           c == '_' || c == '.' || c == ',';
}

// Reads the outputs of a recipe, and notes the contents of the files that they name.
class Reader {
public:
    explicit Reader(fs::path folder) : m_folder(std::move(folder)) {}

    Recipe read(const JsonValue &in) {
        in.requireOnly({"$schema", "recipe", "notes", "series", "outputs"});
        if (in.at("recipe").number() != 1.0)
            in["recipe"].refuse(because::isNot("1"));
        Recipe recipe;
        if (const JsonValue series = in["series"])
            recipe.series = seriesFrom(series);
        for (const JsonValue &output : in.at("outputs").elements())
            recipe.outputs.push_back(outputFrom(output));
        if (recipe.outputs.empty())
            in["outputs"].refuse(because::mustNotBeEmpty);
        json whole = json::parse(in.dumped());
        whole.erase("notes"); // nothing depends on them
        whole.erase("$schema");
        const std::string contents = whole.dump() + m_contents;
        recipe.digest = system::contentDigest(std::as_bytes(std::span(contents)));
        return recipe;
    }

private:
    static SeriesChoice seriesFrom(const JsonValue &in) {
        in.requireOnly({"modality", "description", "slice_mm", "min_slices"});
        SeriesChoice choice;
        if (const JsonValue modality = in["modality"]) {
            if (modality.isList())
                for (const JsonValue &one : modality.elements())
                    choice.modalities.push_back(system::uppercased(one.text()));
            else
                choice.modalities.push_back(system::uppercased(modality.text()));
        }
        if (const JsonValue description = in["description"])
            choice.description = description.text();
        if (const JsonValue range = in["slice_mm"]) {
            choice.sliceMm = range.twoNumbers();
            if (!((*choice.sliceMm)[0] <= (*choice.sliceMm)[1]))
                range.refuse(because::mustBeTwoRisingNumbers);
        }
        if (const JsonValue least = in["min_slices"])
            choice.minSlices = least.wholeNumber(2, 1000000);
        return choice;
    }

    Output outputFrom(const JsonValue &in) {
        in.requireOnly({"name", "format", "view", "views", "turntable", "look", "scene",
                        "without_couch", "size", "pixel_mm", "fit", "tolerance", "check",
                        "deidentify"});
        Output output;
        if (const JsonValue format = in["format"])
            output.format = format.meaning(formats);
        readScene(in, output);
        readViews(in, output);
        readCamera(in, output);
        if (const JsonValue deidentify = in["deidentify"]) {
            output.isDeidentified = deidentify.boolean();
            if (output.isDeidentified && output.format != Format::capture &&
                output.format != Format::captureLoop)
                deidentify.refuse(because::deidentifyIsForDicom);
        }
        const bool isLoop = output.format == Format::captureLoop || output.format == Format::video;
        if (isLoop && output.views.size() < 2)
            in.refuse(because::loopNeedsViews);
        const bool hasColors =
            output.look ? !classify::isGrey(output.look->look) || !output.look->shading.isGrey()
                        : output.scene && (!classify::isGrey(output.scene->look) ||
                                           !output.scene->shading.isGrey());
        if (hasColors && (output.format == Format::png16 || output.format == Format::nrrd))
            in["format"].refuse(because::colorsHaveNoGreyValues);
        output.name = nameFrom(in);
        takeFileNames(in, output);
        return output;
    }

    void readScene(const JsonValue &in, Output &output) {
        if (const JsonValue scene = in["scene"]) {
            if (scene.isText()) {
                const std::string text = textOf(scene);
                output.scene = scene.checked([&] { return scene::sceneFromJson(text); });
            } else {
                output.scene = scene::sceneFrom(scene);
            }
            // Measured on the study that the scene is of.
            output.scene->tone.exposure.reset();
            if (output.scene->isOfDifference)
                scene.refuse(because::sceneShowsADifference);
        }
        if (const JsonValue look = in["look"]) {
            output.look = look.isText() ? look.checked([&] { return presetNamed(look); })
                                        : presets::presetFrom(look);
            m_contents += presets::toJson(*output.look);
        }
        if (const JsonValue couch = in["without_couch"])
            output.isWithoutCouch = couch.boolean();
        if (const JsonValue tolerance = in["tolerance"])
            output.tolerance = toleranceFrom(tolerance);
        if (const JsonValue check = in["check"])
            output.check = check.meaning(error::checkedPictures);
    }

    static double toleranceFrom(const JsonValue &in) {
        if (in.isText()) {
            const std::string given = in.text();
            std::string known;
            for (const auto &[name, tolerance] : scene::namedTolerances) {
                if (given == name)
                    return tolerance;
                known += (known.empty() ? "" : ", ") + std::string(name);
            }
            in.refuse(because::isNoneOf(given, known));
        }
        const double tolerance = in.number();
        if (!(tolerance > 0.0))
            in.refuse(because::toleranceMustBePositive);
        return tolerance;
    }

    void readViews(const JsonValue &in, Output &output) {
        const JsonValue view = in["view"], views = in["views"], turn = in["turntable"];
        if (int(bool(view)) + int(bool(views)) > 1 || (views && turn))
            in.refuse(because::viewsAreGivenTwice);
        if (views) {
            ViewList list;
            if (views.isText()) {
                const std::string text = textOf(views);
                list = views.checked([&] { return scene::viewListFromJson(text); });
            } else if (views.isList()) {
                for (const JsonValue &one : views.elements()) {
                    list.views.push_back(scene::viewFrom(one));
                    one.checked([&] { scene::agreeOnPixel(list); });
                }
                if (list.views.empty())
                    views.refuse(because::mustNotBeEmpty);
                requireSizeOfMatrices(in, list);
            } else {
                list = scene::viewListFrom(views);
            }
            output.views = list.views;
            output.size = list.size;
            output.pixelMm = list.pixelMm;
            return;
        }
        glm::dquat first = output.scene ? output.scene->camera.orientation
                                        : scene::viewOrientation(StandardView::front);
        if (view)
            first = viewFrom(view);
        const int count = turn ? turn.wholeNumber(2, maxTurnViews) : 1;
        output.isTurn = bool(turn);
        for (int n = 0; n < count; ++n)
            output.views.push_back({scene::turnedAboutLongAxis(first, 360.0 * n / count), {}});
    }

    static glm::dquat viewFrom(const JsonValue &in) {
        const ViewList::View view = scene::viewFrom(in);
        if (!view.orientation)
            in.refuse(because::matrixBelongsToViews);
        return *view.orientation;
    }

    // In a plain list, the size is that of the output.
    static void requireSizeOfMatrices(const JsonValue &in, const ViewList &list) {
        for (const ViewList::View &view : list.views)
            if (view.matrix && !in["size"])
                in.refuse(because::matricesNeedASize);
    }

    static void readCamera(const JsonValue &in, Output &output) {
        if (const JsonValue size = in["size"]) {
            if (size.isList()) {
                output.size = size.wholeNumbers<2>(1, scene::largestImageSize);
            } else {
                const int side = size.wholeNumber(1, scene::largestImageSize);
                output.size = {side, side};
            }
        } else if (!output.size && output.scene && !(in["fit"] && in["pixel_mm"])) {
            output.size = {output.scene->camera.width, output.scene->camera.height};
        }
        if (const JsonValue pixel = in["pixel_mm"]) {
            output.pixelMm = pixel.number();
            if (!(*output.pixelMm > 0.0))
                pixel.refuse(because::pixelMustBePositive);
            ViewList list{output.views, {}, output.pixelMm};
            pixel.checked([&] { scene::agreeOnPixel(list); });
        }
        if (const JsonValue fit = in["fit"]) {
            output.fit = fit.meaning(fits);
            if (std::any_of(output.views.begin(), output.views.end(),
                            [](const ViewList::View &view) { return view.matrix.has_value(); }))
                fit.refuse(because::matricesDecideTheFit);
            if (output.size && output.pixelMm)
                fit.refuse(because::fitHasNoChoice);
        }
    }

    std::string nameFrom(const JsonValue &in) {
        const JsonValue given = in["name"];
        if (!given)
            return nameOfViews(in);
        const std::string name = given.text();
        if (name.empty() || name.size() > maxNameBytes || name.front() == '.' ||
            !std::all_of(name.begin(), name.end(), isSafe))
            given.refuse(because::mustBeAFileName(maxNameBytes));
        if (system::lowered(name) == recordName)
            given.refuse(because::nameIsReserved(name));
        if (!take(name))
            given.refuse(because::nameIsTaken(name));
        return name;
    }

    // The name of an output without one.
    std::string nameOfViews(const JsonValue &in) {
        std::string name = "picture";
        if (in["turntable"])
            name = "turntable";
        else if (in["view"] && in["view"].isText())
            name = in["view"].text();
        std::replace_if(
            name.begin(), name.end(), [](char c) { return !isSafe(c); }, '_');
        name.resize(std::min(name.size(), maxNameBytes));
        if (!take(name))
            in.refuse(because::needsANameOfItsOwn(name));
        return name;
    }

    // Some file systems do not distinguish upper and lower case.
    bool take(const std::string &name) { return m_names.insert(system::lowered(name)).second; }

    // "a_0000" may be a view of the output "a".
    void takeFileNames(const JsonValue &in, const Output &output) {
        for (const std::string &file : filesOf(output))
            if (const std::string stem = fs::path(file).stem().string();
                stem != output.name && !take(stem))
                (in["name"] ? in["name"] : in).refuse(because::nameIsTaken(stem));
    }

    // Names the file that is at fault, too.
    template <class F> static auto named(const JsonValue &in, const fs::path &path, const F &read) {
        try {
            return read();
        } catch (const task::Error &error) {
            in.refuse(because::at(path.string(), error.reason()));
        }
    }

    // The text of a file that the recipe names.
    std::string textOf(const JsonValue &in) {
        const fs::path path = m_folder / in.text();
        const std::string text =
            named(in, path, [&] { return files::readText(path, files::maxSceneBytes); });
        m_contents += text;
        return text;
    }

    presets::Preset presetNamed(const JsonValue &in) const {
        const std::string name = in.text();
        const fs::path path(name);
        if (path.extension() == ".json" || path.has_parent_path())
            return named(in, m_folder / path, [&] { return presets::readPreset(m_folder / path); });
        return presets::PresetLibrary::ofUser().get(name).preset;
    }

    fs::path m_folder;
    static constexpr const char *recordName = "done"; // see doneFile
    std::string m_contents;                           ///< of what it names
    std::set<std::string> m_names{recordName};        ///< of files, in lower case
};

} // namespace

Recipe recipeFromJson(const std::string &text, const fs::path &folder) {
    return files::readJson(text, [&](const JsonValue &in) { return Reader(folder).read(in); });
}

Recipe readRecipe(const fs::path &path) {
    const std::string text = files::readText(path, maxRecipeBytes);
    try {
        return recipeFromJson(text, path.parent_path());
    } catch (const task::Error &error) {
        throw task::Error(error.code(), error.reason(), path);
    }
}

std::string recipeOf(const scene::Scene &scene, const presets::Preset &look, Format format,
                     int turn, bool isDeidentified) {
    scene::Scene shown = scene;
    // What belongs to this study, or comes from the look.
    shown.tone.exposure.reset();
    shown.tone.low.reset();
    shown.tone.high.reset();
    shown.look = {};
    shown.shading = {};
    shown.fieldWindow.reset();
    shown.camera.panMm = {};
    json output{{"name", turn > 0 ? "turntable" : "picture"},
                {"format", files::wordFor(format, formats)},
                {"size", {scene.camera.width, scene.camera.height}},
                {"fit", files::wordFor(Fit::body, fits)},
                {"look", presets::jsonOf(look)},
                {"scene", scene::jsonOf(shown)}};
    if (turn > 0)
        output["turntable"] = turn;
    if (isDeidentified && (format == Format::capture || format == Format::captureLoop))
        output["deidentify"] = true;
    return json{{"recipe", 1}, {"outputs", {output}}}.dump(2) + "\n";
}

} // namespace pellucid::batch
