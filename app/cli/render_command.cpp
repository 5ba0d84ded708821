// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include "app/cli/commands.h"
#include "app/cli/input.h"
#include "app/cli/json_text.h"
#include "core/files/image_files.h"
#include "core/reference/wide_kernel.h"
#include "core/render/compose.h"
#include "core/render/prepared_engine.h"
#include "core/task/error.h"
#include "core/task/memory.h"
#include "core/volume/nrrd.h"

namespace pellucid::cli {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using task::Error;
using task::ErrorCode;

struct Options {
    std::string path, out, series, view, orientation, size, window, reconstruction, quality, kernel,
        storage, engine = "auto", scene;
    double azimuthDeg = 0.0, elevationDeg = 0.0, rollDeg = 0.0, pixelMm = 0.0, rollOff = -1.0,
           tolerance = 0.0, padding = 0.0;
    int threads = 0, frames = 0;
    std::uint64_t memory = 0;
    bool turntable = false, json = false;
};

const std::map<std::string, render::StandardView> views{
    {"front", render::StandardView::front}, {"back", render::StandardView::back},
    {"left", render::StandardView::left},   {"right", render::StandardView::right},
    {"top", render::StandardView::top},     {"bottom", render::StandardView::bottom}};

const std::map<std::string, render::Reconstruction> reconstructions{
    {"cubic", render::Reconstruction::cubic},
    {"linear", render::Reconstruction::linear},
    {"band-limited", render::Reconstruction::bandLimited}};

enum class OutputKind { png, npy, nrrd };

OutputKind outputKind(const fs::path &out) {
    const std::string suffix = out.extension().string();
    if (suffix == ".png")
        return OutputKind::png;
    if (suffix == ".npy")
        return OutputKind::npy;
    if (suffix == ".nrrd")
        return OutputKind::nrrd;
    if (suffix == ".dcm")
        throw Error(ErrorCode::usage,
                    "-o: writing Secondary Captures (.dcm) is not available in this version");
    throw Error(ErrorCode::usage, "-o: '" + out.string() + "' must end in .png, .npy or .nrrd");
}

render::Scene readScene(const fs::path &path) {
    std::ifstream in(path);
    if (!in)
        throw Error(ErrorCode::unusable, "cannot be read", path);
    std::ostringstream text;
    text << in.rdbuf();
    try {
        return render::sceneFromJson(text.str());
    } catch (const Error &error) {
        throw Error(error.code(), error.reason(), path);
    }
}

render::Scene sceneFor(const Options &o, const CLI::App &command, const volume::Lattice &lattice) {
    const auto given = [&](const char *name) { return command.count(name) > 0; };
    render::Scene scene;
    if (!o.scene.empty()) {
        scene = readScene(o.scene);
    } else {
        // A large volume may have no default image; naming a size or a pixel gives it one.
        if (!given("--size") && !given("--pixel-mm"))
            scene.camera = render::defaultCamera(lattice);
        scene.camera.orientation = render::viewOrientation(render::StandardView::front);
        scene.camera.pixelMm = lattice.shortestStepMm();
    }
    for (const auto &[name, value] : {std::pair{"--azimuth", o.azimuthDeg},
                                      {"--elevation", o.elevationDeg},
                                      {"--roll", o.rollDeg},
                                      {"--roll-off", std::max(o.rollOff, 0.0)}})
        if (!std::isfinite(value))
            throw Error(ErrorCode::usage, std::string(name) + ": the number must be finite");
    if (given("--orientation")) {
        if (given("--view") || given("--azimuth") || given("--elevation") || given("--roll"))
            throw Error(ErrorCode::usage,
                        "--orientation excludes --view, --azimuth, --elevation and --roll");
        const auto q = parseNumbers("--orientation", o.orientation, ',', 4);
        // Scaled first, so that huge and tiny quaternions can be normalised too.
        const double largest =
            std::max({std::abs(q[0]), std::abs(q[1]), std::abs(q[2]), std::abs(q[3]), 1e-300});
        const glm::dquat rotation(q[0] / largest, q[1] / largest, q[2] / largest, q[3] / largest);
        if (!(glm::length(rotation) > 0.0))
            throw Error(ErrorCode::usage, "--orientation: the quaternion must not be zero");
        scene.camera.orientation = glm::normalize(rotation);
    } else if (o.scene.empty() || given("--view") || given("--azimuth") || given("--elevation") ||
               given("--roll")) {
        scene.camera.orientation =
            render::viewOrientation(o.view.empty() ? render::StandardView::front : views.at(o.view),
                                    {o.azimuthDeg, o.elevationDeg, o.rollDeg});
    }
    if (given("--pixel-mm")) {
        scene.camera.pixelMm = o.pixelMm;
        if (o.scene.empty() && !given("--size")) { // the whole volume at that pixel
            const double side = 2.0 * lattice.radiusMm() / o.pixelMm;
            if (!(o.pixelMm > 0.0) || side > render::largestImageSize)
                throw Error(
                    ErrorCode::usage,
                    fmt::format(
                        "--pixel-mm: an image of the whole volume would have {:.0f} pixels a side",
                        side));
            const int n = int(std::ceil(side - 1e-6));
            scene.camera.width = scene.camera.height = std::max(2, n + n % 2);
        }
    }
    if (given("--size")) {
        if (o.size.find_first_not_of("0123456789x") != std::string::npos)
            throw Error(ErrorCode::usage,
                        "--size: '" + o.size + "' is not whole numbers with 'x' between them");
        const auto n = parseNumbers("--size", o.size, 'x', 2);
        if (n[0] != std::round(n[0]) || n[1] != std::round(n[1]) || std::min(n[0], n[1]) < 1 ||
            std::max(n[0], n[1]) > render::largestImageSize)
            throw Error(ErrorCode::usage,
                        fmt::format("--size: '{}' is not WIDTHxHEIGHT of 1 to {} pixels", o.size,
                                    render::largestImageSize));
        scene.camera.width = int(n[0]);
        scene.camera.height = int(n[1]);
    }
    if (given("--window"))
        scene.fieldWindow = parseWindow(o.window);
    if (given("--reconstruction"))
        scene.image.reconstruction = reconstructions.at(o.reconstruction);
    if (given("--roll-off"))
        scene.image.rollOff = o.rollOff;
    if (given("--quality"))
        for (const auto &[name, tolerance] : render::namedTolerances)
            if (o.quality == name)
                scene.tolerance = tolerance;
    if (given("--tolerance"))
        scene.tolerance = o.tolerance;
    if (given("--kernel"))
        scene.interpolation.kernel = fourier::kernelFromName(o.kernel);
    if (given("--padding"))
        scene.interpolation.padding = o.padding;
    if (given("--storage"))
        scene.interpolation.storage = fourier::storageFromName(o.storage);
    render::validate(scene);
    return scene;
}

// The projection as a flat volume that lies in the patient where the picture plane does.
void writeImageNrrd(const fs::path &path, const render::ProjectionImage &image,
                    const render::Camera &camera, const volume::Lattice &patient) {
    const glm::dmat3 axes = camera.axes();
    const glm::dvec3 right = camera.pixelMm * axes[0], down = -camera.pixelMm * axes[1];
    const glm::dvec3 center =
        patient.center().mm + camera.panMm.x * axes[0] + camera.panMm.y * axes[1];
    const glm::dvec3 origin =
        center - 0.5 * (camera.width - 1) * right - 0.5 * (camera.height - 1) * down;
    const auto lattice = volume::Lattice::make({image.width, image.height, 1}, {origin},
                                               {right, down, -camera.pixelMm * axes[2]});
    volume::writeNrrd(path, volume::Volume(lattice, image.samples, volume::ValueUnit::none));
}

void writeImage(const fs::path &path, const render::ProjectionImage &image,
                const render::Scene &scene, const volume::Lattice &patient) {
    switch (outputKind(path)) {
    case OutputKind::png:
        files::writePng(path, render::compose(image, scene.tone), image.height, image.width);
        break;
    case OutputKind::npy:
        files::writeNpy(path, image.samples, image.height, image.width);
        break;
    case OutputKind::nrrd:
        writeImageNrrd(path, image, scene.camera, patient);
        break;
    }
}

fs::path framePath(const fs::path &out, int frame) {
    return out.parent_path() /
           fmt::format("{}_{:04d}{}", out.stem().string(), frame, out.extension().string());
}

json doubles(const volume::GridSize &size) {
    return {size.i, size.j, size.k};
}

class Renderer {
public:
    Renderer(const render::Scene &scene, const classify::DensityField &field,
             const render::Budget &budget, const Context &context)
        : m_scene(scene), m_summary(render::summarise(field)) {
        auto fitting = render::planWithin(scene, field, m_summary, budget);
        m_plan = std::move(fitting.plan);
        m_reduction = fitting.reduction;
        const task::Progress progress(context.stop);
        // The engine's error is known in advance; what it cannot meet the exact reference does,
        // unless the memory is short or the user wants to see what a kernel does.
        const std::size_t exactBytes =
            reference::WideKernel::bytes(field.support) +
            reference::sliceBytes(field.values.lattice(), scene.camera, scene.image);
        const bool engine = m_plan->predictedError <= scene.tolerance ||
                            scene.interpolation != render::Interpolation() ||
                            fitting.reduction > 1 || exactBytes > budget.bytes;
        if (engine) {
            const auto &source = fitting.reducedField ? *fitting.reducedField : field;
            m_engine = std::make_unique<render::CpuEngine>(
                std::make_shared<const fourier::Spectrum>(
                    fourier::Spectrum::prepare(source.values, m_plan->spectrum, progress)),
                m_plan->room);
            m_lattice = source.values.lattice();
            m_bytes = m_plan->bytes;
        } else {
            m_reference =
                std::make_unique<reference::WideKernel>(field.values, field.support, progress);
            m_bytes = exactBytes;
        }
    }

