// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/scene_options.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/cli/input.h"
#include "app/cli/look_options.h"
#include "app/cli/option_words.h"
#include "app/cli/segment_options.h"
#include "core/classify/couch.h"
#include "core/files/read_text.h"
#include "core/picture/tone_subject.h"
#include "core/scene/positioner_angles.h"
#include "core/scene/reasons.h"
#include "core/system/text.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using task::Error;
using task::ErrorCode;

const std::map<std::string, scene::StandardView> views{
    {"front", scene::StandardView::front}, {"back", scene::StandardView::back},
    {"left", scene::StandardView::left},   {"right", scene::StandardView::right},
    {"top", scene::StandardView::top},     {"bottom", scene::StandardView::bottom}};

const std::map<std::string, scene::Reconstruction> reconstructions{
    {"cubic", scene::Reconstruction::cubic},
    {"linear", scene::Reconstruction::linear},
    {"band-limited", scene::Reconstruction::bandLimited},
    {"spline", scene::Reconstruction::spline}};

scene::Scene readScene(const fs::path &path) {
    const std::string text = files::readText(path, files::maxSceneBytes);
    try {
        return scene::sceneFromJson(text);
    } catch (const Error &error) { // a fault of the file, not of the command line
        throw Error(ErrorCode::unusable, error.reason(), path);
    }
}

// Not CLI::PositiveNumber, which accepts NaN and whose message has the 309 digits of the largest
// double.
CLI::Validator positive() {
    return {[](std::string &text) {
                const auto value = system::typedNumberFrom(text);
                const bool good = value && std::isfinite(*value) && *value > 0.0;
                return good ? std::string() : "'" + text + "' is not a positive number";
            },
            "", "positive"};
}

// CLI11 reads "nan", "inf" and numbers that overflow.
CLI::Validator finite() {
    return {[](std::string &text) {
                double value = 0.0;
                const bool isNumber = CLI::detail::lexical_cast(text, value);
                return isNumber && !std::isfinite(value) ? "the number must be finite"
                                                         : std::string();
            },
            ""};
}

void addCameraOptions(CLI::App &command, SceneOptions &options) {
    CLI::Option *view = command.add_option("--view", options.view, "Standard view; default front")
                            ->check(CLI::IsMember(views));
    CLI::Option *azimuth =
        command
            .add_option("--azimuth", options.azimuthDeg,
                        "Turn the view about the patient's long axis, in degrees")
            ->check(finite());
    CLI::Option *elevation = command
                                 .add_option("--elevation", options.elevationDeg,
                                             "Raise the view above the horizon, in degrees")
                                 ->check(finite());
    CLI::Option *roll = command
                            .add_option("--roll", options.rollDeg,
                                        "Roll the view about the line of sight, in degrees")
                            ->check(finite());
    CLI::Option *orientation =
        command
            .add_option("--orientation", options.orientation,
                        "Quaternion w,x,y,z of the rotation whose columns are the image axes "
                        "(right, up, toward the viewer)")
            ->excludes(view)
            ->excludes(azimuth)
            ->excludes(elevation)
            ->excludes(roll);
    command
        .add_option("--carm", options.carm,
                    "The view as angles of a C-arm, such as LAO30,CRA20: LAO or RAO, CRA or CAU; "
                    "AP and PA are the front and the back")
        ->check(notEmpty())
        ->excludes(view)
        ->excludes(azimuth)
        ->excludes(elevation)
        ->excludes(orientation);
    command.add_option("--size", options.size,
                       "Image size WIDTHxHEIGHT in pixels, or one number for both; default: large "
                       "enough for every view");
    command
        .add_option("--pixel-mm", options.pixelMm,
                    "Pixel size in mm; default: the smallest voxel spacing")
        ->check(positive());
}

