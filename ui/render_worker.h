// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include <QObject>

#include "core/render/cpu_engine.h"

namespace pellucid::ui {

/// A finished frame.
struct RenderedFrame {
    render::ProjectionImage image;
    render::FrameTimes times;
    bool draft = false;
};

/// Makes projections on a thread of its own, so that the event loop never waits for one. Only the
/// latest request counts: older ones that have not begun are dropped.
class RenderWorker : public QObject {
    Q_OBJECT
public:
    explicit RenderWorker(QObject *parent = nullptr);
    ~RenderWorker() override;

    void setEngine(std::shared_ptr<render::ProjectionEngine> engine);
    /// A draft has half the pixels a side: the central part of the same spectrum.
    void request(const render::Camera &camera, const render::ImageDefinition &image, bool draft);

signals:
    void frameReady(std::shared_ptr<const pellucid::ui::RenderedFrame> frame);
    void failed(const QString &reason);

private:
    struct Request {
        std::shared_ptr<render::ProjectionEngine> engine;
        render::Camera camera;
        render::ImageDefinition image;
        bool draft;
    };
    void run(std::stop_token stop);

    std::shared_ptr<render::ProjectionEngine> m_engine;
    std::mutex m_mutex;
    std::condition_variable_any m_wake;
    std::optional<Request> m_next;
    std::jthread m_thread;
};

} // namespace pellucid::ui
