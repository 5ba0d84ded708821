// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <map>
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
#include "app/cli/option_words.h"
#include "app/cli/scene_fields.h"
#include "app/cli/scene_options.h"
#include "app/cli/scene_renderer.h"
#include "app/cli/segment_options.h"
#include "app/cli/terminal.h"
#include "app/cli/write_behind.h"
#include "core/error/checked_pictures.h"
#include "core/files/file_set.h"
#include "core/files/image_files.h"
#include "core/files/read_text.h"
#include "core/scene/projection_matrix.h"
#include "core/shading/shading_json_nlohmann.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

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
    std::string out, engine = "auto", views, fit, check = "rest";
    int threads = 0, frames = 0;
    std::uint64_t memory = 0;
    bool json = false, isDeidentified = false;
};

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
        if (m_options.fit == "body" && hasSize() && m_command.count("--pixel-mm") > 0)
            throw Error(
                ErrorCode::usage,
                because::inWords("--fit body: --pixel-mm cannot be used when the size is given"));
        if (!m_options.views.empty())
            readViews(out);
        m_card = chooseCard(m_options.engine, frames());
        std::optional<tbb::global_control> threads;
        if (m_options.threads > 0)
            threads.emplace(tbb::global_control::max_allowed_parallelism,
                            std::size_t(m_options.threads));
        open(out);
        prepare();
        if (m_options.views.empty())
            renderFrames();
        else
            renderViews(out);
        if (const std::string missed = m_renderer->warningOfViews(); !missed.empty())
            warn(missed);
        if (m_options.json)
            print();
    }