    render::ProjectionImage image(const render::Camera &camera, render::FrameTimes &times) {
        if (m_engine)
            return m_engine->render(camera, m_scene.image, &times);
        Stopwatch watch;
        const auto exact = m_reference->image(camera, m_scene.image);
        times = {watch.lapMs(), 0.0};
        return {camera.width, camera.height, camera.pixelMm,
                std::vector<float>(exact.begin(), exact.end())};
    }

    std::string description() const {
        return m_engine ? m_engine->description() : "exact reference, double precision";
    }

    json planJson() const {
        const auto &s = m_plan->spectrum;
        if (!m_engine)
            return {
                {"kernel", "KB12"}, {"taps", 12 * 12 * 12}, {"padding", 2.0}, {"storage", "f64"}};
        const render::SliceGrid grid =
            render::sliceGrid(m_scene.camera, m_plan->room, *m_lattice, m_scene.image);
        const int w = s.width();
        return {{"kernel", s.kernels[0].name()},
                {"taps", w * w * w},
                {"padded", doubles(s.padded)},
                {"box", doubles(s.box.size())},
                {"padding", double(s.padded.i) / s.box.size().i},
                {"slice_grid", {grid.columns, grid.rows}},
                {"storage", fourier::storageName(s.storage)},
                {"reason", m_plan->reason}};
    }
    std::size_t bytes() const { return m_bytes; }
    bool isReduced() const { return m_reduction > 1; }
    const std::string &reason() const { return m_plan->reason; }
    // The reference's largest error is not predicted: it lies below what a float image holds.
    std::optional<double> predictedMaximum() const {
        return m_engine ? std::optional(m_plan->predictedMaximum) : std::nullopt;
    }
    // Double precision leaves rounding, about 1e-10, and what is left of the roll-off's tails.
    double predictedError() const {
        if (m_engine)
            return m_plan->predictedError;
        return std::hypot(1e-10, reference::foldedTails(m_summary.lattice, m_scene.camera,
                                                        m_scene.image, *m_summary.energy.spread));
    }

private:
    const render::Scene &m_scene;
    render::FieldSummary m_summary;
    std::optional<render::RenderPlan> m_plan;
    std::optional<volume::Lattice> m_lattice; ///< of what the engine renders
    std::size_t m_bytes = 0;
    int m_reduction = 1;
    std::unique_ptr<render::CpuEngine> m_engine;
    std::unique_ptr<reference::WideKernel> m_reference;
};

void run(const Options &o, const CLI::App &command, const Context &context) {
    const fs::path out(o.out);
    outputKind(out); // refused before any work is done
    if (o.engine == "gpu")
        throw Error(ErrorCode::noSuchDevice,
                    "--engine gpu: the GPU engine is not available in this version");
    if (o.turntable != (o.frames > 0))
        throw Error(ErrorCode::usage, "--frames and --turntable go together");
    std::optional<tbb::global_control> threads;
    if (o.threads > 0)
        threads.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(o.threads));

