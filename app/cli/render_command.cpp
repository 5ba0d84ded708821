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
#include "app/cli/look_options.h"
#include "app/cli/renderer.h"
#include "app/cli/scene_fields.h"
#include "app/cli/scene_options.h"
#include "app/cli/segment_options.h"
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
    bool json = false, isDeidentified = false;
};

// Whether the last picture misses the tolerance although the plan keeps it, and a closer plan may
// help.
bool mayPlanCloser(const Renderer &renderer, const scene::Scene &scene) {
    return renderer.lastViewError() > scene.tolerance &&
           renderer.predictedError() <= scene.tolerance && !renderer.isReduced() &&
           scene.interpolation.isPlanned() && scene.plannedFor != scene::PlannedFor::volume;
}

// One picture or a turntable, step by step.
class RenderRun {
public:
    RenderRun(const Options &options, const CLI::App &command, const Context &context)
        : m_options(options), m_command(command), m_context(context) {}

    void run() {
        const fs::path out(m_options.out);
        // Refuse impossible output before any work.
        m_preset = presetFor(m_options.scene);
        checkOutput(out, classify::isGrey(lookFor(m_options.scene, m_preset)) &&
                             shadingFor(m_options.scene, m_command, m_preset).isGrey());
        m_card = chooseCard(m_options.engine, m_options.frames);
        std::optional<tbb::global_control> threads;
        if (m_options.threads > 0)
            threads.emplace(tbb::global_control::max_allowed_parallelism,
                            std::size_t(m_options.threads));
        open(out);
        makeFields();
        prepare();
        warnOfFields();
        renderFrames();
        warnOfView();
        if (m_options.json)
            print();
    }

private:
    const volume::Volume &volume() const { return m_input.loaded.volume; }
    bool isMemoryGiven() const { return m_command.count("--memory") > 0; }
    bool isTurntable() const { return m_options.frames > 0; }
    int frames() const { return std::max(1, m_options.frames); }

    void warn(const std::string &text) {
        m_warnings.push_back(text);
        cli::warn(text);
    }

    void open(const fs::path &out) {
        if (isTurntable())
            for (int frame = 0; frame < m_options.frames; ++frame)
                m_outs.push_back(framePath(out, frame));
        else
            m_outs.push_back(out);
        m_input = openInput(m_options.input, m_outs, m_context);
        m_warnings = englishTexts(volume().notes().warnings);
        m_segments = loadSegments(m_options.scene.segmentations, m_outs, volume(), m_context);
        m_scene = m_planned =
            sceneFor(m_options.scene, m_command, m_preset, volume(), m_segments.get());
        // The scene file may have brought colors.
        checkOutput(out, classify::isGrey(m_scene.look) && m_scene.shading.isGrey());
    }

    void makeFields() {
        Stopwatch watch;
        m_window = windowFor(m_scene, volume());
        const std::size_t samples = volume().lattice().size().count();
        const std::size_t forLight = prepare::bytesForLight(
            m_scene.shading, volume().lattice().size(), classify::channelsOf(m_scene.look));
        m_held = volume().bytes() + classify::peakBytes(m_scene.look, samples) + forLight;
        if (isMemoryGiven() && m_options.memory < m_held)
            throw Error(
                ErrorCode::outOfMemory,
                because::inWords(fmt::format("the volume needs {} MB, but only {} MB are allowed",
                                             (m_held >> 20) + 1, m_options.memory >> 20)),
                m_options.input.path);
        m_fields = fieldsFor(m_scene, volume(), m_segments, m_context);
        m_whyEmpty = whyEmpty(m_scene, volume(), m_fields);
        // If the program asked for more than is available, the system would kill it.
        m_budget.bytes = system::availableMemoryBytes();
        m_budget.bytes -= std::min(m_budget.bytes, forLight); // not allocated yet
        if (isMemoryGiven())
            m_budget.bytes = std::min(m_budget.bytes, std::size_t(m_options.memory - m_held));
        m_fieldMs = watch.lapMs();
    }

    void prepare() {
        Stopwatch watch;
        try {
            m_renderer.reset();
            if (m_fields.channels.empty()) // this is not the first plan
                m_fields = fieldsFor(m_scene, volume(), m_segments, m_context);
            // Another plan may need them, and steps of classes take long.
            classify::ShownFields fields = m_fields;
            if (!classify::haveRegions(m_scene.look.classes))
                m_fields = {};
            m_renderer.emplace(m_planned, std::move(fields), m_budget, m_context);
            m_renderer->use(m_card);
        } catch (const Error &error) {
            if (error.code() != ErrorCode::outOfMemory || !isMemoryGiven())
                throw;
            throw Error(error.code(),
                        because::inWords(fmt::format(
                            "{}; the volume and its fields take {} of {} MB",
                            error.reason().english(), m_held >> 20, m_options.memory >> 20)),
                        m_options.input.path);
        }
        m_prepareMs += watch.lapMs();
    }

