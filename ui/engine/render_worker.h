// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include <QObject>

#include "core/picture/exposure.h"
#include "core/picture/tone_subject.h"
#include "core/prepare/prepared_engine.h"
#include "core/task/reason.h"
#include "gpu/gpu_engine.h"

namespace pellucid::ui {

/// A finished frame.
struct RenderedFrame {
    /// That of the request: frames of a former generation are dropped.
    std::uint64_t generation = 0;
    picture::ProjectionImage image;
    /// In place of the image, if the graphics card made it.
    std::shared_ptr<const gpu::CardPicture> onCard;
    /// Why the processor made it, if the card was to make it.
    std::optional<task::Reason> refusal;
    /// The exposure of the study, if requested.
    std::optional<scene::Exposure> exposure;
    picture::ToneSubject exposed; ///< for which it was measured
    scene::Camera camera;         ///< whose picture it is: that of the request, reduced
    /// The same view of the compared look, if requested.
    std::optional<picture::ProjectionImage> compared;
    picture::FrameTimes times;
    std::uint64_t number = 0; ///< of the request it answers
    bool draft = false;
};

/// Renders projections on a thread of its own, so that the event loop never waits for one. Only the
/// latest request counts: older ones that have not begun are dropped.
class RenderWorker : public QObject {
    Q_OBJECT
public:
    explicit RenderWorker(QObject *parent = nullptr);
    ~RenderWorker() override;

    /// Sets the engine that makes the frames, or none. `onCard`: the same engine on the graphics
    /// card, or none; it is used until it fails. `generation`: the number that its frames will
    /// carry; a pending request of another generation is dropped.
    void setEngine(const std::optional<prepare::PreparedEngine> &prepared,
                   std::shared_ptr<gpu::GpuEngine> onCard, std::uint64_t generation);
    /// How a frame is made smaller than the pane.
    struct Reduction {
        bool draft = false; ///< half the pixels a side: the central part of the same spectrum
        /// Pixels are made at least this large; finer ones would only magnify.
        double finestPixelMm = 0.0;
    };
    /// The study whose exposure is measured with a frame: that takes three small ones.
    struct Exposed {
        volume::Lattice lattice; ///< of the volume
        scene::Tone tone;        ///< its contrast
        picture::ToneSubject of;
        picture::Background background = picture::Background::zero;
    };
    /// Another look that is rendered with each frame, too.
    struct Compared {
        std::shared_ptr<render::ProjectionEngine> engine;
        scene::ImageDefinition image;
        shading::Shading shading;
    };
    /// Requests a frame and returns the number of the request, which the frame will carry.
    std::uint64_t request(const scene::Camera &camera, const scene::ImageDefinition &image,
                          const shading::Shading &shading, const Reduction &reduction,
                          const std::optional<Exposed> &exposed,
                          const std::optional<Compared> &compared = {});
    /// Renders a single picture before the next frame, as engines render on this thread only. The
    /// future *throws* as rendering does, and std::future_error if the worker ends before.
    std::future<picture::ProjectionImage> picture(std::shared_ptr<render::ProjectionEngine> engine,
                                                  const scene::Camera &camera,
                                                  const scene::ImageDefinition &image,
                                                  const shading::Shading &shading);
    /// The same for the whole period of a picture. *Throws* Cancelled if a frame is waiting
    /// when it would begin.
    std::future<picture::PeriodPicture> period(std::shared_ptr<render::ProjectionEngine> engine,
                                               const scene::Camera &camera,
                                               const scene::ImageDefinition &image,
                                               const shading::Shading &shading);

signals:
    void frameReady(std::shared_ptr<const pellucid::ui::RenderedFrame> frame);
    void failed(const pellucid::task::Reason &reason);
    /// The card has failed; the processor made the frame instead.
    void cardFailed(const pellucid::task::Reason &reason,
                    const std::shared_ptr<pellucid::gpu::FramePasses> &passes);

private:
    struct Request {
        prepare::PreparedEngine prepared;
        std::shared_ptr<gpu::GpuEngine> onCard;
        std::uint64_t generation;
        scene::Camera camera;
        scene::ImageDefinition image;
        shading::Shading shading;
        Reduction reduction;
        std::optional<Exposed> exposed;
        std::optional<Compared> compared;
        std::uint64_t number;
    };
    /// The answer of the card to a request.
    struct CardFrame {
        std::uint64_t number = 0; ///< of the request
        std::shared_ptr<gpu::GpuEngine> onCard;
        std::shared_ptr<RenderedFrame> frame; ///< none: refused
        std::optional<task::Reason> refusal;
        bool isLost = false;
    };
    /// Has the work done on the worker's thread, before the next frame.
    template <class Result> std::future<Result> onThread(std::packaged_task<Result()> work);
    void run(const std::stop_token &stop);
    void makeFrame(const Request &request);
    std::shared_ptr<RenderedFrame> frameFor(const Request &request) const;
    void renderInto(RenderedFrame &frame, const Request &request);
    bool renderOnCard(std::shared_ptr<RenderedFrame> &frame, const Request &request);
    CardFrame askCard(const Request &request);
    bool take(const CardFrame &answer, std::shared_ptr<RenderedFrame> &frame);

    std::optional<prepare::PreparedEngine> m_prepared;
    std::shared_ptr<gpu::GpuEngine> m_onCard;
    std::uint64_t m_generation = 0;
    std::mutex m_mutex;
    std::condition_variable_any m_wake;
    std::optional<Request> m_next, m_last;
    bool m_dropsCard = false; ///< the card's late frame belongs to a closed study
    std::deque<std::packaged_task<void()>> m_pictures;
    std::uint64_t m_number = 0;
    /// A frame that is slow on the card; meanwhile the processor renders.
    std::future<CardFrame> m_card;
    bool m_cardIsLate = false, m_cardIsDone = false;
    std::jthread m_thread;
};

} // namespace pellucid::ui
