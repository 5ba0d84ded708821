// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/projection_frames.h"

#include <algorithm>
#include <utility>

#include <QCoreApplication>

#include "ui/document/document.h"
#include "ui/language/reasons.h"

namespace pellucid::ui {

namespace {

// A full frame that takes longer lags behind the hand: drafts are drawn while the view moves.
constexpr double smoothFrameMs = 35.0;
// The first frame also allocates its memory and may take three times as long as the next.
constexpr double firstFrameFactor = 3.0;
constexpr int restMs = 120;
// A hand that rests for so long has come to look.
constexpr int checkMs = 300;
// With one kernel, or on the card, a frame costs as much as its pixels. Its pixels are then no
// smaller than `scene::finestPixelMm`, or so many across the volume if those are smaller.
constexpr double pixelsAcross = 4096.0;

QImage imageOf(const picture::ProjectionImage &image, const picture::Display &display) {
    const auto rgba = picture::compose(image, display);
    return QImage(rgba.data(), image.width, image.height, QImage::Format_RGBA8888).copy();
}

} // namespace

ProjectionFrames::ProjectionFrames(Document &document)
    : m_document(document), m_comparison(document) {
    m_rest.setSingleShot(true);
    m_rest.setInterval(restMs);
    connect(&m_rest, &QTimer::timeout, this, [this] { request(false); });
    m_check.setSingleShot(true);
    m_check.setInterval(checkMs);
    connect(&m_check, &QTimer::timeout, this, &ProjectionFrames::measureError);
    connect(
        &m_meter, &ErrorMeter::measured, this,
        [this](std::uint64_t number, const error::StatedError &error, ErrorMeter::Figure figure) {
            // It may have been sent before the volume was left.
            if (!m_engine || !m_frame || m_frame->number != number)
                return;
            m_error = error;
            emit errorMeasured(error);
            if (figure == ErrorMeter::Figure::last && needsOneWidth())
                useOneWidth();
        });
    connect(&m_worker, &RenderWorker::frameReady, this, &ProjectionFrames::take);
    connect(&m_worker, &RenderWorker::failed, this, [this](const task::Reason &reason) {
        m_pending = false;
        emit failed(reason);
    });
    connect(&m_worker, &RenderWorker::cardFailed, this, &ProjectionFrames::cardFailed);
}

bool ProjectionFrames::setEngine(const ShownEngine &shown, EngineStage stage) {
    const bool isSame = m_engine && m_engine->prepared.engine == shown.prepared.engine &&
                        m_engine->onCard == shown.onCard && m_stage == stage &&
                        m_engine->reason == shown.reason;
    m_engine = shown;
    m_uniform.reset();
    if (isSame) {
        // Frames that are underway remain valid.
        giveToWorker();
        request(m_rest.isActive());
        return false;
    }
    // Weights that move are meant to change the brightness. Other fields, and the full ones after
    // the coarse ones, have a brightness of their own.
    const bool sameFields = stage == EngineStage::live || stage == EngineStage::settled;
    if (!sameFields) {
        m_tone.beginFields(m_document.scene());
        m_fullFrameMs = 0.0;
        m_isFirstOfKind = true;
    }
    // Frames of slightly older weights are shown, too: the hand may be faster than the frames.
    if (stage != EngineStage::live || m_stage != EngineStage::live)
        ++m_generation;
    m_stage = stage;
    giveToWorker();
    request(false);
    return true;
}

void ProjectionFrames::giveToWorker() {
    m_worker.setEngine(used().prepared, used().onCard, m_generation);
}

void ProjectionFrames::setPlanState(PlanState state) {
    m_planState = state;
    if (m_frame && !m_frame->draft && !m_pending)
        m_check.start(); // a coarse picture may stay
}

bool ProjectionFrames::forgetVolume() {
    m_check.stop();
    m_meter.cancel();
    m_engine.reset();
    m_uniform.reset();
    m_worker.setEngine(std::nullopt, nullptr, ++m_generation);
    m_planState = PlanState::holds;
    m_comparison.forget();
    m_isComparing = false;
    if (m_tone.outlivesVolume(m_document.volume().has_value()))
        return false;
    m_frame.reset();
    m_isFirstOfVolume = true;
    m_drawnShading = {};
    return true;
}

void ProjectionFrames::adoptExposure() {
    if (const auto exposure = m_document.exposure())
        m_tone.adopt(*exposure, m_document.scene());
}

void ProjectionFrames::holdExposure() {
    if (m_frame)
        m_tone.hold();
}

void ProjectionFrames::retakeExposure() {
    m_tone.retake();
    request(false);
}

void ProjectionFrames::request(bool moving) {
    m_check.stop();
    m_meter.cancel();
    if (!m_engine)
        return;
    if (m_uniform) {
        m_uniform.reset();
        giveToWorker();
    }
    requestFrame(moving);
}

// Widths are chosen within the tolerance of the whole volume. A part may miss the tolerance; with
// one kernel for every frequency its error is smaller.
bool ProjectionFrames::needsOneWidth() const {
    const prepare::PreparedEngine &prepared = m_engine->prepared;
    return !m_uniform && !m_pending && !m_isComparing && prepare::choosesWidths(prepared) &&
           prepare::missesTolerance(prepared, *m_error, prepare::shownOf(prepared, m_frame->camera),
                                    m_document.scene());
}

void ProjectionFrames::useOneWidth() {
    const auto &onCard = m_engine->onCard;
    m_uniform = {prepare::withOneWidth(m_engine->prepared),
                 onCard ? onCard->withOneWidth() : nullptr, m_engine->reason};
    giveToWorker();
    requestFrame(false);
    m_uniformFrame = m_requested;
}

void ProjectionFrames::requestFrame(bool moving) {
    const prepare::PreparedEngine &prepared = used().prepared;
    const bool draft = moving && m_fullFrameMs > smoothFrameMs;
    m_pending = true;
    const volume::Lattice &lattice = m_document.volume()->lattice();
    // The picture that this one is compared with may have been rendered with one kernel.
    const bool isAdaptive = prepare::choosesWidths(prepared) && !used().onCard && !m_isComparing;
    const double finest = isAdaptive ? 0.0
                                     : std::min(scene::finestPixelMm(lattice),
                                                2.0 * lattice.radiusMm() / pixelsAcross);
    shading::Shading shading = m_document.scene().shading;
    if (shading.isLit() && !prepared.canBeLit) // until light is prepared, the shading stays
        shading = m_drawnShading;
    else
        m_tone.follow(shading, m_document.scene());
    m_drawnShading = shading;
    std::optional<RenderWorker::Compared> compared;
    if (const auto &before = m_comparison.before(); m_isComparing && before)
        compared = {before->engine, before->image, before->shading};
    std::optional<RenderWorker::Exposed> exposed;
    if (m_tone.isWanted())
        exposed = {lattice, m_document.scene().tone, picture::ToneSubject(m_document.scene()),
                   picture::backgroundOf(*m_document.volume())};
    m_requested = m_worker.request(m_document.scene().camera, m_document.scene().image, shading,
                                   {.draft = draft, .finestPixelMm = finest}, exposed, compared);
    if (moving)
        m_rest.start();
}

void ProjectionFrames::take(const std::shared_ptr<const RenderedFrame> &frame) {
    if (!m_engine ||
        frame->generation != m_generation) // of a closed volume, or of the coarse engine
        return;
    // It was requested before the exposure was: the next frame has one.
    if (m_tone.isWanted() && !frame->exposure)
        return;
    if (frame->exposure) {
        m_tone.take(*frame->exposure);
        // Another request, which measured again, may have been replaced meanwhile. Weights that
        // move keep the exposure.
        picture::ToneSubject now(m_document.scene());
        now.look = frame->exposed.look;
        if (now != frame->exposed) {
            m_tone.retake();
            request(m_rest.isActive());
        }
    }
    if (std::exchange(m_isFirstOfVolume, false)) {
        const scene::Camera before = m_document.scene().camera;
        emit bodyFound();
        if (!(m_document.scene().camera == before))
            return; // the frame of the moved view follows
    }
    m_frame = frame;
    // The view may have moved meanwhile, and uses chosen widths again.
    const bool isOfOneWidth = frame->number == m_uniformFrame;
    const ShownEngine &engine = isOfOneWidth ? used() : *m_engine;
    m_error = prepare::boundOf(engine.prepared, m_document.scene().image);
    m_frameStage = m_stage;
    m_pending = m_rest.isActive() || frame->number != m_requested;
    if (!frame->draft && !isOfOneWidth) {
        m_fullFrameMs = frame->times.totalMs() / (m_isFirstOfKind ? firstFrameFactor : 1.0);
        m_isFirstOfKind = false;
    }
    emit shown();
    if (showsFinalImage()) {
        if (m_planState == PlanState::holds) {
            m_document.setExposure(m_tone.exposure());
            m_comparison.settled({m_engine->prepared.engine, m_document.scene().image,
                                  m_drawnShading, shownTone(), m_lookName});
        }
        emit finalShown();
    }
    if (!frame->draft && !m_pending)
        m_check.start();
}

// Not while the engine that follows is being prepared: the processor has enough to do.
void ProjectionFrames::measureError() {
    if (!m_frame || !m_engine || !m_engine->prepared.study || m_pending ||
        m_planState == PlanState::underway)
        return;
    const auto &[prepared, onCard, reason] = used();
    std::shared_ptr<render::ProjectionEngine> engine = prepared.engine;
    if (m_frame->onCard && onCard)
        engine = onCard;
    shading::Shading shading = m_drawnShading;
    if (!prepared.canBeLit)
        shading.lights.clear();
    const scene::ImageDefinition &image = m_document.scene().image;
    const volume::Lattice &lattice = m_document.volume()->lattice();
    const scene::Camera camera = prepare::checkedCamera(m_frame->camera, lattice);
    m_meter.measure({m_worker.period(engine, camera, image, shading), prepared.study,
                     shading::shadingScale(lattice), image, shading, m_frame->number});
}

DescribedFrame ProjectionFrames::described() const {
    return {*m_frame, m_error, m_frameStage, m_planState, m_pending};
}

QString ProjectionFrames::engineText() const {
    const auto &[prepared, onCard, reason] = used();
    const task::Reason engine =
        m_frame->onCard && onCard ? onCard->description() : prepared.engine->description();
    return QCoreApplication::translate("ProjectionView", "%1: %2")
        .arg(translated(engine), translated(m_frame->refusal.value_or(reason)));
}

scene::Tone ProjectionFrames::shownTone() const {
    return m_tone.completed(m_document.scene().tone);
}

picture::Display ProjectionFrames::display() const {
    return picture::displayOf(shownTone(), m_frame ? m_frame->camera.orientation
                                                   : m_document.scene().camera.orientation);
}

picture::ToneRange ProjectionFrames::automaticRange() const {
    const scene::Tone automatic = m_tone.completed({});
    return picture::displayOf(automatic, m_document.scene().camera.orientation).range;
}

QImage ProjectionFrames::picture() const {
    if (!m_frame)
        return {};
    return m_frame->onCard ? imageOf(m_frame->onCard->download(), display())
                           : imageOf(m_frame->image, display());
}

std::function<picture::ProjectionImage(const scene::Camera &)> ProjectionFrames::renderer() {
    return
        [this, engine = m_engine ? used().prepared.engine : nullptr,
         image = m_document.scene().image, shading = m_drawnShading](const scene::Camera &camera) {
            return m_worker.picture(engine, camera, image, shading).get();
        };
}

void ProjectionFrames::setComparing(bool isComparing) {
    const bool was = m_isComparing;
    m_isComparing = isComparing && m_frame && m_comparison.before();
    if (m_isComparing || was) // while comparing, no picture is rendered with one kernel
        request(false);
}

std::optional<ProjectionFrames::Compared> ProjectionFrames::compared() const {
    const auto &before = m_comparison.before();
    if (!m_isComparing || !m_frame || !m_frame->compared || !before)
        return std::nullopt;
    const QImage now = picture();
    const QImage then =
        imageOf(*m_frame->compared, picture::displayOf(before->tone, m_frame->camera.orientation));
    return Compared{besideEachOther(then.scaled(now.size()), now), before->name};
}

} // namespace pellucid::ui
