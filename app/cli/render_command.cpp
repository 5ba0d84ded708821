// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include "app/cli/commands.h"
#include "app/cli/image_output.h"
#include "app/cli/input.h"
#include "app/cli/json_text.h"
#include "app/cli/renderer.h"
#include "app/cli/scene_fields.h"
#include "app/cli/scene_options.h"
#include "app/cli/terminal.h"
#include "core/files/file_set.h"
#include "core/system/memory.h"
#include "core/task/error.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using nlohmann::json;
using task::Error;
using task::ErrorCode;

struct Options {
    SceneOptions scene;
    InputOptions input;
    std::string out, engine = "auto";
    int threads = 0, frames = 0;
    std::uint64_t memory = 0;
    bool turntable = false, json = false, isDeidentified = false;
};

// Whether what a picture shows misses the tolerance that the plan keeps, and a closer plan may
// help.
bool mayPlanCloser(const Renderer &renderer, const scene::Scene &scene) {
    return renderer.lastViewError() > scene.tolerance &&
           renderer.predictedError() <= scene.tolerance && !renderer.isReduced() &&
           scene.interpolation == scene::Interpolation() &&
           scene.plannedFor != scene::PlannedFor::volume;
}

void run(const Options &o, const CLI::App &command, const Context &context) {
    const fs::path out(o.out);
    // Refused before any work is done.
    checkOutput(out, classify::isGrey(lookFor(o.scene)) && shadingFor(o.scene, command).isGrey());
    if (o.turntable != (o.frames > 0))
        throw Error(ErrorCode::usage, because::inWords("--frames and --turntable go together"));
    const CardChoice card = chooseCard(o.engine, o.frames);
    std::optional<tbb::global_control> threads;
    if (o.threads > 0)
        threads.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(o.threads));

    std::vector<fs::path> outs{out};
    if (o.turntable) {
        outs.clear();
        for (int frame = 0; frame < o.frames; ++frame)
            outs.push_back(framePath(out, frame));
    }
    const Input input = openInput(o.input, outs, context);
    const volume::Volume &volume = input.loaded.volume;
    scene::Scene scene = sceneFor(o.scene, command, volume);
    // The scene file may have brought colours.
    checkOutput(out, classify::isGrey(scene.look) && scene.shading.isGrey());
    Stopwatch watch;
    const classify::FieldWindow window = windowFor(scene, volume);
    const std::size_t samples = volume.lattice().size().count();
    const std::size_t forLight = prepare::bytesForLight(scene.shading, volume.lattice().size(),
                                                        classify::mixesColors(scene.look) ? 3 : 1);
    const std::size_t held = volume.bytes() + classify::peakBytes(scene.look, samples) + forLight +
                             (scene.crop.isWhole() ? 0 : samples * sizeof(float));
    if (command.count("--memory") > 0 && o.memory < held)
        throw Error(ErrorCode::outOfMemory,
                    because::inWords(fmt::format("the volume needs {} MB, {} MB are allowed",
                                                 (held >> 20) + 1, o.memory >> 20)),
                    o.input.path);
    const classify::ShownFields fields = fieldsFor(scene, volume, context);
    // Asking for more than there is would end in the system killing the program.
    plan::Budget budget{system::availableMemoryBytes()};
    budget.bytes -= std::min(budget.bytes, forLight); // still to be asked for
    if (command.count("--memory") > 0)
        budget.bytes = std::min(budget.bytes, std::size_t(o.memory - held));
    const double fieldMs = watch.lapMs();
    scene::Scene planned = scene; // with a closer tolerance, if a part of the picture needs one
    std::optional<Renderer> made;
    const auto prepare = [&]() -> Renderer & {
        try {
            made.reset();
            Renderer &renderer = made.emplace(planned, fields, budget, context);
            renderer.use(card);
            return renderer;
        } catch (const Error &error) {
            if (error.code() != ErrorCode::outOfMemory || command.count("--memory") == 0)
                throw;
            throw Error(
                error.code(),
                because::inWords(fmt::format("{}; {} of {} MB are the volume and its fields",
                                             error.reason().english(), held >> 20, o.memory >> 20)),
                o.input.path);
        }
    };
    Renderer *renderer = &prepare();
    double prepareMs = watch.lapMs();
    std::vector<std::string> warnings = englishTexts(volume.notes().warnings);
    const auto warn = [&](const std::string &text) {
        warnings.push_back(text);
        cli::warn(text);
    };
    if (renderer->isReduced())
        warn(renderer->reason());
    for (const std::string &text : lookWarnings(o.scene, command, scene, volume))
        warn(text);
    if (const std::string why = whyEmpty(scene, volume, fields); !why.empty())
        warn(why);
    // `reference` selects the exact method; its nominal tolerance is no target.
    if (renderer->predictedError() > scene.tolerance &&
        !(renderer->isExact() && scene.tolerance == scene::referenceTolerance))
        warn(fmt::format("the tolerance of {:.2g} is not met: {:.2g} is predicted", scene.tolerance,
                         renderer->predictedError()));

    picture::FrameTimes times;
    double writeMs = 0.0, viewError = 0.0;
    std::optional<bool> isWhole;
    std::optional<double> maximum; // of the frames, if all show the whole
    const int frames = std::max(1, o.frames);
    dicom::CaptureLabels labels =
        o.isDeidentified ? dicom::deidentified(input.labels) : input.labels;
    if (!o.isDeidentified)
        labels.seriesUid = dicom::newSeriesUid(); // one for all frames
    std::optional<files::FileSet> turn;
    if (o.turntable)
        turn.emplace(outs.front());
    for (int frame = 0; frame < frames; ++frame) {
        task::Progress(context.stop).check();
        scene::Scene turned = scene;
        turned.camera.orientation =
            glm::angleAxis(glm::radians(360.0 * frame / frames), glm::dvec3(0, 0, 1)) *
            scene.camera.orientation;
        auto image = renderer->image(turned.camera, times);
        // The plan is for the picture of the whole. Of a part that holds less than its share, the
        // error is known once it is seen.
        for (int tries = 0; tries < 3 && mayPlanCloser(*renderer, scene); ++tries) {
            planned.tolerance *= 0.8 * scene.tolerance / renderer->lastViewError();
            watch.lapMs();
            renderer = &prepare();
            prepareMs += watch.lapMs();
            image = renderer->image(turned.camera, times);
        }
        viewError = std::max(viewError, renderer->lastViewError());
        const std::optional<double> here = renderer->predictedMaximum();
        isWhole = frame == 0 || isWhole == true ? renderer->wasWhole() : isWhole;
        maximum = here && (frame == 0 || maximum)
                      ? std::optional(std::max(*here, maximum.value_or(0.0)))
                      : std::nullopt;
        task::Progress(context.stop).check();
        watch.lapMs();
        labels.instanceNumber = frame + 1;
        const fs::path &file = outs[std::size_t(frame)];
        writeImage(turn ? turn->aside(file) : file, image, turned, volume.lattice(), labels);
        writeMs += watch.lapMs();
    }
    if (turn)
        turn->commit();
    if (viewError > scene.tolerance && renderer->predictedError() <= scene.tolerance)
        warn(isWhole == false
                 ? fmt::format("the tolerance of {:.2g} is met by pictures of the whole; {:.2g} is "
                               "predicted for what this one shows",
                               scene.tolerance, viewError)
                 : fmt::format("the tolerance of {:.2g} is not met: {:.2g} is predicted for this "
                               "picture",
                               scene.tolerance, viewError));
    if (!o.json)
        return;
    json skipped = json::array();
    for (const auto &s : input.skipped)
        skipped.push_back({{"path", s.path.string()}, {"reason", s.reason.english()}});
    const volume::Lattice &l = volume.lattice();
    std::puts(jsonText({{"engine", renderer->description()},
                        {"device", renderer->isOnCard() ? "gpu" : "cpu"},
                        {"engine_reason", renderer->engineReason()},
                        {"size", {scene.camera.width, scene.camera.height}},
                        {"pixel_mm", scene.camera.pixelMm},
                        {"frames", frames},
                        {"channels", renderer->channelCount()},
                        {"volume",
                         {{"size", sizeJson(l.size())},
                          {"spacing_mm", {l.spacingMm(0), l.spacingMm(1), l.sliceDistanceMm()}},
                          {"tilt_deg", l.shearRad() * 180.0 / 3.14159265358979323846},
                          {"series", input.seriesUid}}},
                        {"window", {window.low, window.high}},
                        {"shading", json::parse(shading::toJson(scene.shading))},
                        {"milliseconds",
                         {{"scan", input.scanMs},
                          {"load", input.loadMs},
                          {"field", fieldMs},
                          {"prepare", prepareMs},
                          {"slice", times.sliceMs},
                          {"transform", times.transformMs},
                          {"frame", times.totalMs()},
                          {"write", writeMs}}},
                        {"bytes", renderer->bytes()},
                        {"card_bytes", renderer->cardBytes()},
                        {"plan", renderer->planJson()},
                        {"tolerance", scene.tolerance},
                        {"predicted_error",
                         {{"relative_l2", viewError},
                          {"maximum", maximum ? json(*maximum) : json(nullptr)},
                          {"whole", isWhole ? json(*isWhole) : json(nullptr)}}},
                        {"warnings", warnings},
                        {"skipped", skipped}})
                  .c_str());
}

} // namespace