    const Input input = openInput(o.path, o.series, context);
    const volume::Volume &volume = input.loaded.volume;
    render::Scene scene = sceneFor(o, command, volume.lattice());
    Stopwatch watch;
    const classify::FieldWindow window =
        scene.fieldWindow.value_or(classify::defaultFieldWindow(volume));
    const std::size_t held = volume.bytes() + volume.lattice().size().count() * sizeof(float);
    if (command.count("--memory") > 0 && o.memory < held)
        throw Error(ErrorCode::outOfMemory,
                    fmt::format("the volume needs {} MB, {} MB are allowed", (held >> 20) + 1,
                                o.memory >> 20),
                    o.path);
    const auto field = classify::densityField(volume, window, task::Progress(context.stop));
    // Asking for more than there is would end in the system killing the program.
    render::Budget budget{task::availableMemoryBytes()};
    if (command.count("--memory") > 0)
        budget.bytes = std::min(budget.bytes, std::size_t(o.memory - held));
    const double fieldMs = watch.lapMs();
    Renderer renderer(scene, field, budget, context);
    const double prepareMs = watch.lapMs();
    std::vector<std::string> warnings = volume.notes().warnings;
    const auto warn = [&](const std::string &text) {
        warnings.push_back(text);
        std::fprintf(stderr, "pellucid-cli: warning: %s\n", text.c_str());
    };
    if (renderer.isReduced())
        warn(renderer.reason());
    if (renderer.predictedError() > scene.tolerance && scene.tolerance > 1e-9)
        warn(fmt::format("the tolerance of {:.2g} is not met: {:.2g} is predicted", scene.tolerance,
                         renderer.predictedError()));
    if (field.support.size().count() == 1 && field.values.value(field.support.lo) == 0.0)
        warn(fmt::format("the field is empty: no value lies above {} within a window of {} to {}",
                         window.low, window.low, window.high));

