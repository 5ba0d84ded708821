// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/engine/render_worker.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/task/error.h"
#include "ui/engine/reasons.h"
#include "ui/language/failure.h"

namespace pellucid::ui {

namespace {

constexpr std::chrono::milliseconds cardPatience(150);

} // namespace

RenderWorker::RenderWorker(QObject *parent)
    : QObject(parent), m_thread([this](const std::stop_token &stop) { run(stop); }) {
    qRegisterMetaType<std::shared_ptr<const RenderedFrame>>();
    qRegisterMetaType<std::shared_ptr<gpu::FramePasses>>();
    qRegisterMetaType<task::Reason>();
}

RenderWorker::~RenderWorker() {
    m_thread.request_stop();
    m_thread.join();
    if (m_card.valid())
        m_card.wait();
}

void RenderWorker::setEngine(const std::optional<prepare::PreparedEngine> &prepared,
                             std::shared_ptr<gpu::GpuEngine> onCard, std::uint64_t generation) {
    const std::lock_guard lock(m_mutex);
    m_prepared = prepared;
    m_onCard = std::move(onCard);
    if (m_generation != generation)
        m_next.reset();
    m_generation = generation;
    m_last.reset();
    if (!m_prepared) {
        m_dropsCard = true;
        m_wake.notify_one();
    }
}

std::uint64_t RenderWorker::request(const scene::Camera &camera,
                                    const scene::ImageDefinition &image,
                                    const shading::Shading &shading, const Reduction &reduction,
                                    const std::optional<Exposed> &exposed,
                                    const std::optional<Compared> &compared) {
    const std::lock_guard lock(m_mutex);
    if (!m_prepared)
        return m_number;
    m_next = Request{*m_prepared, m_onCard,  m_generation, camera,   image,
                     shading,     reduction, exposed,      compared, ++m_number};
    m_wake.notify_one();
    return m_number;
}

template <class Result>
std::future<Result> RenderWorker::onThread(std::packaged_task<Result()> work) {
    std::future<Result> result = work.get_future();
    const std::lock_guard lock(m_mutex);
    m_pictures.emplace_back([work = std::move(work)]() mutable { work(); });
    m_wake.notify_one();
    return result;
}

std::future<picture::ProjectionImage>
RenderWorker::picture(std::shared_ptr<render::ProjectionEngine> engine, const scene::Camera &camera,
                      const scene::ImageDefinition &image, const shading::Shading &shading) {
    return onThread(std::packaged_task<picture::ProjectionImage()>(
        [engine = std::move(engine), camera, image, shading] {
            if (!engine)
                throw task::Error(task::ErrorCode::usage, task::because::noProjectionYet);
            return engine->render(camera, image, shading);
        }));
}

std::future<picture::PeriodPicture>
RenderWorker::period(std::shared_ptr<render::ProjectionEngine> engine, const scene::Camera &camera,
                     const scene::ImageDefinition &image, const shading::Shading &shading) {
    return onThread(std::packaged_task<picture::PeriodPicture()>(
        [this, engine = std::move(engine), camera, image, shading] {
            {
                const std::lock_guard lock(m_mutex);
                if (m_next)
                    throw task::Cancelled();
            }
            return engine->renderPeriod(camera, image, shading);
        }));
}

void RenderWorker::run(const std::stop_token &stop) {
    for (;;) {
        std::optional<Request> request;
        bool dropsCard = false;
        std::packaged_task<void()> picture;
        {
            std::unique_lock lock(m_mutex);
            if (!m_wake.wait(lock, stop,
                             [this] { return m_next || m_dropsCard || !m_pictures.empty(); }))
                return;
            dropsCard = std::exchange(m_dropsCard, false);
            if (!m_pictures.empty()) {
                picture = std::move(m_pictures.front());
                m_pictures.pop_front();
            } else if (m_next) {
                m_last = m_next;
                request = std::move(m_next);
                m_next.reset();
            }
        }
        if (dropsCard && m_card.valid())
            m_card.get();
        if (picture.valid())
            picture();
        if (!request)
            continue;
        scene::Camera &camera = request->camera;
        camera = scene::withPixelsAtLeast(
            camera, std::max(request->reduction.draft ? 2.0 * camera.pixelMm : 0.0,
                             request->reduction.finestPixelMm));
        makeFrame(*request);
    }
}

std::shared_ptr<RenderedFrame> RenderWorker::frameFor(const Request &request) const {
    auto frame = std::make_shared<RenderedFrame>();
    frame->generation = request.generation;
    frame->number = request.number;
    frame->draft = request.reduction.draft;
    return frame;
}

void RenderWorker::makeFrame(const Request &request) {
    try {
        auto frame = frameFor(request);
        if (!request.onCard || !renderOnCard(frame, request))
            renderInto(*frame, request);
        frame->camera = request.camera;
        if (const auto &exposed = request.exposed) {
            frame->exposed = exposed->of;
            frame->exposure =
                picture::measureExposure(*request.prepared.engine, exposed->lattice, request.image,
                                         request.shading, exposed->tone, exposed->background);
        }
        if (const auto &other = request.compared)
            frame->compared = other->engine->render(request.camera, other->image, other->shading);
        emit frameReady(std::move(frame));
    } catch (...) {
        emit failed(currentFailure().what);
    }
}

RenderWorker::CardFrame RenderWorker::askCard(const Request &request) {
    CardFrame answer;
    answer.number = request.number;
    answer.onCard = request.onCard;
    try {
        auto frame = frameFor(request);
        gpu::CardTimes times;
        frame->onCard =
            request.onCard->renderOnCard(request.camera, request.image, request.shading, &times);
        frame->times = {times.sliceMs, times.transformMs, times.widthShares};
        answer.frame = std::move(frame);
    } catch (const task::Error &error) {
        answer.refusal = error.reason();
        // A picture that is too large for the card does not rule out the next one.
        answer.isLost = error.code() != task::ErrorCode::outOfMemory;
    } catch (...) {
        answer.refusal = currentFailure().what;
    }
    const std::lock_guard lock(m_mutex);
    m_cardIsDone = true;
    // Meanwhile the processor made this frame. Now that the card is ready, the last request is
    // repeated.
    if (m_cardIsLate && !m_next && m_last && m_last->onCard) {
        m_next = m_last;
        m_wake.notify_one();
    }
    return answer;
}

// Whether the card made the frame. For a new kind of frame the driver may have to compile shaders,
// which takes too long to wait for.
bool RenderWorker::renderOnCard(std::shared_ptr<RenderedFrame> &frame, const Request &request) {
    const auto isBusy = [this] {
        const std::lock_guard lock(m_mutex);
        m_cardIsLate = !m_cardIsDone;
        return m_cardIsLate;
    };
    if (m_card.valid()) {
        if (isBusy()) {
            frame->refusal = task::because::cardIsBeingPrepared;
            return false;
        }
        // The late answer may be the requested frame, or report that the card has failed.
        const CardFrame late = m_card.get();
        if (late.onCard == request.onCard && (late.number == request.number || late.isLost))
            return take(late, frame);
    }
    m_cardIsDone = m_cardIsLate = false; // no other thread reads them now
    m_card = std::async(std::launch::async, [this, request] { return askCard(request); });
    if (m_card.wait_for(cardPatience) != std::future_status::ready && isBusy()) {
        frame->refusal = task::because::cardIsBeingPrepared;
        return false;
    }
    return take(m_card.get(), frame);
}

bool RenderWorker::take(const CardFrame &answer, std::shared_ptr<RenderedFrame> &frame) {
    if (answer.frame) {
        frame = answer.frame;
        return true;
    }
    frame->refusal = answer.refusal;
    if (!answer.isLost)
        return false;
    {
        const std::lock_guard lock(m_mutex);
        if (m_onCard == answer.onCard)
            m_onCard.reset();
    }
    emit cardFailed(*answer.refusal, answer.onCard->textures().passes());
    return false;
}

void RenderWorker::renderInto(RenderedFrame &frame, const Request &request) {
    frame.image = request.prepared.engine->render(request.camera, request.image, request.shading,
                                                  &frame.times);
}

} // namespace pellucid::ui