    void warnOfFields() {
        if (m_renderer->isReduced())
            warn(m_renderer->reason());
        for (const std::string &text : lookWarnings(m_command, m_preset, m_scene, volume()))
            warn(text);
        if (!m_whyEmpty.empty())
            warn(m_whyEmpty);
        // `reference` selects the exact method; its nominal tolerance is no target.
        if (m_renderer->predictedError() > m_scene.tolerance &&
            !(m_renderer->isExact() && m_scene.tolerance == scene::referenceTolerance))
            warn(fmt::format("the tolerance of {:.2g} is not met: {:.2g} is predicted",
                             m_scene.tolerance, m_renderer->predictedError()));
    }

    void renderFrames() {
        dicom::CaptureLabels labels =
            m_options.isDeidentified ? dicom::deidentified(m_input.labels) : m_input.labels;
        if (!m_options.isDeidentified)
            labels.seriesUid = dicom::newSeriesUid(); // one for all frames
        std::optional<files::FileSet> turn;
        if (isTurntable())
            turn.emplace(m_outs.front());
        for (int frame = 0; frame < frames(); ++frame) {
            task::Progress(m_context.stop).check();
            scene::Scene turned = m_scene;
            turned.camera.orientation =
                glm::angleAxis(glm::radians(360.0 * frame / frames()), glm::dvec3(0, 0, 1)) *
                m_scene.camera.orientation;
            const picture::ProjectionImage image = imageOf(turned.camera);
            takeErrors(frame == 0);
            if (isDisplayed(m_options.out) && !m_scene.tone.exposure)
                m_scene.tone.exposure = m_renderer->exposure(picture::backgroundOf(volume()));
            turned.tone = m_scene.tone;
            task::Progress(m_context.stop).check();
            Stopwatch watch;
            labels.instanceNumber = frame + 1;
            const fs::path &file = m_outs[std::size_t(frame)];
            writeImage(turn ? turn->aside(file) : file, image, turned, volume().lattice(), labels);
            m_writeMs += watch.lapMs();
        }
        if (turn)
            turn->commit();
    }

    // The plan is for the whole volume. The error of a part that contains little is known only
    // after rendering it; if it misses the tolerance, plan again with a smaller one.
    picture::ProjectionImage imageOf(const scene::Camera &camera) {
        picture::ProjectionImage image = m_renderer->image(camera, m_times);
        for (int tries = 0; tries < 3 && mayPlanCloser(*m_renderer, m_scene); ++tries) {
            m_planned.tolerance *= 0.8 * m_scene.tolerance / m_renderer->lastViewError();
            prepare();
            image = m_renderer->image(camera, m_times);
        }
        return image;
    }

    void takeErrors(bool isFirst) {
        m_viewError = std::max(m_viewError, m_renderer->lastViewError());
        m_isWhole = isFirst || m_isWhole == true ? m_renderer->wasWhole() : m_isWhole;
        const std::optional<double> here = m_renderer->predictedMaximum();
        m_maximum = here && (isFirst || m_maximum)
                        ? std::optional(std::max(*here, m_maximum.value_or(0.0)))
                        : std::nullopt;
    }

    void warnOfView() {
        const bool isMissed =
            m_viewError > m_scene.tolerance && m_renderer->predictedError() <= m_scene.tolerance;
        if (!isMissed)
            return;
        warn(m_isWhole == false
                 ? fmt::format("the tolerance of {:.2g} is met for the whole volume, but {:.2g} is "
                               "predicted for this part",
                               m_scene.tolerance, m_viewError)
                 : fmt::format("the tolerance of {:.2g} is not met: {:.2g} is predicted for this "
                               "picture",
                               m_scene.tolerance, m_viewError));
    }

    void print() const {
        json skipped = json::array();
        for (const auto &s : m_input.skipped)
            skipped.push_back({{"path", s.path.string()}, {"reason", s.reason.english()}});
        std::puts(jsonText({{"engine", m_renderer->description()},
                            {"device", m_renderer->isOnCard() ? "gpu" : "cpu"},
                            {"engine_reason", m_renderer->engineReason()},
                            {"size", {m_scene.camera.width, m_scene.camera.height}},
                            {"pixel_mm", m_scene.camera.pixelMm},
                            {"frames", frames()},
                            {"volume", volumeJson()},
                            {"segmentations", segmentationsJson()},
                            {"registration", registrationJson()},
                            {"window", {m_window.low, m_window.high}},
                            {"shading", json::parse(shading::toJson(m_scene.shading))},
                            {"milliseconds", timesJson()},
                            {"bytes", m_renderer->bytes()},
                            {"card_bytes", m_renderer->cardBytes()},
                            {"plan", m_renderer->planJson(m_times)},
                            {"tolerance", m_scene.tolerance},
                            {"predicted_error", errorJson()},
                            {"warnings", m_warnings},
                            {"skipped", skipped}})
                      .c_str());
    }

