// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch_job.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/image_output.h"
#include "app/cli/input.h"
#include "app/cli/json_text.h"
#include "app/cli/reason_lines.h"
#include "app/cli/scene_renderer.h"
#include "app/cli/write_behind.h"
#include "core/batch/derived_uid.h"
#include "core/batch/reasons.h"
#include "core/dicom/load_volume.h"
#include "core/dicom/write_capture.h"
#include "core/files/image_files.h"
#include "core/files/reasons.h"
#include "core/files/video_file.h"
#include "core/picture/compose.h"
#include "core/picture/display.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::cli {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using batch::DoneRecord;
using batch::Format;
using batch::Output;
using task::Error;
using task::ErrorCode;

constexpr int framesPerSecond = 25; // of videos and loops

// A digest of the images of a volume: the same wherever their files are, and whatever else their
// study contains, such as the pictures of an earlier run.
std::string imagesOf(const dicom::Selection &selection, const std::string &inputs) {
    std::set<fs::path> used;
    for (const dicom::FrameReference &frame : selection.volume->frames)
        used.insert(frame.path);
    std::vector<std::string> uids;
    for (const dicom::InstanceFile &file : selection.series->files)
        if (!file.sopInstanceUid.empty() && used.contains(file.path))
            uids.push_back(file.sopInstanceUid);
    return uids.empty() ? inputs : batch::digestOf(std::move(uids));
}

// The scene without its direction. Views that differ in nothing else share a plan.
scene::Scene subjectOf(scene::Scene scene) {
    scene.camera.orientation = glm::dquat(1.0, 0.0, 0.0, 0.0);
    scene.camera.panMm = {};
    return scene;
}

// The memory that a grey picture usually needs: the values, the field, and a spectrum of single
// precision with its transform. What needs more is found out when it is planned.
std::size_t bytesFor(const dicom::VolumeEntry &volume) {
    constexpr std::size_t bytesOfVoxel = 48;
    return bytesOfVoxel * volume.voxels();
}

class StudyRun {
public:
    StudyRun(const StudyToRender &study, const batch::Recipe &recipe, const fs::path &folder,
             batch::MemoryShares &memory, std::size_t needed, const CardChoice &card,
             const Context &context)
        : m_study(study), m_recipe(recipe), m_folder(folder), m_memory(memory), m_needed(needed),
          m_card(card), m_context(context) {}

    DoneRecord run() {
        Stopwatch watch;
        const task::Progress progress(m_context.stop);
        const dicom::Selection selection =
            batch::choose(m_recipe.series, m_study.patient, m_study.study);
        const auto share = m_memory.take(std::max(m_needed, bytesFor(*selection.volume)), progress);
        m_memoryBytes = share.bytes();
        const dicom::LoadedVolume loaded = dicom::loadVolume(*selection.volume, progress);
        if (!loaded.skipped.empty()) // a picture of a part is not what the recipe asks for
            throw Error(ErrorCode::unusable, loaded.skipped.front().reason,
                        m_study.catalogue.named(loaded.skipped.front().path));
        if (!loaded.volume.notes().placed)
            throw Error(ErrorCode::unusable, because::inWords("contains images but no volume"));
        m_volume = &loaded.volume;
        m_labels = dicom::captureLabels(selection);
        m_images = imagesOf(selection, m_study.inputs);
        m_record.recipe = m_recipe.digest;
        m_record.inputs = m_study.inputs;
        m_record.studyUid = m_study.study.uid;
        m_record.seriesUid = selection.series->uid;
        m_record.loadSeconds = watch.lapMs() / 1000.0;
        renderAll();
        m_record.renderSeconds = watch.lapMs() / 1000.0;
        return std::move(m_record);
    }

    /// The share of the memory that it had.
    std::size_t memoryBytes() const { return m_memoryBytes; }

private:
    // Outputs in their order, except that those that share a preparation follow each other.
    void renderAll() {
        std::vector<std::pair<const Output *, scene::Scene>> scenes;
        for (const Output &output : m_recipe.outputs) {
            if (output.look)
                if (const auto why = presets::mismatch(*output.look, *m_volume))
                    throw Error(ErrorCode::unusable, *why, output.name);
            scenes.emplace_back(&output, batch::sceneOf(output, *m_volume));
        }
        m_record.outputs.resize(scenes.size());
        std::vector<bool> isDone(scenes.size());
        for (std::size_t first = 0; first < scenes.size(); ++first) {
            if (isDone[first])
                continue;
            const scene::Scene &scene = scenes[first].second;
            std::size_t pictures = 0;
            for (std::size_t n = first; n < scenes.size(); ++n)
                if (subjectOf(scenes[n].second) == subjectOf(scene))
                    pictures += std::max<std::size_t>(1, scenes[n].first->views.size());
            SceneRenderer renderer(scene, Subject{*m_volume, nullptr, {}}, int(pictures),
                                   MemoryLimit{.bytes = m_memoryBytes, .decides = false}, m_card,
                                   m_context);
            if (!renderer.whyEmpty().empty())
                throw Error(ErrorCode::unusable, because::inWords(renderer.whyEmpty()),
                            scenes[first].first->name);
            for (std::size_t n = first; n < scenes.size(); ++n)
                if (!isDone[n] && subjectOf(scenes[n].second) == subjectOf(scene)) {
                    isDone[n] = true;
                    m_record.outputs[n] = render(*scenes[n].first, scenes[n].second, renderer);
                }
        }
    }

