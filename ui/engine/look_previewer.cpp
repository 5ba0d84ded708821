// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/engine/look_previewer.h"

#include <algorithm>

#include "core/classify/coarse_field.h"
#include "core/picture/compose.h"
#include "core/picture/exposure.h"
#include "core/prepare/prepared_engine.h"
#include "core/preprocess/step_cache.h"
#include "ui/document/document.h"

namespace pellucid::ui {

namespace {

constexpr int coarseSide = 72;
constexpr int histogramBins = 4096;
// The results of steps on a coarse volume are small: a dozen fit, for presets that share them.
constexpr std::size_t stepsBytes = std::size_t(64) << 20;

// A fixed kernel makes planning unnecessary.
scene::Scene pictureScene(const volume::Lattice &lattice) {
    scene::Scene scene;
    scene.camera.orientation = scene::viewOrientation(scene::StandardView::front);
    scene.camera.width = 2 * LookPreviewer::pictureWidth;
    scene.camera.height = 2 * LookPreviewer::pictureHeight;
    scene.camera.pixelMm =
        2.0 * lattice.radiusMm() * 0.7 / std::min(scene.camera.width, scene.camera.height);
    scene.tolerance = 1e-2;
    scene.interpolation.kernel = fourier::kernelFromName("ES4");
    scene.interpolation.padding = 1.5;
    scene.interpolation.storage = fourier::Storage::binary16;
    // Each engine makes one picture: choosing widths would take longer than it saves.
    scene.interpolation.isUniform = true;
    return scene;
}

QImage pictureOf(const volume::Volume &volume, const classify::FieldWindow &window,
                 const classify::Look &look, const shading::Shading &shading,
                 const shading::ShadingScale &scale, classify::StepRunner &steps,
                 const task::Progress &progress) {
    scene::Scene scene = pictureScene(volume.lattice());
    scene.shading = shading;
    auto fields = classify::shownFields(volume, window, look, &steps, progress);
    const auto prepared = prepare::prepareEngine({scene, std::move(fields), {}, scale}, progress);
    const auto image = prepared.engine->render(scene.camera, scene.image, scene.shading);
    scene::Tone tone;
    tone.exposure =
        picture::exposureOf(image, tone, picture::backgroundOf(volume),
                            picture::outlineMm2(volume.lattice(), scene.camera.orientation));
    const auto rgba = picture::compose(image, picture::displayOf(tone, scene.camera.orientation));
    return QImage(rgba.data(), image.width, image.height, QImage::Format_RGBA8888).copy();
}

} // namespace

LookPreviewer::LookPreviewer(Document &document, QObject *parent)
    : QObject(parent), m_document(document) {
    document.whenever(Change::volume, this, [this] {
        if (!m_document.volume() || m_document.isPreview())
            m_jobs.cancel();
    });
}

void LookPreviewer::preview(const std::vector<presets::Preset> &presets) {
    const auto &open = m_document.volume();
    if (!open || m_document.isPreview())
        return;
    m_jobs.start({}, [this, volume = *open, own = m_document.defaultFieldWindow(),
                      segments = m_document.segments(), presets](const Job &job) {
        const auto histogram = volume::histogram(volume, histogramBins);
        job.deliver([this, histogram] { emit histogramReady(histogram); });
        if (!volume.notes().placed)
            return;
        const volume::Volume coarse = classify::coarseVolume(volume, coarseSide);
        preprocess::StepCache steps(stepsBytes);
        preprocess::ClassRunner runner(steps, segments);
        for (const presets::Preset &preset : presets) {
            job.progress().check();
            const classify::FieldWindow window = preset.window.value_or(own);
            QImage picture;
            try {
                picture =
                    pictureOf(coarse, window, presets::lookFor(preset, window), preset.shading,
                              shading::shadingScale(volume.lattice()), runner, job.progress());
            } catch (const task::Error &) {
                // A preset that fails here reports the reason when it is chosen.
            }
            job.deliver([this, name = QString::fromStdString(preset.name), picture] {
                emit pictureReady(name, picture);
            });
        }
    });
}

} // namespace pellucid::ui
