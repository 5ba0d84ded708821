// SPDX-License-Identifier: GPL-3.0-or-later
// Before Qt, which defines a name of oneTBB as a macro.
#include <tbb/task_arena.h>

#include "ui/views/spectrum_sampler.h"

#include <algorithm>

#include "ui/document/document.h"

namespace pellucid::ui {

namespace {

// The shortest time from the start of one slice to that of the next.
constexpr int pauseMs = 100;

} // namespace

SpectrumSampler::SpectrumSampler(Document &document, QObject *parent)
    : QObject(parent), m_document(document) {
    m_pause.setSingleShot(true);
    m_pause.setInterval(pauseMs);
    connect(&m_pause, &QTimer::timeout, this, &SpectrumSampler::sampleNext);
    for (const auto changed : {&Document::poseChanged, &Document::projectionResized})
        connect(&document, changed, this, &SpectrumSampler::follow);
    connect(&document, &Document::volumeChanged, this, [this] {
        if (m_document.volume() && m_document.isPreview())
            return;
        // The spectrum belongs to another volume; that of this one comes with its engine.
        m_parts.reset();
        m_isStale = false;
        m_jobs.cancel();
        emit cleared({});
    });
}

void SpectrumSampler::setEngine(const ShownEngine &shown) {
    m_parts = shown.prepared.engine->parts();
    follow();
}

void SpectrumSampler::setActive(bool isActive) {
    if (isActive == m_isActive)
        return;
    m_isActive = isActive;
    if (isActive) {
        follow();
        return;
    }
    m_isStale = false;
    m_pause.stop();
    m_jobs.cancel();
}

scene::Camera SpectrumSampler::camera() const {
    scene::Camera camera = m_document.scene().camera;
    // The spectrum is periodic beyond the band of the samples.
    camera.pixelMm = std::max(camera.pixelMm, m_document.volume()->lattice().shortestStepMm());
    return camera;
}

void SpectrumSampler::follow() {
    if (!m_isActive || !m_parts || !m_document.volume())
        return;
    m_isStale = true;
    sampleNext();
}

void SpectrumSampler::sampleNext() {
    if (!m_isStale || m_jobs.isRunning() || m_pause.isActive())
        return;
    m_isStale = false;
    m_pause.start();
    m_jobs.start(
        {},
        [this, parts = *m_parts, camera = camera()](const Job &job) {
            // On one thread: frames need the others.
            render::SpectrumSlice slice;
            tbb::task_arena alone(1);
            alone.execute(
                [&] { slice = render::spectrumSlice(parts, camera, side, job.progress()); });
            job.deliver([this, slice] { emit sampled(slice); });
        },
        [this](const Outcome &outcome) {
            if (outcome.kind == Outcome::Kind::cancelled) // hidden, closed or destroyed
                return;
            if (outcome.kind == Outcome::Kind::failed)
                emit cleared(*outcome.reason);
            sampleNext();
        });
}

} // namespace pellucid::ui