    DoneRecord::MadeOutput render(const Output &output, scene::Scene scene,
                                  SceneRenderer &renderer) {
        DoneRecord::MadeOutput made{
            output.name, scene.tolerance, 0.0, {}, englishTexts(m_volume->notes().warnings)};
        for (const std::string &warning : renderer.warnings())
            made.warnings.push_back(warning);
        m_labels.warnings = made.warnings;
        std::vector<Named> unused;
        for (const dicom::Skipped &skipped : m_study.catalogue.skipped)
            unused.push_back(
                {m_study.catalogue.named(skipped.path).filename().string(), skipped.reason});
        for (const std::string &line : linesByReason(unused, "not used"))
            made.warnings.push_back(line);
        const bool isGrey = classify::isGrey(scene.look) && scene.shading.isGrey();
        if (!isGrey && (output.format == Format::png16 || output.format == Format::nrrd))
            throw Error(ErrorCode::usage, because::colorsHaveNoGreyValues);
        const bool isDisplayed = output.format != Format::npy && output.format != Format::nrrd;
        if (isDisplayed || output.fit == batch::Fit::body)
            scene.tone.exposure = renderer.exposure();
        const std::vector<scene::Camera> cameras =
            batch::camerasOf(output, scene, m_volume->lattice());
        scene.camera = cameras.front();
        renderer.requireRoomFor(scene.camera);
        const std::vector<std::string> files = batch::filesOf(output);
        beginFile(output, scene, files.front(), cameras.size(), isGrey);
        std::string worst; // warning
        error::StatedError largest;
        for (std::size_t view = 0; view < cameras.size(); ++view) {
            scene.camera = cameras[view];
            picture::ProjectionImage image =
                renderer.image(scene.camera, error::isChecked(output.check, view, cameras.size())
                                                 ? SceneRenderer::Check::measure
                                                 : SceneRenderer::Check::none);
            const error::StatedError &error = renderer.lastError();
            // A measurement says more than a bound.
            if (view == 0 || (error.isMeasured() && !largest.isMeasured()) ||
                (error.isMeasured() == largest.isMeasured() && error.relative > largest.relative))
                largest = error;
            m_missed = renderer.warningOfView();
            if (!m_missed.empty() && error == largest)
                worst = m_missed;
            add(output, scene, std::move(image), files[files.size() > 1 ? view : 0], int(view),
                error);
        }
        m_written.finish();
        made.predictedError = renderer.bound()->relative; // its fields are never reduced
        if (largest.isMeasured())
            made.measuredError = largest.relative;
        m_missed = worst;
        if (!worst.empty())
            made.warnings.push_back(worst);
        endFile(output, scene, files.front(), largest);
        return made;
    }

    dicom::CaptureLabels labelsFor(const Output &output, int view,
                                   const error::StatedError &error) const {
        dicom::CaptureLabels labels =
            output.isDeidentified ? dicom::deidentified(m_labels) : m_labels;
        // Another version may make other pixels, which need other UIDs.
        const std::string of = fmt::format("{} {} {} {}", PELLUCID_VERSION, m_recipe.digest,
                                           m_images, m_study.study.uid);
        labels.seriesUid = batch::derivedUid(fmt::format("series {} {}", of, output.name));
        if (!output.isDeidentified && !m_missed.empty())
            labels.warnings.push_back(m_missed);
        // Objects with other warnings, some of which name files, are other objects.
        std::string instance = fmt::format("instance {} {} {}", view, of, output.name);
        for (const std::string &warning : labels.warnings)
            instance += "\n" + warning;
        labels.instanceUid = batch::derivedUid(instance);
        if (output.isDeidentified)
            labels.studyUid = batch::derivedUid("study " + of);
        labels.isDated = false;
        labels.derivation = derivationText(error);
        labels.seriesDescription = output.name;
        labels.seriesNumber += int(&output - m_recipe.outputs.data()); // each is a series
        labels.instanceNumber = view + 1;
        return labels;
    }