void addLookOptions(CLI::App &command, SceneOptions &options) {
    command
        .add_option("--preset", options.preset, "Name of a preset in the library, or a preset file")
        ->check(notEmpty());
    command.add_option("--window", options.window,
                       "LO,HI: the values of the volume that become 0 and 1 in the field");
    command
        .add_option("--bezier", options.bezier,
                    "w0,w1,...: the transfer function, 2 to 16 weights from 0 to 2")
        ->check(notEmpty());
    command
        .add_option("--bezier-range", options.bezierRange,
                    "LO,HI: the range of densities, from 0 to 1, that --bezier covers; outside it, "
                    "the weight at the nearer end applies")
        ->check(notEmpty())
        ->needs("--bezier");
    command
        .add_option("--class", options.classes,
                    "NAME=WEIGHT[:#rrggbb]: show only the named classes, each with a weight "
                    "from 0 to 2; may be repeated")
        ->allow_extra_args(false);
    command.add_flag("--without-couch", options.isWithoutCouch,
                     "Show only the patient, in every class of the volume");
    CLI::Option *segmentation =
        command
            .add_option("--segmentation", options.segmentations,
                        "A segmentation of the volume: DICOM SEG, RT structure set, or labels in "
                        "NRRD, NIfTI or MetaImage; shows its segments; may be repeated")
            ->check(notEmpty())
            ->allow_extra_args(false);
    command
        .add_option("--segment", options.segments,
                    "NAME[=WEIGHT][:#rrggbb]: show only the named segments, each with a weight "
                    "from 0 to 2; '*' in NAME stands for any characters; may be repeated")
        ->allow_extra_args(false)
        ->needs(segmentation);
    addPointOption(command, options.points);
}

void addDisplayOptions(CLI::App &command, SceneOptions &options) {
    command
        .add_option("--detail", options.detail,
                    "A or A,MM: amplify structures finer than MM (default 2; less if the volume's "
                    "radius is below 16 mm) by up to 1 + A, A from "
                    "0 to 4; linear; applies to values too")
        ->check(notEmpty());
    command
        .add_option("--contrast", options.contrast,
                    "DETAIL,LATITUDE: multi-scale contrast of .png and .dcm, each 0 to 1, or "
                    "'none'; default: chosen from the study")
        ->check(notEmpty());
    command.add_flag("--inverted", options.isInverted, "Invert the grey values: bone is dark");
}

void addShadingOptions(CLI::App &command, SceneOptions &options) {
    command
        .add_option("--depth-cue", options.depthCue,
                    "none, linear:S or sine:S with a strength S from 0 to 1, or "
                    "curve:c0,c1,... with 2 to 8 weights from 0 to 2, from far to near")
        ->check(notEmpty());
    CLI::Option *light =
        command
            .add_option("--light", options.lights,
                        "u,v,w[:#rrggbb[:S]]: a light from that direction (right, up, toward the "
                        "viewer) with a strength S from 0 to 1; may be repeated")
            ->allow_extra_args(false);
    command
        .add_option("--light-frame", options.lightFrame,
                    "Keep the lights with the viewer or the patient when the view turns; "
                    "default viewer")
        ->check(CLI::IsMember({"viewer", "patient"}))
        ->needs(light);
    command.add_option("--ambient", options.ambient, "Ambient light from 0 to 2; default 1")
        ->check(CLI::Range(0.0, shading::largestAmbient));
}

void addQualityOptions(CLI::App &command, SceneOptions &options) {
    command
        .add_option("--reconstruction", options.reconstruction,
                    "Interpolation between the samples; default cubic")
        ->check(CLI::IsMember(reconstructions));
    command
        .add_option("--roll-off", options.rollOff,
                    "Share of the frequency band over which the spectrum fades to 0; default 0.05")
        ->check(CLI::Range(0.0, 1.0))
        ->check(finite());
    CLI::Option *quality =
        command.add_option("--quality", options.quality, "Named tolerance; default standard")
            ->check(CLI::IsMember(wordsOf(scene::namedTolerances)));
    command.add_option("--tolerance", options.tolerance, "Largest relative L2 error of the image")
        ->check(positive())
        ->excludes(quality);
    command.add_option("--kernel", options.kernel,
                       "Kernel that interpolates the spectrum; default: the fastest that meets "
                       "the tolerance");
    command
        .add_option("--padding", options.padding,
                    "Minimum ratio of the padded size to the field's along each axis; default: "
                    "as needed")
        ->check(CLI::Range(1.0, 4.0));
    command
        .add_option("--storage", options.storage,
                    "Number format of the spectrum; default: as needed")
        ->check(CLI::IsMember({"f16", "f32"}));
    command.add_flag(
        "--uniform", options.isUniform,
        "Read every frequency of the image with the same kernel, even where the tolerance allows a "
        "narrower one");
}

bool isGiven(const CLI::App &command, const char *option) {
    return command.count(option) > 0;
}