    render::FrameTimes times;
    double writeMs = 0.0;
    const int frames = std::max(1, o.frames);
    for (int frame = 0; frame < frames; ++frame) {
        task::Progress(context.stop).check();
        render::Scene turned = scene;
        turned.camera.orientation =
            glm::angleAxis(glm::radians(360.0 * frame / frames), glm::dvec3(0, 0, 1)) *
            scene.camera.orientation;
        const auto image = renderer.image(turned.camera, times);
        task::Progress(context.stop).check();
        watch.lapMs();
        writeImage(o.frames > 0 ? framePath(out, frame) : out, image, turned, volume.lattice());
        writeMs += watch.lapMs();
    }
    if (!o.json)
        return;
    json skipped = json::array();
    for (const auto &s : input.skipped)
        skipped.push_back({{"path", s.path.string()}, {"reason", s.reason}});
    const volume::Lattice &l = volume.lattice();
    std::puts(
        jsonText({{"engine", renderer.description()},
                  {"device", "cpu"},
                  {"size", {scene.camera.width, scene.camera.height}},
                  {"pixel_mm", scene.camera.pixelMm},
                  {"frames", frames},
                  {"volume",
                   {{"size", doubles(l.size())},
                    {"spacing_mm", {l.spacingMm(0), l.spacingMm(1), l.sliceDistanceMm()}},
                    {"tilt_deg", l.shearRad() * 180.0 / 3.14159265358979323846},
                    {"series", input.seriesUid}}},
                  {"window", {window.low, window.high}},
                  {"milliseconds",
                   {{"scan", input.scanMs},
                    {"load", input.loadMs},
                    {"field", fieldMs},
                    {"prepare", prepareMs},
                    {"slice", times.sliceMs},
                    {"transform", times.transformMs},
                    {"frame", times.totalMs()},
                    {"write", writeMs}}},
                  {"bytes", renderer.bytes()},
                  {"plan", renderer.planJson()},
                  {"tolerance", scene.tolerance},
                  {"predicted_error",
                   {{"relative_l2", renderer.predictedError()},
                    {"maximum", renderer.predictedMaximum() ? json(*renderer.predictedMaximum())
                                                            : json(nullptr)}}},
                  {"warnings", warnings},
                  {"skipped", skipped}})
            .c_str());
}

} // namespace

