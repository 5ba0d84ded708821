// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/render_worker.h"

#include <algorithm>
#include <cmath>

#include "core/task/error.h"

namespace pellucid::ui {

RenderWorker::RenderWorker(QObject *parent)
    : QObject(parent), m_thread([this](std::stop_token stop) { run(stop); }) {
    qRegisterMetaType<std::shared_ptr<const RenderedFrame>>();
    qRegisterMetaType<std::shared_ptr<gpu::FramePasses>>();
}

RenderWorker::~RenderWorker() {
    m_thread.request_stop();
    m_thread.join();
}

void RenderWorker::setEngine(std::shared_ptr<render::ProjectionEngine> engine,
                             std::shared_ptr<gpu::GpuEngine> onCard, std::uint64_t generation) {
    const std::lock_guard lock(m_mutex);
    m_engine = std::move(engine);
    m_onCard = std::move(onCard);
    m_generation = generation;
    m_next.reset();
}

std::uint64_t RenderWorker::request(const render::Camera &camera,
                                    const render::ImageDefinition &image,
                                    const shading::Shading &shading, const Reduction &reduction,
                                    bool wantsTone) {
    const std::lock_guard lock(m_mutex);
    if (!m_engine)
        return m_number;
    m_next = Request{m_engine, m_onCard,  m_generation, camera,    image,
                     shading,  reduction, wantsTone,    ++m_number};
    m_wake.notify_one();
    return m_number;
}

void RenderWorker::run(std::stop_token stop) {
    for (;;) {
        Request request;
        {
            std::unique_lock lock(m_mutex);
            if (!m_wake.wait(lock, stop, [this] { return m_next.has_value(); }))
                return;
            request = std::move(*m_next);
            m_next.reset();
        }
        render::Camera &camera = request.camera;
        const double factor = std::max(request.reduction.draft ? 2.0 : 1.0,
                                       request.reduction.finestPixelMm / camera.pixelMm);
        if (factor > 1.0) {
            // The reduced image covers the same part of the patient, up to a pixel.
            camera.width = std::max(1, int(std::lround(camera.width / factor)));
            camera.height = std::max(1, int(std::lround(camera.height / factor)));
            camera.pixelMm *= factor;
        }
        makeFrame(request);
    }
}

void RenderWorker::makeFrame(const Request &request) {
    try {
        auto frame = std::make_shared<RenderedFrame>();
        frame->generation = request.generation;
        frame->number = request.number;
        frame->draft = request.reduction.draft;
        if (!request.onCard || !renderOnCard(*frame, request))
            renderInto(*frame, request);
        emit frameReady(std::move(frame));
    } catch (const std::exception &error) {
        emit failed(QString::fromUtf8(error.what()));
    }
}

bool RenderWorker::renderOnCard(RenderedFrame &frame, const Request &request) {
    try {
        gpu::CardTimes times;
        const auto picture =
            request.onCard->renderOnCard(request.camera, request.image, request.shading, &times);
        if (request.wantsTone)
            frame.automaticTone = render::toneRange(picture->download(), {});
        frame.onCard = picture;
        frame.times = {times.sliceMs, times.transformMs};
        return true;
    } catch (const task::Error &error) {
        frame.refusal = QString::fromStdString(error.reason());
        // A picture too large for the card is none of its next.
        if (error.code() == task::ErrorCode::outOfMemory)
            return false;
        const std::lock_guard lock(m_mutex);
        if (m_onCard == request.onCard)
            m_onCard.reset();
    }
    emit cardFailed(frame.refusal, request.onCard->textures().passes());
    return false;
}

void RenderWorker::renderInto(RenderedFrame &frame, const Request &request) {
    frame.image =
        request.engine->render(request.camera, request.image, request.shading, &frame.times);
    if (request.wantsTone)
        frame.automaticTone = render::toneRange(frame.image, {});
}

} // namespace pellucid::ui
