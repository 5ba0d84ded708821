// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/engine/error_meter.h"

#include <utility>

#include "core/platform/threads.h"
#include "core/system/log.h"
#include "core/task/background.h"
#include "ui/language/failure.h"

namespace pellucid::ui {

ErrorMeter::ErrorMeter(QObject *parent)
    : QObject(parent), m_thread([this](const std::stop_token &stop) { run(stop); }) {
    qRegisterMetaType<error::StatedError>();
    qRegisterMetaType<std::uint64_t>("std::uint64_t");
}

ErrorMeter::~ErrorMeter() {
    cancel();
    m_thread.request_stop();
    m_thread.join();
}

void ErrorMeter::measure(Picture picture) {
    const std::lock_guard lock(m_mutex);
    m_current.request_stop();
    m_next = std::move(picture);
    m_wake.notify_one();
}

void ErrorMeter::cancel() {
    const std::lock_guard lock(m_mutex);
    m_current.request_stop();
    m_next.reset();
}

// The measurement never delays a frame: it yields every processor.
void ErrorMeter::run(const std::stop_token &stop) {
    platform::lowerPriority();
    for (;;) {
        std::optional<Picture> picture;
        std::stop_token cancelled;
        {
            std::unique_lock lock(m_mutex);
            if (!m_wake.wait(lock, stop, [this] { return m_next.has_value(); }))
                return;
            picture = std::exchange(m_next, std::nullopt);
            m_current = std::stop_source();
            cancelled = m_current.get_token();
        }
        task::onThisThread([&] { measureOne(*picture, cancelled); });
    }
}

void ErrorMeter::measureOne(Picture &picture, const std::stop_token &stop) {
    try {
        const picture::PeriodPicture period = picture.period.get();
        const auto report = [&](const error::StatedError &error, Figure figure) {
            if (!stop.stop_requested())
                emit measured(picture.number, error, figure);
        };
        const error::StatedError last = prepare::measuredError(
            picture.study, picture.scale, period, picture.image, picture.shading, {},
            task::Progress(stop),
            [&](const error::StatedError &error) { report(error, Figure::refined); });
        report(last, Figure::last);
    } catch (const task::Cancelled &) {   // the view has moved
    } catch (const std::future_error &) { // the window closes
    } catch (...) {
        // The bound stays beside the picture; whoever wonders finds the reason in the log.
        system::log("measuring the error: " + currentFailure().what.english());
    }
}

} // namespace pellucid::ui