private:
    const volume::Volume &volume() const { return m_input.loaded.volume; }
    bool isTurntable() const { return m_options.frames > 0; }
    int frames() const {
        return m_options.views.empty() ? std::max(1, m_options.frames) : int(m_views.views.size());
    }

    void warn(const std::string &text) {
        m_warnings.push_back(text);
        cli::warn(text);
    }

    void readViews(const fs::path &out) {
        for (const char *const option :
             {"--view", "--azimuth", "--elevation", "--roll", "--orientation", "--carm"})
            if (m_command.count(option) > 0)
                throw Error(
                    ErrorCode::usage,
                    because::inWords(std::string(option) +
                                     ": cannot be combined with --matrix, which sets the views"));
        if (out.extension() != ".npy")
            throw Error(
                ErrorCode::usage,
                because::inWords(
                    "-o: --matrix writes all pictures as one array; the name must end in .npy"));
        std::error_code unknown;
        if (fs::equivalent(geometryPath(out), m_options.views, unknown))
            throw Error(ErrorCode::usage,
                        because::inWords("-o: the description of the views would replace " +
                                         m_options.views));
        const std::string text = files::readText(m_options.views, files::maxSceneBytes);
        try {
            m_views = scene::viewListFromJson(text);
        } catch (const Error &error) {
            throw Error(error.code(), error.reason(), m_options.views);
        }
    }

    void open(const fs::path &out) {
        if (isTurntable())
            for (int frame = 0; frame < m_options.frames; ++frame)
                m_outs.push_back(framePath(out, frame));
        else
            m_outs.push_back(out);
        if (!m_options.views.empty())
            m_outs.push_back(geometryPath(out));
        m_input = openInput(m_options.input, m_outs, m_context);
        m_warnings = englishTexts(volume().notes().warnings);
        m_segments = loadSegments(m_options.scene.segmentations, m_outs, volume(), m_context);
        m_scene = sceneFor(m_options.scene, m_command, m_preset, volume(), m_segments.get());
        if (!m_options.views.empty())
            placeViews();
        // The scene file may have brought colors.
        checkOutput(out, classify::isGrey(m_scene.look) && m_scene.shading.isGrey());
    }

    // The list has a size and a pixel of its own, unless options name others.
    void placeViews() {
        scene::Camera &camera = m_scene.camera;
        if (m_views.size && m_command.count("--size") == 0)
            camera.width = (*m_views.size)[0], camera.height = (*m_views.size)[1];
        if (m_command.count("--pixel-mm") > 0) {
            m_views.pixelMm = camera.pixelMm;
            scene::agreeOnPixel(m_views);
        }
        camera.pixelMm = m_views.pixelMm.value_or(camera.pixelMm);
        const scene::Camera base = camera;
        for (const scene::ViewList::View &view : m_views.views)
            m_cameras.push_back(scene::cameraOf(view, base, volume().lattice()));
    }

    void prepare() {
        if (m_options.fit == "body")
            m_scene.tone.exposure.reset(); // the scene may be of another study
        const bool isGiven = m_command.count("--memory") > 0;
        m_renderer.emplace(
            m_scene, Subject{volume(), m_segments, m_options.input.path}, frames(),
            MemoryLimit{isGiven ? std::optional(m_options.memory) : std::nullopt, isGiven}, m_card,
            m_context);
        for (const std::string &text : lookWarnings(m_command, m_preset, m_scene, volume()))
            warn(text);
        for (const std::string &text : m_renderer->warnings())
            warn(text);
    }

    void renderFrames() {
        dicom::CaptureLabels labels =
            m_options.isDeidentified ? dicom::deidentified(m_input.labels) : m_input.labels;
        if (!m_options.isDeidentified)
            labels.seriesUid = dicom::newSeriesUid(); // one for all frames
        labels.warnings = m_warnings;
        std::optional<files::FileSet> turn;
        if (isTurntable())
            turn.emplace(m_outs.front());
        placeFrames();
        WriteBehind written;
        for (int frame = 0; frame < frames(); ++frame) {
            scene::Scene turned = m_scene;
            turned.camera = m_cameras[std::size_t(frame)];
            picture::ProjectionImage image =
                m_renderer->image(turned.camera, checkOf(std::size_t(frame)));
            if (isDisplayed(m_options.out))
                turned.tone.exposure = m_renderer->exposure();
            task::Progress(m_context.stop).check();
            Stopwatch watch;
            labels.instanceNumber = frame + 1;
            labels.derivation = derivationText(m_renderer->lastError());
            const fs::path &file = m_outs[std::size_t(frame)];
            written.add([this, labels, image = std::move(image), turned = std::move(turned),
                         to = turn ? turn->aside(file) : file] {
                writeImage(to, image, turned, volume().lattice(), labels);
            });
            m_writeMs += watch.lapMs();
        }
        Stopwatch watch;
        written.finish();
        m_writeMs += watch.lapMs();
        if (turn)
            turn->commit();
    }

    SceneRenderer::Check checkOf(std::size_t picture) const {
        return error::isChecked(meaningOf(m_options.check, error::checkedPictures), picture,
                                std::size_t(frames()))
                   ? SceneRenderer::Check::measure
                   : SceneRenderer::Check::none;
    }

    void placeFrames() {
        for (int frame = 0; frame < frames(); ++frame) {
            scene::Camera &camera = m_cameras.emplace_back(m_scene.camera);
            camera.orientation =
                scene::turnedAboutLongAxis(camera.orientation, 360.0 * frame / frames());
        }
        if (m_options.fit != "body")
            return;
        const scene::Exposure &exposure = m_renderer->exposure();
        scene::fitToBox(m_cameras, exposure.lowMm, exposure.highMm,
                        hasSize() ? scene::FitBy::pixel : scene::FitBy::size);
        m_scene.camera = m_cameras.front();
    }

    bool hasSize() const { return m_command.count("--size") > 0 || !m_options.scene.scene.empty(); }

    // The pictures of all views as one array, and beside it where each was seen from.
    void renderViews(const fs::path &out) {
        std::vector<std::size_t> shape{m_cameras.size(), std::size_t(m_scene.camera.height),
                                       std::size_t(m_scene.camera.width)};
        if (!classify::isGrey(m_scene.look) || !m_scene.shading.isGrey())
            shape.push_back(3);
        files::FileSet both(out);
        files::NpyFile stack(both.aside(out), shape);
        json views = json::array();
        for (std::size_t view = 0; view < m_cameras.size(); ++view) {
            const scene::Camera &camera = m_cameras[view];
            const picture::ProjectionImage image = m_renderer->image(camera, checkOf(view));
            Stopwatch watch;
            stack.write(image.samples);
            m_writeMs += watch.lapMs();
            views.push_back(geometryJson(camera, volume().lattice(), m_renderer->lastError()));
        }
        stack.commit();
        writeGeometry(both.aside(geometryPath(out)), m_scene.camera, views);
        both.commit();
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
                            {"window", {m_renderer->window().low, m_renderer->window().high}},
                            {"shading", shading::jsonOf(m_scene.shading)},
                            {"milliseconds", timesJson()},
                            {"bytes", m_renderer->bytes()},
                            {"card_bytes", m_renderer->cardBytes()},
                            {"plan", m_renderer->planJson()},
                            {"tolerance", m_scene.tolerance},
                            {"predicted_error", errorJson()},
                            {"measured_error", measuredJson(m_renderer->largestMeasured())},
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
        const picture::FrameTimes &times = m_renderer->times();
        return {{"scan", m_input.scanMs},         {"load", m_input.loadMs},
                {"field", m_renderer->fieldMs()}, {"prepare", m_renderer->prepareMs()},
                {"slice", times.sliceMs},         {"transform", times.transformMs},
                {"frame", times.totalMs()},       {"write", m_writeMs}};
    }

    json errorJson() const {
        const auto bound = m_renderer->bound();
        return {{"relative_l2", bound ? json(bound->relative) : json()},
                {"whole", m_renderer->wereWhole()}};
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
    scene::ViewList m_views;              ///< of --matrix
    std::vector<scene::Camera> m_cameras; ///< of the views
    std::optional<SceneRenderer> m_renderer;
    double m_writeMs = 0.0; ///< waiting for pictures to be written
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
    c->add_option("--check", o->check,
                  "Which pictures have their error measured, by exact sums at selected "
                  "frequencies: 'none', 'all', or 'rest' (default), which means single pictures, "
                  "and the first, the last and six others of a turntable or of --matrix")
        ->check(CLI::IsMember(wordsOf(error::checkedPictures)));
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
    CLI::Option *matrix =
        c->add_option(
             "--matrix", o->views,
             "Views from a JSON file: 3x4 matrices of parallel projections, or angles of a "
             "C-arm; writes one array (.npy), and the geometry of each view beside it (.json)")
            ->check(notEmpty())
            ->excludes(turntable);
    c->add_option(
         "--fit", o->fit,
         "What the picture is fitted to: 'volume' (default), so that the whole volume fits from "
         "every side, or 'body', so that the body fills the picture in the requested views")
        ->check(CLI::IsMember({"volume", "body"}))
        ->excludes(matrix);
    c->add_flag("--deidentify", o->isDeidentified,
                "Remove the patient's identity from the .dcm (PS3.15, basic profile)");
    c->add_flag("--json", o->json, "Print a report as one JSON object");
    c->callback(
        [o, c, context] { naming(o->input.path, [&] { RenderRun(*o, *c, context).run(); }); });
}

} // namespace pellucid::cli