    json volumeJson() const {
        const volume::Lattice &l = volume().lattice();
        return {{"size", sizeJson(l.size())},
                {"spacing_mm", {l.spacingMm(0), l.spacingMm(1), l.sliceDistanceMm()}},
                {"tilt_deg", l.shearRad() * 180.0 / 3.14159265358979323846},
                {"series", m_input.seriesUid}};
    }

    json segmentationsJson() const {
        json all = json::array();
        if (!m_segments)
            return all;
        for (const segment::Segmentation &segmentation : m_segments->segmentations()) {
            json segments = json::array();
            for (const segment::Segment &segment : segmentation.segments)
                segments.push_back(
                    {{"name", segment.name}, {"volume_ml", segment.volumeMm3 / 1000.0}});
            all.push_back({{"title", segmentation.title},
                           {"segments", segments},
                           {"warnings", englishTexts(segmentation.warnings)}});
        }
        return all;
    }

    json registrationJson() const {
        if (!m_input.registration)
            return nullptr;
        const subtraction::Registration &r = *m_input.registration;
        const glm::dvec3 &shift = r.toMoving.shiftMm;
        return {{"shift_mm", {shift.x, shift.y, shift.z}},
                {"angle_deg", glm::degrees(r.toMoving.angleRad())},
                {"residual_before", r.residualBefore},
                {"residual_after", r.residualAfter}};
    }

    json timesJson() const {
        return {{"scan", m_input.scanMs},     {"load", m_input.loadMs},
                {"field", m_fieldMs},         {"prepare", m_prepareMs},
                {"slice", m_times.sliceMs},   {"transform", m_times.transformMs},
                {"frame", m_times.totalMs()}, {"write", m_writeMs}};
    }

    json errorJson() const {
        return {{"relative_l2", m_viewError},
                {"maximum", m_maximum ? json(*m_maximum) : json(nullptr)},
                {"whole", m_isWhole ? json(*m_isWhole) : json(nullptr)}};
    }

    const Options &m_options;
    const CLI::App &m_command;
    const Context &m_context;
    CardChoice m_card;
    std::optional<presets::Preset> m_preset; ///< of --preset
    std::vector<fs::path> m_outs;
    Input m_input;
    std::shared_ptr<const segment::SegmentSet> m_segments; ///< of --segmentation, or null
    std::vector<std::string> m_warnings;
    scene::Scene m_scene;
    scene::Scene m_planned; ///< with a smaller tolerance, if a part of the volume needs one
    classify::FieldWindow m_window;
    std::size_t m_held = 0;         ///< bytes of the volume, its fields and their preparation
    classify::ShownFields m_fields; ///< until the renderer takes them; with steps, longer
    std::string m_whyEmpty;         ///< a warning, or empty
    plan::Budget m_budget;
    std::optional<Renderer> m_renderer; ///< refers to the planned scene
    double m_fieldMs = 0.0, m_prepareMs = 0.0, m_writeMs = 0.0;
    picture::FrameTimes m_times; ///< of the last frame
    // For all frames together.
    double m_viewError = 0.0;
    std::optional<bool> m_isWhole;
    std::optional<double> m_maximum; ///< if every frame shows the whole volume
};

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
    addSubtractionOptions(*c, o->input);
    c->add_option("-o,--output", o->out,
                  "Image file: .png, .npy, .nrrd or .dcm (Secondary Capture)")
        ->required();
    addSceneOptions(*c, o->scene);
    c->add_option(
         "--engine", o->engine,
         "Engine that renders the images; default: auto, which uses the GPU for turntables")
        ->check(CLI::IsMember({"auto", "cpu", "gpu"}));
    c->add_option("--threads", o->threads, "Maximum number of threads; default: all processors")
        ->check(CLI::Range(1, 1024));
    c->add_option("--memory", o->memory,
                  "Memory limit in bytes or with a unit (2GB); default: the available memory")
        ->check(notNegative)
        ->transform(CLI::AsSizeValue(false));
    CLI::Option *frames = c->add_option("--frames", o->frames, "Number of frames of the turntable")
                              ->check(CLI::Range(1, 100000));
    CLI::Option *turntable =
        c->add_flag("--turntable")
            ->description(
                "Render one turn about the patient's long axis; file names get the frame number")
            ->needs(frames);
    frames->needs(turntable);
    c->add_flag("--deidentify", o->isDeidentified,
                "Remove the patient's identity from the .dcm (PS3.15, basic profile)");
    c->add_flag("--json", o->json, "Print a report as one JSON object");
    c->callback(
        [o, c, context] { naming(o->input.path, [&] { RenderRun(*o, *c, context).run(); }); });
}

} // namespace pellucid::cli