void addRenderCommand(CLI::App &app, const Context &context) {
    const CLI::Validator notNegative(
        [](std::string &text) {
            return text.rfind('-', 0) == 0 ? "'" + text + "' is not a size" : std::string();
        },
        "", "size");
    auto o = std::make_shared<Options>();
    CLI::App *c = app.add_subcommand("render", "Project a volume into an image");
    addInputOptions(*c, o->input);
    c->add_option("-o,--output", o->out, "The image: .png, .npy, .nrrd or .dcm (Secondary Capture)")
        ->required();
    addSceneOptions(*c, o->scene);
    c->add_option("--engine", o->engine, "auto, cpu or gpu")
        ->check(CLI::IsMember({"auto", "cpu", "gpu"}));
    c->add_option("--threads", o->threads, "Most threads to use")->check(CLI::Range(1, 1024));
    c->add_option("--memory", o->memory, "Most bytes to use, with units if you like (2GB)")
        ->check(notNegative)
        ->transform(CLI::AsSizeValue(false));
    c->add_option("--frames", o->frames, "Number of frames of a turntable")
        ->check(CLI::Range(1, 100000));
    c->add_flag("--turntable", o->turntable,
                "Turn once about the patient's long axis; OUT gets the frame number");
    c->add_flag("--deidentify", o->isDeidentified,
                "A .dcm without the patient's identity (PS3.15, basic profile)");
    c->add_flag("--json", o->json, "Print one JSON object about what was done");
    c->callback([o, c, context] { naming(o->input.path, [&] { run(*o, *c, context); }); });
}

} // namespace pellucid::cli