    static picture::Pixels shown(const picture::ProjectionImage &image, const scene::Scene &scene) {
        return picture::compose(image, picture::displayOf(scene.tone, scene.camera.orientation));
    }

    // Files that all views of an output share.
    void beginFile(const Output &output, const scene::Scene &scene, const std::string &name,
                   std::size_t views, bool isGrey) {
        const int width = scene.camera.width, height = scene.camera.height;
        if (output.format == Format::npy) {
            std::vector<std::size_t> shape{std::size_t(height), std::size_t(width)};
            if (views > 1)
                shape.insert(shape.begin(), views);
            if (!isGrey)
                shape.push_back(3);
            m_array = std::make_unique<files::NpyFile>(m_folder / name, shape);
            m_geometry = nlohmann::json::array();
        } else if (output.format == Format::captureLoop) {
            if (dicom::CaptureLoop::bytesOf(int(views), height, width, isGrey) >
                dicom::CaptureLoop::maxBytes)
                throw Error(ErrorCode::usage,
                            because::loopIsTooLarge(dicom::CaptureLoop::maxBytes >> 20));
            m_loop = std::make_unique<dicom::CaptureLoop>(int(views), height, width, isGrey,
                                                          1000.0 / framesPerSecond);
        } else if (output.format == Format::video) {
            m_video =
                std::make_unique<files::VideoFile>(m_folder / name, width, height, framesPerSecond);
        }
    }

    // Files of their own are written while the next view is rendered.
    void add(const Output &output, const scene::Scene &scene, picture::ProjectionImage &&image,
             const std::string &name, int view, const error::StatedError &error) {
        const fs::path path = m_folder / name;
        switch (output.format) {
        case Format::npy:
            m_array->write(image.samples);
            m_geometry.push_back(geometryJson(scene.camera, m_volume->lattice(), error));
            break;
        case Format::png16:
            m_written.add([path, scene, image = std::move(image)] {
                files::writePng16(
                    path,
                    picture::greyOf(image,
                                    picture::plainDisplayOf(scene.tone, scene.camera.orientation),
                                    !scene.tone.high),
                    image.height, image.width);
            });
            break;
        case Format::captureLoop:
            m_loop->add(shown(image, scene));
            break;
        case Format::video:
            m_video->add(shown(image, scene), task::Progress(m_context.stop));
            break;
        case Format::png:
        case Format::nrrd:
        case Format::capture:
            m_written.add([path, scene, image = std::move(image), patient = m_volume->lattice(),
                           labels = labelsFor(output, view, error)] {
                writeImage(path, image, scene, patient, labels);
            });
            break;
        }
    }

    void endFile(const Output &output, const scene::Scene &scene, const std::string &name,
                 const error::StatedError &error) {
        const fs::path path = m_folder / name;
        if (m_array) {
            std::exchange(m_array, nullptr)->commit();
            writeGeometry(geometryPath(path), scene.camera, m_geometry);
        }
        if (m_loop)
            std::exchange(m_loop, nullptr)->write(path, labelsFor(output, 0, error));
        if (m_video)
            std::exchange(m_video, nullptr)->finish(task::Progress(m_context.stop));
    }

    const StudyToRender &m_study;
    const batch::Recipe &m_recipe;
    const fs::path &m_folder;
    batch::MemoryShares &m_memory;
    std::size_t m_needed;
    const CardChoice &m_card;
    const Context &m_context;
    std::size_t m_memoryBytes = 0;
    const volume::Volume *m_volume = nullptr;
    dicom::CaptureLabels m_labels;
    std::string m_missed; ///< the warning of the picture that is written, if it has one of its own
    std::string m_images;
    DoneRecord m_record;
    std::unique_ptr<files::NpyFile> m_array;
    nlohmann::json m_geometry;
    std::unique_ptr<dicom::CaptureLoop> m_loop;
    std::unique_ptr<files::VideoFile> m_video;
    WriteBehind m_written;
};

} // namespace

DoneRecord renderStudy(const batch::Recipe &recipe, const StudyToRender &study,
                       const fs::path &folder, batch::MemoryShares &memory, const CardChoice &card,
                       const Context &context) {
    {
        StudyRun run(study, recipe, folder, memory, 0, card, context);
        try {
            return run.run();
        } catch (const Error &error) {
            if (error.code() != ErrorCode::outOfMemory || run.memoryBytes() >= memory.bytes())
                throw;
        }
    } // what it was writing goes
    for (const fs::directory_entry &made : fs::directory_iterator(folder))
        fs::remove_all(made.path());
    return StudyRun(study, recipe, folder, memory, memory.bytes(), card, context).run();
}

} // namespace pellucid::cli