void addRenderCommand(CLI::App &app, const Context &context) {
    const CLI::Validator positive(
        [](std::string &text) {
            char *end = nullptr;
            const double value = std::strtod(text.c_str(), &end);
            const bool good =
                end != text.c_str() && *end == '\0' && std::isfinite(value) && value > 0.0;
            return good ? std::string() : "'" + text + "' is not a positive number";
        },
        "", "positive");
    const CLI::Validator notNegative(
        [](std::string &text) {
            return text.rfind('-', 0) == 0 ? "'" + text + "' is not a size" : std::string();
        },
        "", "size");
    auto o = std::make_shared<Options>();
    CLI::App *c = app.add_subcommand("render", "Project a volume into an image");
    const auto names = [](const auto &map) {
        std::vector<std::string> keys;
        for (const auto &[key, value] : map)
            keys.push_back(key);
        return keys;
    };
    c->add_option("PATH", o->path, "A file, a folder, a DICOMDIR or an NRRD file")->required();
    c->add_option("-o,--output", o->out, "The image: .png, .npy or .nrrd")->required();
    c->add_option("--series", o->series,
                  "Series number or UID; default: the volume with most voxels");
    c->add_option("--view", o->view, "Standard view, default front")
        ->check(CLI::IsMember(names(views)));
    c->add_option("--azimuth", o->azimuthDeg,
                  "Degrees about the patient's long axis, added to the view");
    c->add_option("--elevation", o->elevationDeg, "Degrees up from the horizon, added to the view");
    c->add_option("--roll", o->rollDeg, "Degrees about the line of sight, added to the view");
    c->add_option("--orientation", o->orientation, "Rotation [U V W] as a quaternion w,x,y,z");
    c->add_option("--size", o->size, "Image size WxH in pixels; default: holds every view");
    c->add_option("--pixel-mm", o->pixelMm, "Pixel size in mm; default: the shortest voxel step")
        ->check(positive);
    c->add_option("--window", o->window, "The field's window LO,HI in value units");
    c->add_option("--reconstruction", o->reconstruction, "What lies between the samples")
        ->check(CLI::IsMember(names(reconstructions)));
    c->add_option("--roll-off", o->rollOff, "Share of the band that is rolled off, default 0.05")
        ->check(CLI::Range(0.0, 1.0));
    CLI::Option *quality =
        c->add_option("--quality", o->quality, "Named tolerance, default standard")
            ->check(CLI::IsMember(names(render::namedTolerances)));
    c->add_option("--tolerance", o->tolerance, "Largest relative L2 error")
        ->check(positive)
        ->excludes(quality);
    c->add_option("--kernel", o->kernel,
                  "Interpolation kernel; default: the cheapest that keeps the tolerance");
    c->add_option("--padding", o->padding, "Padded size over field size, default as needed")
        ->check(CLI::Range(1.0, 4.0));
    c->add_option("--storage", o->storage, "Cells of the spectrum, default as needed")
        ->check(CLI::IsMember({"f16", "f32"}));
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
    c->add_option("--scene", o->scene, "Start from a scene saved as JSON");
    c->add_flag("--json", o->json, "Print one JSON object about what was done");
    c->callback([o, c, context] { run(*o, *c, context); });
}

} // namespace pellucid::cli