// The scene of the file, or else the default one.
scene::Scene startingScene(const SceneOptions &o, const CLI::App &command,
                           const volume::Lattice &lattice) {
    if (isGiven(command, "--scene"))
        return readScene(o.scene);
    scene::Scene scene;
    // A large volume may have no default image; naming a size or a pixel gives it one.
    if (!isGiven(command, "--size") && !isGiven(command, "--pixel-mm"))
        scene.camera = scene::defaultCamera(lattice);
    scene.camera.orientation = scene::viewOrientation(scene::StandardView::front);
    scene.camera.pixelMm = lattice.shortestStepMm();
    scene.image.detailMm = scene::defaultDetailMm(lattice.radiusMm());
    return scene;
}

void setOrientation(scene::Camera &camera, const SceneOptions &o, const CLI::App &command) {
    if (isGiven(command, "--orientation")) {
        const auto q = parseNumbers("--orientation", o.orientation, ',', 4);
        // Scaled first, so that huge and tiny quaternions can be normalised too.
        const double largest =
            std::max({std::abs(q[0]), std::abs(q[1]), std::abs(q[2]), std::abs(q[3]), 1e-300});
        const glm::dquat rotation(q[0] / largest, q[1] / largest, q[2] / largest, q[3] / largest);
        if (!(glm::length(rotation) > 0.0))
            throw Error(ErrorCode::usage,
                        because::inWords("--orientation: the quaternion must not be zero"));
        camera.orientation = glm::normalize(rotation);
    } else if (isGiven(command, "--carm")) {
        const scene::PositionerAngles angles = scene::positionerAnglesFromText(o.carm);
        camera.orientation = scene::viewOrientation(
            scene::StandardView::front, {angles.primaryDeg, angles.secondaryDeg, o.rollDeg});
    } else if (o.scene.empty() || isGiven(command, "--view") || isGiven(command, "--azimuth") ||
               isGiven(command, "--elevation") || isGiven(command, "--roll")) {
        camera.orientation =
            scene::viewOrientation(o.view.empty() ? scene::StandardView::front : views.at(o.view),
                                   {o.azimuthDeg, o.elevationDeg, o.rollDeg});
    }
}

void setPixel(scene::Camera &camera, const SceneOptions &o, const CLI::App &command,
              const volume::Lattice &lattice) {
    if (!isGiven(command, "--pixel-mm"))
        return;
    camera.pixelMm = o.pixelMm;
    if (!o.scene.empty() || isGiven(command, "--size"))
        return;
    // The image contains the whole volume.
    const double side = 2.0 * lattice.radiusMm() / o.pixelMm;
    if (!(o.pixelMm > 0.0) || side > scene::largestImageSize)
        throw Error(
            ErrorCode::usage,
            because::inWords(fmt::format(
                "--pixel-mm: an image of the whole volume would have {:.0f} pixels a side", side)));
    camera.width = camera.height = scene::evenPixels(side);
}

void setSize(scene::Camera &camera, const SceneOptions &o, const CLI::App &command) {
    if (!isGiven(command, "--size"))
        return;
    if (o.size.find_first_not_of("0123456789x") != std::string::npos)
        throw Error(ErrorCode::usage,
                    because::inWords("--size: '" + o.size +
                                     "' is not whole numbers with 'x' between them"));
    const bool isSquare = o.size.find('x') == std::string::npos;
    const auto n = parseNumbers("--size", isSquare ? o.size + "x" + o.size : o.size, 'x', 2);
    if (n[0] != std::round(n[0]) || n[1] != std::round(n[1]) || std::min(n[0], n[1]) < 1 ||
        std::max(n[0], n[1]) > scene::largestImageSize)
        throw Error(ErrorCode::usage, because::inWords(fmt::format(
                                          "--size: '{}' is not WIDTHxHEIGHT of 1 to {} pixels",
                                          o.size, scene::largestImageSize)));
    camera.width = int(n[0]);
    camera.height = int(n[1]);
}

void setLook(scene::Scene &scene, const SceneOptions &o, const CLI::App &command,
             const std::optional<presets::Preset> &preset, const volume::Volume &volume,
             const segment::SegmentSet *segments) {
    if (preset)
        scene.fieldWindow = preset->window;
    if (isGiven(command, "--window"))
        scene.fieldWindow = parseWindow(o.window);
    if (preset)
        scene.look = presets::lookFor(
            *preset, scene.fieldWindow.value_or(classify::defaultFieldWindow(volume)));
    changeLook(scene.look, o);
    if (o.isWithoutCouch)
        classify::removeCouch(scene.look,
                              scene.fieldWindow.value_or(classify::defaultFieldWindow(volume)));
    if (segments != nullptr)
        showSegments(scene.look, o, *segments);
    addPoints(scene.look, o.points, volume.lattice());
}

