// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/render_worker.h"

#include <algorithm>

namespace pellucid::ui {

RenderWorker::RenderWorker(QObject *parent)
    : QObject(parent), m_thread([this](std::stop_token stop) { run(stop); }) {
    qRegisterMetaType<std::shared_ptr<const RenderedFrame>>();
}

RenderWorker::~RenderWorker() {
    m_thread.request_stop();
    m_thread.join();
}

void RenderWorker::setEngine(std::shared_ptr<render::ProjectionEngine> engine) {
    const std::lock_guard lock(m_mutex);
    m_engine = std::move(engine);
    m_next.reset();
}

void RenderWorker::request(const render::Camera &camera, const render::ImageDefinition &image,
                           bool draft) {
    const std::lock_guard lock(m_mutex);
    if (!m_engine)
        return;
    m_next = Request{m_engine, camera, image, draft};
    m_wake.notify_one();
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
        if (request.draft) {
            request.camera.pixelMm *= 2.0;
            request.camera.width = std::max(1, (request.camera.width + 1) / 2);
            request.camera.height = std::max(1, (request.camera.height + 1) / 2);
        }
        try {
            auto frame = std::make_shared<RenderedFrame>();
            frame->draft = request.draft;
            frame->image = request.engine->render(request.camera, request.image, &frame->times);
            emit frameReady(std::move(frame));
        } catch (const std::exception &error) {
            emit failed(QString::fromUtf8(error.what()));
        }
    }
}

} // namespace pellucid::ui