void setShading(scene::Scene &scene, const SceneOptions &o, const CLI::App &command,
                const std::optional<presets::Preset> &preset) {
    scene.shading = shadingFor(o, command, preset, scene.shading);
    if (!isGiven(command, "--light-frame"))
        return;
    // Directions are given in the scene's view.
    const glm::dmat3 axes = scene.camera.axes();
    for (shading::Light &light : scene.shading.lights)
        if (o.lightFrame == "patient") {
            light.direction = axes * glm::normalize(light.direction);
            light.frame = shading::LightFrame::patient;
        }
}

void setDisplay(scene::Scene &scene, const SceneOptions &o, const CLI::App &command) {
    if (isGiven(command, "--detail")) {
        const bool hasSize = o.detail.find(',') != std::string::npos;
        const auto n = parseNumbers("--detail", o.detail, ',', hasSize ? 2 : 1);
        scene.image.detail = n[0];
        if (hasSize)
            scene.image.detailMm = n[1];
    }
    if (o.isInverted)
        scene.tone.inverted = true;
    if (!isGiven(command, "--contrast"))
        return;
    if (o.contrast == "none") {
        scene.tone.detail = scene.tone.latitude = 0.0;
    } else {
        const auto n = parseNumbers("--contrast", o.contrast, ',', 2);
        scene.tone.detail = n[0];
        scene.tone.latitude = n[1];
    }
}

void setQuality(scene::Scene &scene, const SceneOptions &o, const CLI::App &command) {
    if (isGiven(command, "--reconstruction"))
        scene.image.reconstruction = reconstructions.at(o.reconstruction);
    if (isGiven(command, "--roll-off"))
        scene.image.rollOff = o.rollOff;
    if (isGiven(command, "--quality"))
        scene.tolerance = meaningOf(o.quality, scene::namedTolerances);
    if (isGiven(command, "--tolerance"))
        scene.tolerance = o.tolerance;
    if (isGiven(command, "--kernel"))
        scene.interpolation.kernel = fourier::kernelFromName(o.kernel);
    if (isGiven(command, "--padding"))
        scene.interpolation.padding = o.padding;
    if (isGiven(command, "--storage"))
        scene.interpolation.storage = fourier::storageFromName(o.storage);
    if (o.isUniform)
        scene.interpolation.isUniform = true;
}

} // namespace

void addSceneOptions(CLI::App &command, SceneOptions &options) {
    addCameraOptions(command, options);
    addLookOptions(command, options);
    addDisplayOptions(command, options);
    addShadingOptions(command, options);
    addQualityOptions(command, options);
    command.add_option("--crop", options.crop,
                       "c0,c1,r0,r1,s0,s1: show only these columns, rows and slices, as fractions "
                       "of the volume from 0 to 1");
    command
        .add_option("--scene", options.scene,
                    "Start from a saved scene (JSON); the other options override it")
        ->check(notEmpty());
}

scene::Scene sceneFor(const SceneOptions &o, const CLI::App &command,
                      const std::optional<presets::Preset> &preset, const volume::Volume &volume,
                      const segment::SegmentSet *segments) {
    const volume::Lattice &lattice = volume.lattice();
    scene::Scene scene = startingScene(o, command, lattice);
    if (scene.isOfDifference && !volume.notes().isDifference)
        throw Error(ErrorCode::usage, because::sceneShowsADifference);
    const scene::Scene saved = scene;
    setOrientation(scene.camera, o, command);
    setPixel(scene.camera, o, command, lattice);
    setSize(scene.camera, o, command);
    setLook(scene, o, command, preset, volume, segments);
    setShading(scene, o, command, preset);
    if (isGiven(command, "--crop")) {
        const auto n = parseNumbers("--crop", o.crop, ',', 6);
        scene.crop = {{n[0], n[2], n[4]}, {n[1], n[3], n[5]}};
    }
    setQuality(scene, o, command);
    setDisplay(scene, o, command);
    // A saved exposure is that of the saved look.
    if (picture::ToneSubject(scene) != picture::ToneSubject(saved))
        scene.tone.exposure.reset();
    scene::validate(scene);
    return scene;
}

} // namespace pellucid::cli
